"""Index reduction: Pantelides (1988) and dummy derivatives (Mattsson and Soderlind, 1993)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

from casadi import SX

from arthur_acausal.errors import StructureError
from arthur_acausal.graph import PRIORITIES, Conflict, StructurallySingular, pantelides, select_states
from arthur_acausal.transform.dependent import combine_dependent
from arthur_acausal.transform.derive import differentiated
from arthur_acausal.transform.linear import Coefficient, LinearAnalysis
from arthur_acausal.transform.rows import Evaluator, Nodes, Row, incidence
from arthur_acausal.transform.state_sets import StateSets, state_sets

_GLADLY = {
    "never": 1e6,
    "avoid": 1e2,
    "default": 1.0,
    "prefer": 1e-2,
    "always": 1e-6,
}  # a derivative is a dummy

LISTED = 12  # names in one message


@dataclass(frozen=True, slots=True)
class ReducedSystem:
    """A system of index one: as many rows as unknowns.

    ``edges``: node -> coefficient for each row. ``dummies``: derivative nodes that became algebraic unknowns.
    ``differentiated``: the rows that were differentiated, as text. ``index``: 0 or 1 as it was, 2 and more where
    rows were differentiated (once, twice, ...). ``sets``: what else could be states, where a set may become
    singular, with the entries of its Jacobian, each an expression over the symbols of its row. ``combined``: the
    combinations that took the place of equations, as text.
    """

    rows: list[Row]
    edges: list[dict[int, Coefficient]]
    dummies: frozenset[int]
    differentiated: list[str]
    index: int
    sets: StateSets | None = None
    entries: list[tuple[Row, SX]] = field(default_factory=list)
    combined: list[str] = field(default_factory=list)


def reduce_index(
    rows: list[Row],
    nodes: Nodes,
    linear: LinearAnalysis,
    evaluator: Evaluator,
    dummies: frozenset[int] | None = None,
) -> ReducedSystem:
    """Differentiate what must be differentiated; nodes of new derivatives are appended to ``nodes``.

    ``dummies``: the dummy derivatives, if they were chosen by numbers; else they are chosen by structure.
    Raises StructureError where no number of differentiations makes equations and unknowns match.
    """
    edges, combined = [incidence(row, linear) for row in rows], []
    while True:
        try:
            result = pantelides([list(e) for e in edges], nodes.derivative)
        except StructurallySingular as singular:
            raise _singular(singular, rows, nodes) from None
        new = combine_dependent(rows, edges, result, nodes, evaluator)
        if not new:
            break
        combined += [row.text for row in new.values()]
        rows = nodes.without_unused([new.get(i, row) for i, row in enumerate(rows)])
        edges = [incidence(row, linear) for row in rows]
    if len(result.edges) == len(rows):
        rates = set(nodes.derivative)
        index = int(any(n not in rates for n in result.assignment if n >= 0))
        return ReducedSystem(rows, edges, frozenset(), [], index, combined=combined)
    made = len(nodes.all)
    for successor, node in sorted((s, n) for n, s in enumerate(result.derivative) if s >= made):
        number = nodes.derivative_of(node)
        assert number == successor, "derivative nodes are numbered as Pantelides' algorithm numbers them"
    rows = list(rows)
    for equation in range(len(rows), len(result.edges)):
        origin = result.equation_derivative.index(equation)
        rows.append(differentiated(rows[origin], nodes, evaluator))
        edges.append(incidence(rows[-1], linear))
    quantities = [nodes.flat.variables[v].quantity for v, _ in nodes.all]
    if dummies is None:
        priority = [PRIORITIES[q.state_select] for q in quantities]
        try:
            chosen = select_states(
                [_firm(e) for e in edges], result.derivative, result.equation_derivative, priority
            )
        except StructurallySingular as singular:
            raise _singular(singular, rows, nodes) from None
        dummies = frozenset(chosen.dummies)
    weight = [(q.nominal or 1.0) * _GLADLY[q.state_select] for q in quantities]
    sets = state_sets(rows, nodes, nodes.derivative, result.equation_derivative, weight)
    texts = [rows[e].text for e, successor in enumerate(result.equation_derivative) if successor >= 0]
    reduced = ReducedSystem(
        rows, edges, dummies, texts, 1 + _depth(result.equation_derivative), combined=combined
    )
    return reduced if sets is None else replace(reduced, sets=sets[0], entries=sets[1])


def _firm(edges: dict[int, Coefficient]) -> list[int]:
    """Order the unknowns of a row: those with a constant coefficient first, which can never vanish."""
    return sorted(edges, key=lambda n: 0 if isinstance(edges[n], float) else 1 if edges[n] is not None else 2)


def _depth(successors: Sequence[int]) -> int:
    depth = [0] * len(successors)
    for e in range(len(successors) - 1, -1, -1):
        if successors[e] >= 0:
            depth[e] = 1 + depth[successors[e]]
    return max(depth)


def _singular(singular: StructurallySingular, rows: list[Row], nodes: Nodes) -> StructureError:
    return not_matching(singular.too_many, singular.too_few, lambda e: rows[e].text, nodes.name)


def not_matching(
    too_many: Conflict | None,
    too_few: Conflict | None,
    equation: Callable[[int], str],
    variable: Callable[[int], str],
) -> StructureError:
    """Return the error for equations that are too many for their unknowns, and unknowns that nothing determines."""
    parts, cause = [], ""
    if too_many is not None:
        names = [variable(v) for v in too_many.columns]
        only = f" (which hold only {listed(names, ', ')})" if names else " (nothing unknown is left in it)"
        texts = listed([equation(e) for e in too_many.rows], "; ")
        parts.append(f"these equations are more than their unknowns: {texts}{only}{_more(too_many)}")
        cause = "some equations say the same thing, directly or around a loop"
        cause += ", and nothing is left for the rest" if too_few is not None else ""
    if too_few is not None:
        among = f"{len(too_few.rows) - len(too_few.columns)} of " if too_few.columns else ""
        texts = listed([equation(e) for e in too_few.columns], "; ")
        only = f" (which stand only in {texts})" if texts else ""
        names = [variable(v) for v in too_few.rows]
        parts.append(f"not determined: {among}{listed(names, ', ')}{only}{_more(too_few)}")
    remedies = {
        (True, True): "remove one of the equations named, and add one for what is not determined",
        (True, False): "remove one of the equations named",
    }
    return StructureError(
        f"the system is structurally singular; {'; '.join(parts)}",
        cause=cause,
        remedy=remedies.get(
            (too_many is not None, too_few is not None), "add an equation that determines one of them"
        ),
    )


def _more(conflict: Conflict) -> str:
    return f" and {conflict.others} more of this kind" if conflict.others else ""


def listed(names: Sequence[str], separator: str) -> str:
    """Return the first names in one text, and how many more there are."""
    more = len(names) - LISTED
    return separator.join(names[:LISTED]) + (f" and {more} more" if more > 0 else "")
