"""Time events: relations of time alone, whose next change is known in advance."""

from __future__ import annotations

import numpy as np

from arthur_acausal.solve.newton import Index
from arthur_acausal.solve.protocol import DAE, BoolArray, Evaluator, FloatArray

# Where in the run g is looked at: no period of a model divides all of these parts.
PROBES = (0.0, 0.1459, 0.3820, 0.6180, 0.8541)
AFFINE = 1e-9  # deviation from a straight line, relative to the values


def affine_relations(dae: DAE, evaluator: Evaluator, start_time: float, stop_time: float) -> BoolArray:
    """Relations of time alone whose g is affine in t, as far as some probes tell.

    A sawtooth, for instance, has a constant derivative and yet is none; it is left to the root finding.
    """
    found = np.array([r.time_only for r in dae.relations], dtype=bool)
    if not found.any():
        return found
    before = float(evaluator.t[0])
    times = start_time + np.array(PROBES) * (stop_time - start_time)
    values = []
    for t in times.tolist():
        evaluator.t[0] = t
        values.append(evaluator.roots().copy())
    evaluator.t[0] = before
    g = np.array(values)
    line = g[0] + np.outer((times - times[0]) / (times[-1] - times[0]), g[-1] - g[0])
    straight = np.abs(g - line).max(axis=0) <= AFFINE * np.abs(g).max(axis=0)
    return np.asarray(found & straight)


class Schedule:
    """Next times at which relations of time change. Their g is affine in t as long as z does not change."""

    def __init__(self, evaluator: Evaluator, index: Index) -> None:
        self._evaluator = evaluator
        self.index = index
        self._times = np.full(self.index.size, np.inf)
        self._rising = np.zeros(self.index.size, dtype=bool)

    def update(self, t: float, after: float) -> None:
        """Compute the changes later than `after` from the values at t and t + 1; to be called after each event."""
        if not self.index.size:
            return
        g = self._values(t)
        slope = self._values(t + 1.0) - g
        self._rising = slope > 0.0
        with np.errstate(divide="ignore", invalid="ignore"):
            times = t - g / slope
            for k in np.flatnonzero(np.isfinite(times) & (times > after)).tolist():
                # One more Newton step takes out what rounding left of a far-away zero.
                times[k] -= self._values(float(times[k]))[k] / slope[k]
        self._times = np.where(np.isfinite(times) & (times > after), times, np.inf)

    def next(self) -> float:
        """The next change, or infinity."""
        return float(self._times.min()) if self._times.size else float("inf")

    def due(self, until: float) -> dict[int, bool]:
        """Relations that change up to `until`, and what they become."""
        if not self.index.size:
            return {}
        found = np.flatnonzero(self._times <= until)
        return {int(self.index[k]): bool(self._rising[k]) for k in found}

    def unseen(self, t: float, until: float) -> int | None:
        """A relation that has changed at t although no change was due up to `until`; None if there is none."""
        if not self.index.size:
            return None
        modes = self._evaluator.m[self.index] > 0.5
        g = self._values(t)
        wrong = np.flatnonzero((self._times > until) & np.where(modes, g < 0.0, g > 0.0))
        return int(self.index[wrong[0]]) if wrong.size else None

    def _values(self, t: float) -> FloatArray:
        before = self._evaluator.t[0]
        self._evaluator.t[0] = t
        values = self._evaluator.roots()[self.index]
        self._evaluator.t[0] = before
        return values
