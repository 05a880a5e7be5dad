"""Relations, `when` conditions and discrete variables at one instant."""

from __future__ import annotations

import numpy as np

from arthur_acausal.solve.diagnosis import listed
from arthur_acausal.solve.protocol import DAE, Assignment, BoolArray, Evaluator, FloatArray


class Modes:
    """The discrete part of the state, which lives in the evaluator's m, z and zp."""

    def __init__(self, dae: DAE, evaluator: Evaluator) -> None:
        self._dae, self._evaluator = dae, evaluator
        self._inclusive = np.array([r.inclusive for r in dae.relations], dtype=bool)
        kinds = dae.assignments
        self._always = [(k, a.index) for k, a in enumerate(kinds) if a.when < 0 and a.kind == "discrete"]
        self._initial = [(k, a) for k, a in enumerate(kinds) if a.when >= 0 and dae.whens[a.when].initial]
        self._changed: list[int] = []
        self.conditions: BoolArray = np.zeros(len(dae.whens), dtype=bool)

    def truth(self, g: FloatArray) -> BoolArray:
        """Which relations hold for these values."""
        holds = g > 0.0
        if np.count_nonzero(g) < g.size:
            holds |= (g == 0.0) & self._inclusive
        return holds

    def update(self) -> bool:
        """Set all modes from the present values; whether any changed."""
        evaluator = self._evaluator
        if not evaluator.m.size:
            return False
        holds = self.truth(evaluator.roots())
        self._changed = np.flatnonzero(holds != (evaluator.m > 0.5)).tolist()
        evaluator.m[:] = holds
        return bool(self._changed)

    def assign_discrete(self) -> bool:
        """Evaluate the discrete equations that are active until they agree; whether any value changed."""
        evaluator = self._evaluator
        before = evaluator.z.copy()
        active = self._always + [(k, a.index) for k, a in self.initial_actions() if a.kind == "discrete"]
        for _ in range(len(active) + 1):
            values = evaluator.when_values() if active else evaluator.z
            last = evaluator.z.copy()
            for k, index in active:
                evaluator.z[index] = values[k]
            if np.array_equal(last, evaluator.z):
                break
        return not np.array_equal(before, evaluator.z)

    def initial_actions(self) -> list[tuple[int, Assignment]]:
        """What the `when` clauses that name initial() do at the present values, each with its number."""
        if not self._initial:
            return []
        holds = self._evaluator.conditions() > 0.5
        for k, when in enumerate(self._dae.whens):
            if when.earlier and holds[k]:
                holds[k] = not holds[k - when.earlier : k].any()
        return [(k, a) for k, a in self._initial if holds[a.when]]

    def settle(self) -> None:
        """The instant is over: present values become the previous ones."""
        evaluator = self._evaluator
        evaluator.zp[:] = evaluator.z
        if self.conditions.size:
            self.conditions = evaluator.conditions() > 0.5

    def last_changed(self) -> str:
        """The relations that changed in the last update, for messages."""
        return listed([self._dae.relations[k].label for k in self._changed], "; ")
