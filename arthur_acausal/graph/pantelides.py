"""Which equations must be differentiated, and how often, so that the highest derivatives can be solved for.

Pantelides (1988), SIAM J. Sci. Stat. Comput. 9, 213-231.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from arthur_acausal.graph.dulmage_mendelsohn import Conflict, StructurallySingular, conflicts
from arthur_acausal.graph.matching import NONE, Edges, augment, inverse, matching


@dataclass(frozen=True, slots=True)
class PantelidesResult:
    """The system with its differentiated equations; the given equations and variables keep their numbers.

    edges: variables of each equation. A differentiated equation has those of its origin and their
    derivatives.
    derivative: for each variable its derivative variable, or -1.
    equation_derivative: for each equation its differentiated equation, or -1.
    assignment: for each equation without a derivative one highest derivative that it determines; else -1.
    """

    edges: list[list[int]]
    derivative: list[int]
    equation_derivative: list[int]
    assignment: list[int]


def pantelides(edges: Edges, derivative_of: Sequence[int]) -> PantelidesResult:
    """Differentiate the least number of times until all equations match the highest derivatives.

    ``derivative_of[variable]`` is the variable that stands for its time derivative, or -1. A variable is a
    highest derivative when it has none. New variables and equations are appended.

    Pantelides takes one unmatched equation at a time; here all take part in each round. Each of their sets of
    reached equations is minimally singular by itself, so that each of them has to be differentiated in any
    case and the result is the same, but the work of a round is linear. A system of index 1 needs one matching
    and no round.

    Raises
    ------
    StructurallySingular
        When no number of differentiations helps: equations and variables cannot be matched even if a variable
        and its derivatives count as one. The variables reported are the lowest of their chains.
    """
    result = [list(variables) for variables in edges]
    derivative = list(derivative_of)
    equation_derivative = [NONE] * len(result)
    highest = [[v for v in variables if derivative[v] < 0] for variables in result]
    assignment = matching(highest, len(derivative))
    owner = inverse(assignment, len(derivative))
    free = [e for e, variable in enumerate(assignment) if variable < 0]
    if free or len(result) != sum(successor < 0 for successor in derivative):
        _check_solvable(result, derivative)
    while free:
        closed = [successor >= 0 for successor in derivative]
        free, variables = augment(result, free, assignment, owner, closed)
        reached = sorted(free + [owner[v] for v in variables])
        for variable in variables:
            derivative[variable] = len(derivative)
            derivative.append(NONE)
            owner.append(NONE)
        unmatched, free = set(free), []
        for equation in reached:
            new = len(result)
            equation_derivative[equation] = new
            equation_derivative.append(NONE)
            result.append(_differentiated(result[equation], derivative))
            if equation in unmatched:
                assignment.append(NONE)
                free.append(new)
            else:
                assignment.append(derivative[assignment[equation]])
                owner[assignment[new]] = new
                assignment[equation] = NONE
    return PantelidesResult(result, derivative, equation_derivative, assignment)


def _differentiated(variables: Sequence[int], derivative: Sequence[int]) -> list[int]:
    """Return the variables of the time derivative of an equation: highest derivatives first, each once."""
    new = dict.fromkeys(derivative[v] for v in variables if derivative[v] >= 0)
    return list(new | dict.fromkeys(variables))


def chains(derivative: Sequence[int]) -> list[int]:
    """Return for each variable the lowest variable of its chain of derivatives."""
    origin = list(range(len(derivative)))
    has_origin = bytearray(len(derivative))
    for successor in derivative:
        if successor >= 0:
            has_origin[successor] = True
    for variable in range(len(derivative)):
        if not has_origin[variable]:
            successor = derivative[variable]
            while successor >= 0:
                origin[successor] = variable
                successor = derivative[successor]
    return origin


def _check_solvable(edges: Edges, derivative: Sequence[int]) -> None:
    """Raise unless equations and chains of derivatives match one to one; else the rounds would not end."""
    origin = chains(derivative)
    lowest = [v for v in range(len(derivative)) if origin[v] == v]
    number = {variable: index for index, variable in enumerate(lowest)}
    merged = [list(dict.fromkeys(number[origin[v]] for v in variables)) for variables in edges]
    assignment = matching(merged, len(lowest))
    if len(lowest) == len(edges) and min(assignment, default=0) >= 0:
        return
    too_many, too_few = conflicts(merged, len(lowest), assignment)
    if too_many is not None:
        too_many = Conflict(too_many.rows, [lowest[v] for v in too_many.columns], too_many.others)
    if too_few is not None:
        too_few = Conflict([lowest[v] for v in too_few.rows], too_few.columns, too_few.others)
    raise StructurallySingular(too_many, too_few)
