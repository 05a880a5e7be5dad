"""Absolute tolerances of a run: those of the options, wider where an algebraic unknown amplifies the states' errors.

An algebraic unknown is a function of the states. Where it is a small difference of large terms (the force in a rod
between stiff springs, the current through a closed switch), an error of the states within their tolerance moves it
by far more than ``rtol |y| + atol`` of its own: a step could pass only with states exact to far more digits than were
asked for, and below rounding none passes at all. So its tolerance is at least what the states' tolerances make of it.
"""

from __future__ import annotations

import numpy as np

from arthur_acausal.solve.consistent import ConsistentSystem
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.protocol import DAE, Attributes, Evaluator, FloatArray

WIDEST = 1e-2  # of an unknown's magnitude: one that is lost in the states' errors is near a singular point
ROOM = 4.0  # a tolerance stays as it is while it is within this factor of what it should be
RAREST = 8  # while nothing is to be widened, every second, fourth, and at last eighth call looks


class Tolerances:
    """The vector ``atol``, which follows the model from start to start, and is widened in between where it must."""

    def __init__(
        self, dae: DAE, evaluator: Evaluator, attributes: Attributes, options: SolverOptions
    ) -> None:
        paths, algebraic = list(dae.y_paths), np.flatnonzero(~dae.differential)
        self._rtol, self._evaluator = options.step_rtol, evaluator
        self._least = options.absolute_tolerances(paths, attributes.nominal)
        self._nominal = np.abs(attributes.nominal)
        self._own = ~dae.differential & ~options.given_tolerances(paths)
        self._system = ConsistentSystem(dae, evaluator, attributes, algebraic, algebraic[:0])
        self.atol = self._least
        self._calls, self._every = 0, 1

    @property
    def adaptive(self) -> bool:
        """Whether there is anything to adapt."""
        return bool(self._own.any() and self._system.states.size)

    def adapt(self) -> bool:
        """Set the tolerances to what is right for the evaluator's values; whether they are new ones."""
        wanted = self._wanted()
        if np.all((self.atol <= ROOM * wanted) & (wanted <= ROOM * self.atol)):
            return False
        self.atol = wanted
        self._every = 1
        return True

    def widen(self) -> bool:
        """Widen the tolerances that are far too narrow for the evaluator's values; whether any was found so.

        Each look costs a factorisation: where the looks before found none, not every call is one.
        """
        self._calls += 1
        if self._calls % self._every:
            return False
        wanted = self._wanted()
        size = self._rtol * np.abs(self._evaluator.y)
        narrow = wanted > ROOM * (self.atol + size)
        self.atol = np.where(narrow, wanted, self.atol)
        found = bool(narrow.any())
        self._every = 1 if found else min(2 * self._every, RAREST)
        return found

    def _wanted(self) -> FloatArray:
        size = np.abs(self._evaluator.y)
        spread = self._system.spread(self._rtol * size + self._least)
        spread = np.minimum(spread, WIDEST * np.maximum(size, self._nominal))
        return np.where(self._own, np.maximum(self._least, spread), self._least)
