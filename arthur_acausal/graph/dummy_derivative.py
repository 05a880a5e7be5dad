"""Which derivatives become algebraic unknowns after index reduction, and so which variables remain states.

Mattsson and Soderlind (1993), SIAM J. Sci. Comput. 14, 677-692. The choice at one level is an independent set
of a transversal matroid, so that taking candidates in the order of their priority, keeping those that can
still be matched, gives the best set: Edmonds and Fulkerson (1965), J. Res. NBS 69B, 147-153.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from arthur_acausal.graph.dulmage_mendelsohn import Conflict, StructurallySingular, conflicts
from arthur_acausal.graph.matching import NONE, Edges, augment, transpose

PRIORITIES = {"never": 0, "avoid": 1, "default": 2, "prefer": 3, "always": 4}


@dataclass(frozen=True, slots=True)
class StateSelection:
    """The outcome; lists in ascending order.

    dummies: derivative variables that become algebraic unknowns of their own.
    states: variables whose derivative is not a dummy.
    """

    dummies: list[int]
    states: list[int]


def select_dummies(edges: Edges, n_candidates: int, priority: Sequence[int]) -> list[int]:
    """Choose as many of the candidates as there are equations, so that the two match; ascending.

    ``edges[equation]`` lists the candidates (numbered from 0) that the differentiated equation can determine.
    The candidates of lower ``priority`` are chosen as far as possible, among equals rather those of lower
    number.

    Raises
    ------
    StructurallySingular
        When the equations do not match any set of candidates; the rows of ``too_many`` are indices into ``edges``.
    """
    equations_of = transpose(edges, n_candidates)
    equation_of = [NONE] * n_candidates
    candidate_of = [NONE] * len(edges)
    for level in sorted(set(priority)):
        augment(
            equations_of, [c for c in range(n_candidates) if priority[c] == level], equation_of, candidate_of
        )
    if NONE in candidate_of:
        raise StructurallySingular(conflicts(edges, n_candidates, candidate_of)[0], None)
    return sorted(candidate_of)


def select_states(
    edges: Edges, derivative: Sequence[int], equation_derivative: Sequence[int], priority: Sequence[int]
) -> StateSelection:
    """Choose dummy derivatives for a system that has been differentiated; arrays as in `PantelidesResult`.

    ``priority[variable]`` is how much the variable is wanted as a state (`PRIORITIES`); derivatives beyond
    the end of the list inherit it. From the highest derivatives down: each equation that came from
    differentiation determines a dummy derivative; then the equations and the chosen derivatives are
    integrated once, and so on. ``edges`` may leave out entries that are known to vanish, so that the choice
    is not singular by numbers.
    """
    antiderivative = _predecessors(derivative)
    origin = _predecessors(equation_derivative)
    wanted = list(priority[: len(derivative)])
    for variable in range(len(wanted), len(derivative)):
        wanted.append(wanted[antiderivative[variable]])
    equations = [e for e, successor in enumerate(equation_derivative) if successor < 0 and origin[e] >= 0]
    candidates = [v for v, successor in enumerate(derivative) if successor < 0 and antiderivative[v] >= 0]
    dummies: list[int] = []
    while equations:
        place = {variable: index for index, variable in enumerate(candidates)}
        level = [[place[v] for v in edges[e] if v in place] for e in equations]
        try:
            chosen = select_dummies(level, len(candidates), [wanted[antiderivative[v]] for v in candidates])
        except StructurallySingular as error:
            assert error.too_many is not None
            rows = [equations[index] for index in error.too_many.rows]
            columns = [candidates[index] for index in error.too_many.columns]
            raise StructurallySingular(Conflict(rows, columns, error.too_many.others), None) from None
        selected = [candidates[index] for index in chosen]
        dummies += selected
        equations = [origin[e] for e in equations if origin[origin[e]] >= 0]
        candidates = [antiderivative[v] for v in selected if antiderivative[antiderivative[v]] >= 0]
    taken = set(dummies)
    states = [v for v, successor in enumerate(derivative) if successor >= 0 and successor not in taken]
    return StateSelection(sorted(dummies), states)


def _predecessors(successor: Sequence[int]) -> list[int]:
    """Return the inverse of a partial successor list, -1 where there is no predecessor."""
    result = [NONE] * len(successor)
    for index, following in enumerate(successor):
        if following >= 0:
            result[following] = index
    return result
