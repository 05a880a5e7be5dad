"""Coarse Dulmage-Mendelsohn decomposition: where there are too many equations, and where too few.

Within a part, what alternating paths reach from one unmatched row is a smallest set by itself: with any of its rows
left out, the others match. (Rows that can be matched are independent in a transversal matroid, and such a set is the
circuit that the row closes: Edmonds and Fulkerson (1965), J. Res. NBS 69B, 147-153.)

Dulmage and Mendelsohn (1958), Canad. J. Math. 10, 517-534; Pothen and Fan (1990), ACM Trans. Math. Softw. 16,
303-324.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from arthur_acausal.graph.matching import Edges, inverse, matching, transpose

TRIED = 100  # unmatched rows from which a smallest set is sought


@dataclass(frozen=True, slots=True)
class Decomposition:
    """The three parts of a system of equations; all lists are in ascending order.

    The overdetermined part has more equations than variables, the underdetermined part fewer, the rest as
    many. No variable outside the overdetermined part occurs in its equations. The parts do not depend on the
    matching.
    """

    over_equations: list[int]
    over_variables: list[int]
    under_equations: list[int]
    under_variables: list[int]
    well_equations: list[int]
    well_variables: list[int]


@dataclass(frozen=True, slots=True)
class Conflict:
    """A smallest set of rows that has one row more than columns; lists in ascending order.

    With too many equations the rows are equations, and ``columns`` all the variables in them; with too few the rows
    are variables, and ``columns`` all the equations that they occur in. ``others``: how many more such sets there are.
    """

    rows: list[int]
    columns: list[int]
    others: int


class StructurallySingular(Exception):  # noqa: N818 (what was found, for the caller to explain)
    """Equations and variables cannot be matched one to one.

    ``too_many``: equations for too few variables; ``too_few``: variables for too few equations. One of them may be
    missing.
    """

    def __init__(self, too_many: Conflict | None, too_few: Conflict | None) -> None:
        super().__init__(f"structurally singular: {too_many}, {too_few}")
        self.too_many = too_many
        self.too_few = too_few


def conflicts(
    edges: Edges, n_variables: int, assignment: Sequence[int]
) -> tuple[Conflict | None, Conflict | None]:
    """Return the smallest sets of too many equations and of too many variables, for a maximum matching."""
    owner = inverse(assignment, n_variables)
    return _smallest(edges, assignment, owner), _smallest(transpose(edges, n_variables), owner, assignment)


def _smallest(edges: Edges, assignment: Sequence[int], owner: Sequence[int]) -> Conflict | None:
    """Return the smallest of the sets that one unmatched row each reaches; None where all rows are matched."""
    unmatched = _unmatched(assignment)
    if not unmatched:
        return None
    found = [_reach(edges, [row], owner) for row in unmatched[:TRIED]]
    rows, columns = min(found, key=lambda sets: len(sets[0]))
    return Conflict(rows, columns, len(unmatched) - 1)


def dulmage_mendelsohn(
    edges: Edges, n_variables: int, assignment: Sequence[int] | None = None
) -> Decomposition:
    """Decompose; ``assignment`` is a maximum matching if one is known already."""
    assigned = list(assignment) if assignment is not None else matching(edges, n_variables)
    owner = inverse(assigned, n_variables)
    equations_of = transpose(edges, n_variables)
    over_equations, over_variables = _reach(edges, _unmatched(assigned), owner)
    under_variables, under_equations = _reach(equations_of, _unmatched(owner), assigned)
    taken_equations = set(over_equations).union(under_equations)
    taken_variables = set(over_variables).union(under_variables)
    return Decomposition(
        over_equations,
        over_variables,
        under_equations,
        under_variables,
        [e for e in range(len(edges)) if e not in taken_equations],
        [v for v in range(n_variables) if v not in taken_variables],
    )


def _unmatched(assignment: Sequence[int]) -> list[int]:
    return [row for row, column in enumerate(assignment) if column < 0]


def _reach(edges: Edges, start: Sequence[int], owner: Sequence[int]) -> tuple[list[int], list[int]]:
    """Return the rows and columns reached from unmatched rows by alternating paths."""
    rows = list(start)
    seen: set[int] = set()
    for row in rows:  # grows while it is walked
        for column in edges[row]:
            if column not in seen:
                seen.add(column)
                rows.append(owner[column])
    return sorted(rows), sorted(seen)
