"""Events that come ever closer together: an end of the run that would otherwise never come."""

from __future__ import annotations

from collections import deque
from itertools import pairwise

from arthur_acausal.errors import SimulationError
from arthur_acausal.solve.options import SolverOptions

SHRINKING = 5  # so many intervals in a row, each shorter than the one before, are a series that accumulates,
# unless the last shrinks much more than any before it, and does not from the size at which events become one instant:
# then two events happen to be near.
ABRUPT = 0.1
MERGING = 1e4  # shortest intervals


class Accumulation:
    """Watches the times of state events of one run."""

    def __init__(self, duration: float, options: SolverOptions) -> None:
        self._shortest = options.zeno_interval * duration
        self._window = options.chattering_window * duration
        self._most = options.chattering_events
        self._times: deque[float] = deque(maxlen=max(self._most, SHRINKING + 2))

    def add(self, t: float, label: str) -> None:
        """Note a state event at t; SimulationError if the events accumulate or chatter."""
        times = self._times
        times.append(t)
        recent = list(times)[-(SHRINKING + 2) :]
        intervals = [b - a for a, b in pairwise(recent)]
        if len(intervals) > SHRINKING and intervals[-1] < self._shortest and self._shrinks(intervals):
            raise SimulationError(
                f"the events accumulate at t = {t:.9g} s (Zeno): the last intervals are {intervals[-2]:.2g} s and "
                f"{intervals[-1]:.2g} s long; the last event was {label}",
                cause="each event causes the next one after a shorter time",
                remedy="end the run or change to another state (at rest) before, for instance by terminate()",
            )
        if len(times) >= self._most and t - times[-self._most] < self._window:
            raise SimulationError(
                f"chattering at t = {t:.9g} s: {self._most} events within {t - times[-self._most]:.2g} s; the last "
                f"was {label}",
                cause="the model moves back and forth across the relation",
                remedy="add a state for sliding or sticking, a hysteresis, or use a smooth law",
            )

    def _shrinks(self, intervals: list[float]) -> bool:
        if any(later >= earlier for earlier, later in pairwise(intervals)):
            return False
        shares = [later / earlier for earlier, later in pairwise(intervals)]
        return shares[-1] > ABRUPT * min(shares[:-1]) or intervals[-2] < MERGING * self._shortest
