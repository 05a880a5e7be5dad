"""Whether an event has changed the equations, or only discrete variables that they do not depend on."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.solve.protocol import DAE, Evaluator, FloatArray

NEARBY = 1e-3  # relative distance of the point where a change of law shows that the event itself hides
UNMOVED = 1e-3  # part of the tolerance by which what a sample sets may move the unknowns at once


class Law:
    """F as a function of t, y and y', as the discrete variables and modes make it.

    Attributes
    ----------
    away : (n,), how far the point that is near the present one is from it in each unknown, relative to magnitudes.
    """

    def __init__(self, dae: DAE, evaluator: Evaluator, nominal: FloatArray, rtol: float) -> None:
        self._evaluator, self._nominal = evaluator, nominal
        self._part = UNMOVED * rtol / NEARBY
        random = NEARBY * np.random.default_rng(0).uniform(0.5, 1.0, 2 * dae.n + 1)
        self.away, self._away_yp, self._away_t = random[: dae.n], random[dae.n : -1], float(random[-1])
        self._allowed = np.zeros(dae.n)
        self.keep()

    def keep(self) -> None:
        """Compare with the law as it is now."""
        self._z, self._m = self._evaluator.z.copy(), self._evaluator.m.copy()

    def changed(self, bends: bool) -> bool:
        """Whether F is another than the one kept, at the present values or near them.

        Where a law has a kink, both sides of it agree at the event itself. ``bends``: it is enough that F at the
        present values is what it was, to a part of what the tolerance makes of it
        (which is found anew only where what it was before does not do).
        """
        evaluator = self._evaluator
        if same(evaluator.z, self._z) and same(evaluator.m, self._m):
            return False
        kept, now = self._both()
        move = np.abs(now - kept)
        if bends and (move <= self._allowed).all():
            return False
        alike = np.array_equal(kept, now, equal_nan=True)
        if not (bends or alike):
            return True
        kept_near, now_near = self._near()
        if bends:
            self._allowed = self._part * np.abs(kept_near - kept)
            if (move <= self._allowed).all():
                return False
        return not (alike and np.array_equal(kept_near, now_near, equal_nan=True))

    def _both(self) -> tuple[FloatArray, FloatArray]:
        """F by the law kept and by the present one: external functions whose inputs are the same are called once."""
        evaluator = self._evaluator
        z, m = evaluator.z.copy(), evaluator.m.copy()
        evaluator.z[:], evaluator.m[:] = self._z, self._m
        kept = evaluator.residual().copy()
        evaluator.z[:], evaluator.m[:] = z, m
        return kept, evaluator.residual().copy()

    def _near(self) -> tuple[FloatArray, FloatArray]:
        """Both near the present values."""
        evaluator = self._evaluator
        t, y, yp = float(evaluator.t[0]), evaluator.y.copy(), evaluator.yp.copy()
        magnitude = np.maximum(np.abs(y), self._nominal)
        evaluator.t[0] = t + self._away_t * max(abs(t), 1.0)
        evaluator.y[:] += self.away * magnitude
        evaluator.yp[:] += self._away_yp * np.maximum(np.abs(yp), magnitude)
        near = self._both()
        evaluator.t[0], evaluator.y[:], evaluator.yp[:] = t, y, yp
        return near


def same(a: NDArray[Any], b: NDArray[Any]) -> bool:
    """Whether two arrays of one type and shape have the same values; quick where they have the same bits."""
    return a.tobytes() == b.tobytes() or bool((a == b).all())
