"""Leaving a set of states before it becomes singular: a relation that ends the run, so that another set takes over."""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
import numpy as np
from casadi import SX
from numpy.typing import NDArray

from arthur_acausal.codegen.assemble import Assembly, StartSlot
from arthur_acausal.codegen.tables import Assignment, Relation, WhenClause
from arthur_acausal.transform.rows import Ref
from arthur_acausal.transform.state_sets import StateSets
from arthur_acausal.transform.structured import StructuredDAE

FloatArray = NDArray[np.float64]

LEAVE_AT = 0.5  # margin (1: the best set, 0: singular) at which a set of states is left
SWITCH = "another set of states takes over"
RELATION = Relation("the set of states is far from singular", "", True, False)


def add_switching(
    dae: StructuredDAE,
    assembly: Assembly,
    look: Callable[[Ref], SX],
    events: tuple[list[SX], list[SX], list[WhenClause], list[Assignment]],
) -> SX | None:
    """Add the ``when`` that ends the run to (conditions, values, whens, assignments); return the Jacobian's entries.

    None where no other set of states could be needed.
    """
    if dae.reduced.sets is None:
        return None
    conditions, values, whens, assignments = events
    assignments.append(Assignment("terminate", -1, len(whens), SWITCH, "states"))
    whens.append(WhenClause(SWITCH, ""))
    conditions.append(ca.logic_not(assembly.arguments.m[-1]))
    values.append(SX(0.0))
    return ca.vertcat(*[dae.evaluator(row, look, slope) for row, slope in dae.reduced.entries])


def continuation_starts(dae: StructuredDAE) -> list[StartSlot]:
    """Return start slots for a run that continues another: states are fixed, algebraic unknowns have a guess."""
    name, unknown = dae.nodes.name, float("nan")
    states = [StartSlot(node, 1, unknown, True, name(node)) for node in dae.causal.states]
    return states + [StartSlot(node, 1, unknown, False, name(node)) for node in dae.causal.torn]


class RootsWithMargin:
    """Root functions of the model's relations, and behind them the margin of the set of states."""

    def __init__(
        self,
        roots: Callable[[], FloatArray],
        entries: Callable[[], FloatArray],
        sets: StateSets,
        dummies: frozenset[int],
        n: int,
    ) -> None:
        self._roots, self._entries, self._sets, self._dummies = roots, entries, sets, dummies
        self._out = np.zeros(n)

    def __call__(self) -> FloatArray:
        """Return the values, always in the same array."""
        self._out[:-1] = self._roots()
        self._out[-1] = self._sets.margin(self._entries(), self._dummies) - LEAVE_AT
        return self._out
