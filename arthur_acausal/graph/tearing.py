"""Tearing: a loop of equations as a sequence of explicit assignments once a few torn variables are known.

The greedy heuristic of Cellier and Kofman (2006), Continuous System Simulation, section 7.6, in the spirit of
Carpanzano and Maffezzoni (1998), Math. Comput. Simul. 46, 471-482. Finding the fewest torn variables is
NP-hard.
"""

from __future__ import annotations

import heapq
from collections import deque
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from arthur_acausal.graph.matching import NONE, Edges, transpose


@dataclass(frozen=True, slots=True)
class TearingResult:
    """A torn block.

    sequence: (equation, variable) in order; each equation is solved for its variable from known ones.
    torn_variables: the unknowns that remain, in the order of choice.
    residual_equations: the equations that determine them, in the block's order (as many, in a square block).
    """

    sequence: list[tuple[int, int]]
    torn_variables: list[int]
    residual_equations: list[int]


def tear(
    equations: Sequence[int],
    variables: Sequence[int],
    edges: Edges,
    solvable: Sequence[Collection[int]],
    preference: Sequence[int] | None = None,
) -> TearingResult:
    """Tear the block of ``equations`` for the unknowns ``variables``; all other variables in them are known.

    ``solvable[equation]`` holds the variables that the equation can be solved for explicitly. An equation
    with one unknown left that it can be solved for is taken at once. When there is none, a variable is torn:
    first those that no equation can be solved for, then by ``preference[variable]`` (higher: rather torn,
    default 0), then the one in most equations, then the one that makes most equations explicit at once, then
    the first of the block. The work is O(E log E) in the number of edges of the block.
    """
    block = _Block(equations, variables, edges, solvable, preference)
    while True:
        block.solve_explicit()
        variable = block.choose()
        if variable < 0:
            break
        block.torn.append(variable)
        block.make_known(variable)
    return TearingResult(
        [(equations[e], variables[v]) for e, v in block.sequence],
        [variables[v] for v in block.torn],
        [equation for e, equation in enumerate(equations) if not block.used[e]],
    )


class _Block:
    """The state of the heuristic. Equations and variables are numbered by their place in the block.

    columns[e]: variables of the equation; rows[v]: equations of the variable; solvable[e]: as given.
    unknowns[e]: number of variables of the equation that are not known yet. An equation in use has none.
    gain[v]: number of equations that become explicit at once when the variable is known.
    ready: equations that have, or had, one unknown left. heap: candidates to tear by key, old entries
    included.
    """

    def __init__(
        self,
        equations: Sequence[int],
        variables: Sequence[int],
        edges: Edges,
        solvable: Sequence[Collection[int]],
        preference: Sequence[int] | None,
    ) -> None:
        place = {variable: v for v, variable in enumerate(variables)}
        self.columns = [list(dict.fromkeys(place[x] for x in edges[e] if x in place)) for e in equations]
        self.rows = transpose(self.columns, len(variables))
        self.solvable = [{place[x] for x in solvable[e] if x in place} for e in equations]
        needless = set().union(*self.solvable)
        self.rank = [
            (v in needless, -preference[variable] if preference else 0, -len(self.rows[v]))
            for v, variable in enumerate(variables)
        ]
        self.unknowns = [len(columns) for columns in self.columns]
        self.gain = [0] * len(variables)
        self.known = [False] * len(variables)
        self.used = [False] * len(equations)
        self.ready: deque[int] = deque()
        self.sequence: list[tuple[int, int]] = []
        self.torn: list[int] = []
        self.heap: list[tuple[tuple[bool, int, int], int, int]] = []
        for e in range(len(equations)):
            self._note(e)
        self.heap = [(rank, -self.gain[v], v) for v, rank in enumerate(self.rank)]
        heapq.heapify(self.heap)

    def _note(self, e: int) -> None:
        """Take note that the equation has only one or two unknowns left."""
        if self.unknowns[e] == 1:
            self.ready.append(e)
        elif self.unknowns[e] == 2:
            self._add_gain(e, 1)

    def _add_gain(self, e: int, change: int) -> None:
        """Count an equation of two unknowns for each of the two that leaves the other one explicit."""
        first, second = (v for v in self.columns[e] if not self.known[v])
        for v, other in ((first, second), (second, first)):
            if other in self.solvable[e]:
                self.gain[v] += change
                if change > 0:
                    heapq.heappush(self.heap, (self.rank[v], -self.gain[v], v))

    def solve_explicit(self) -> None:
        """Use equations with one unknown for as long as there are any."""
        while self.ready:
            e = self.ready.popleft()
            v = next((v for v in self.columns[e] if not self.known[v]), NONE)
            if v in self.solvable[e]:
                self.used[e] = True
                self.sequence.append((e, v))
                self.make_known(v)

    def choose(self) -> int:
        """Return the best variable to tear, or -1 when all are known."""
        while self.heap:
            _, gain, v = heapq.heappop(self.heap)
            if self.known[v]:
                continue
            if -gain == self.gain[v]:
                return v
            heapq.heappush(self.heap, (self.rank[v], -self.gain[v], v))
        return NONE

    def make_known(self, v: int) -> None:
        """Remove the variable from the unknowns of its equations."""
        for e in self.rows[v]:
            if self.unknowns[e] == 2:
                self._add_gain(e, -1)
        self.known[v] = True
        for e in self.rows[v]:
            self.unknowns[e] -= 1
            self._note(e)
