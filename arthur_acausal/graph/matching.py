"""Maximum bipartite matching of equations to variables.

Equations and variables are numbered from 0. Everywhere in this package

- ``edges[equation]`` lists the variables that occur in the equation, the preferred ones first;
- ``assignment[equation]`` is the variable the equation is matched to, -1 where there is none;
- ``owner[variable]`` is the inverse: the equation the variable is matched to, or -1.

A cheap greedy pass honours the preferences; augmenting paths then complete it. The paths are found by
depth-first search with lookahead in phases of vertex-disjoint paths, the direction of the scan alternating
from phase to phase: Pothen and Fan (1990), ACM Trans. Math. Softw. 16, 303-324, as improved (PF+) by Duff,
Kaya and Ucar (2011), ACM Trans. Math. Softw. 38, article 13. A phase is linear in the number of edges, and a
few phases suffice in practice.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from itertools import chain

Edges = Sequence[Sequence[int]]
NONE = -1
_CLOSED = sys.maxsize


def matching(edges: Edges, n_variables: int, assignment: Sequence[int] | None = None) -> list[int]:
    """Return a maximum matching as ``assignment``.

    An initial ``assignment`` (it may be shorter than ``edges``) is extended: its equations stay matched,
    though perhaps to another variable. The greedy pass gives each equation the first of its variables that is
    still free.
    """
    result = list(assignment or ()) + [NONE] * (len(edges) - len(assignment or ()))
    owner = inverse(result, n_variables)
    free = _greedy(edges, result, owner)
    if free:
        augment(edges, free, result, owner)
    return result


def inverse(assignment: Sequence[int], n_variables: int) -> list[int]:
    """Return ``owner``, the inverse of ``assignment``."""
    owner = [NONE] * n_variables
    for equation, variable in enumerate(assignment):
        if variable >= 0:
            owner[variable] = equation
    return owner


def transpose(edges: Edges, n_variables: int) -> list[list[int]]:
    """Return for each variable the equations it occurs in, in ascending order."""
    equations: list[list[int]] = [[] for _ in range(n_variables)]
    for equation, variables in enumerate(edges):
        for variable in variables:
            equations[variable].append(equation)
    return equations


def _greedy(edges: Edges, assignment: list[int], owner: list[int]) -> list[int]:
    """Match each free equation to its first free variable; return the equations that found none."""
    free = []
    for equation, variables in enumerate(edges):
        if assignment[equation] >= 0:
            continue
        for variable in variables:
            if owner[variable] < 0:
                assignment[equation] = variable
                owner[variable] = equation
                break
        else:
            free.append(equation)
    return free


def augment(
    edges: Edges,
    free: Sequence[int],
    assignment: list[int],
    owner: list[int],
    closed: Sequence[bool] | None = None,
) -> tuple[list[int], list[int]]:
    """Match as many of the equations ``free`` as possible, changing ``assignment`` and ``owner`` in place.

    Variables with ``closed`` true are taken as absent. Returns the equations that remain free and, in
    ascending order, the variables reached from them by alternating paths. These variables are all matched,
    and the equations that own them form together with the free ones the overdetermined part.
    """
    n_variables = len(owner)
    seen = (
        [_CLOSED if closed[v] else 0 for v in range(n_variables)] if closed is not None else [0] * n_variables
    )
    remaining = list(free)
    phase = 0
    while remaining:
        phase += 1
        failed = [e for e in remaining if not _search(edges, e, assignment, owner, seen, phase)]
        if len(failed) == len(remaining):
            return failed, [v for v, mark in enumerate(seen) if mark == phase]
        remaining = failed
    return [], []


def _search(
    edges: Edges, start: int, assignment: list[int], owner: list[int], seen: list[int], phase: int
) -> bool:
    """Flip an augmenting path from ``start`` over variables not yet seen in this phase, if there is one."""
    forward = phase % 2 == 1
    equations = [start]  # the path; equations[k + 1] owns variables[k]
    variables: list[int] = []
    scans = [iter(edges[start]) if forward else reversed(edges[start])]
    end = _lookahead(edges[start], owner, seen, phase)
    while end < 0:
        for variable in scans[-1]:
            if seen[variable] < phase:
                seen[variable] = phase
                equation = owner[variable]
                variables.append(variable)
                equations.append(equation)
                scans.append(iter(edges[equation]) if forward else reversed(edges[equation]))
                end = _lookahead(edges[equation], owner, seen, phase)
                break
        else:
            scans.pop()
            equations.pop()
            if not scans:
                return False
            variables.pop()
    seen[end] = phase
    for equation, variable in zip(equations, chain(variables, (end,)), strict=True):
        assignment[equation] = variable
        owner[variable] = equation
    return True


def _lookahead(variables: Sequence[int], owner: list[int], seen: list[int], phase: int) -> int:
    """Return the first of the variables that is free and not closed, or -1."""
    for variable in variables:
        if owner[variable] < 0 and seen[variable] < phase:
            return variable
    return NONE
