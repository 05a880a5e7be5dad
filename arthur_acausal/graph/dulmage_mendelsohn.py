"""Coarse Dulmage-Mendelsohn decomposition: where there are too many equations, and where too few.

Dulmage and Mendelsohn (1958), Canad. J. Math. 10, 517-534; Pothen and Fan (1990), ACM Trans. Math. Softw. 16,
303-324.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from arthur_acausal.graph.matching import Edges, inverse, matching, transpose


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


class StructurallySingular(Exception):  # noqa: N818 (what was found, for the caller to explain)
    """Equations and variables cannot be matched one to one.

    ``equations`` is the overdetermined part (too many equations for the variables in them), ``variables`` the
    underdetermined part (too many variables for the equations they occur in). One of them may be empty.
    """

    def __init__(self, equations: list[int], variables: list[int]) -> None:
        super().__init__(f"structurally singular: equations {equations}, variables {variables}")
        self.equations = equations
        self.variables = variables


def dulmage_mendelsohn(
    edges: Edges, n_variables: int, assignment: Sequence[int] | None = None
) -> Decomposition:
    """Decompose; ``assignment`` is a maximum matching if one is known already."""
    assigned = list(assignment) if assignment is not None else matching(edges, n_variables)
    owner = inverse(assigned, n_variables)
    equations_of = transpose(edges, n_variables)
    over_equations, over_variables = _reach(edges, assigned, owner)
    under_variables, under_equations = _reach(equations_of, owner, assigned)
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


def _reach(edges: Edges, assignment: Sequence[int], owner: Sequence[int]) -> tuple[list[int], list[int]]:
    """Return the rows and columns reached from the unmatched rows by alternating paths."""
    rows = [row for row, column in enumerate(assignment) if column < 0]
    seen = bytearray(len(owner))
    columns = []
    for row in rows:  # grows while it is walked
        for column in edges[row]:
            if not seen[column]:
                seen[column] = True
                columns.append(column)
                rows.append(owner[column])
    return sorted(rows), sorted(columns)
