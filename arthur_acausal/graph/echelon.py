"""Rows of a sparse matrix that are linear combinations of others, found block by block.

Elimination with the shortest pivot rows first (Markowitz 1957, Management Science 3, 255-269). An entry that falls
below ``CANCELLED`` of what it was subtracted from is taken as zero.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from heapq import heapify, heappop, heappush

SparseRow = dict[int, float]

CANCELLED = 1e-10  # of the larger operand: far above rounding, far below any coefficient of a model
THRESHOLD = 0.1  # a pivot is at least this part of its column's largest entry


@dataclass(slots=True)
class _Reduced:
    """A row with entries eliminated: ``entries`` is the sum of rows times ``factors``."""

    entries: SparseRow
    factors: SparseRow

    def eliminate(self, column: int, pivot: _Reduced) -> None:
        """Subtract a multiple of ``pivot``, so that the entry in ``column`` vanishes."""
        factor = self.entries[column] / pivot.entries[column]
        _subtract(self.entries, factor, pivot.entries)
        _subtract(self.factors, factor, pivot.factors)
        self.entries.pop(column, None)


def _subtract(row: SparseRow, factor: float, other: SparseRow) -> None:
    for k, value in other.items():
        before, change = row.get(k, 0.0), factor * value
        after = before - change
        if abs(after) <= CANCELLED * max(abs(before), abs(change)):
            row.pop(k, None)
        else:
            row[k] = after


@dataclass(slots=True)
class Echelon:
    """Elimination over blocks in solution order; a block needs only columns of itself and of those before.

    ``blocks``: rows of each block; ``assignment[row]``: its column; ``row``: gives a row's entries, None where one
    of them is no number.
    """

    blocks: Sequence[Sequence[int]]
    assignment: Sequence[int]
    row: Callable[[int], SparseRow | None]
    _block_of: dict[int, int] = field(default_factory=dict)
    _done: set[int] = field(default_factory=set)
    _pivots: dict[int, tuple[int, _Reduced]] = field(default_factory=dict)  # column -> order, row

    def dependent(self) -> list[SparseRow]:
        """Return the vanishing combinations of rows, row -> factor, the row that is said twice first, with 1."""
        self._block_of = {self.assignment[e]: b for b, block in enumerate(self.blocks) for e in block}
        found = []
        for b, block in enumerate(self.blocks):
            if len(block) > 1:
                found += [self._finished(rest) for rest in self._eliminate(b)]
        return [factors for factors in found if factors is not None]

    def _eliminate(self, b: int) -> list[_Reduced]:
        """Find the pivots of a block; return the rows that have no entry in its columns any more."""
        if b in self._done:
            return []
        self._done.add(b)
        block = self.blocks[b]
        rows = {e: _Reduced(dict(entries), {e: 1.0}) for e in block if (entries := self.row(e)) is not None}
        users: dict[int, set[int]] = {self.assignment[e]: set() for e in block}
        for e, reduced in rows.items():
            for column in reduced.entries:
                if column in users:
                    users[column].add(e)
        queue = [(len(u), column) for column, u in users.items()]
        heapify(queue)
        while queue and rows:
            number, column = heappop(queue)
            if column not in users or number != len(users[column]):
                continue  # no more as it was
            if number:
                for changed in self._pivot(column, rows, users):
                    heappush(queue, (len(users[changed]), changed))
        return list(rows.values())

    def _pivot(self, column: int, rows: dict[int, _Reduced], users: dict[int, set[int]]) -> list[int]:
        """Take a pivot in a column and eliminate it from the other rows; return the columns that this changed."""
        candidates = sorted(users.pop(column))
        largest = max(abs(rows[e].entries[column]) for e in candidates)
        able = [e for e in candidates if abs(rows[e].entries[column]) >= THRESHOLD * largest]
        best = min(able, key=lambda e: len(rows[e].entries))
        pivot = rows.pop(best)
        self._pivots[column] = (len(self._pivots), pivot)
        shared = [c for c in pivot.entries if c in users]
        for c in shared:
            users[c].discard(best)
        for e in candidates:
            if e != best:
                rows[e].eliminate(column, pivot)
                for c in shared:
                    (users[c].add if c in rows[e].entries else users[c].discard)(e)
        return shared

    def _finished(self, rest: _Reduced) -> SparseRow | None:
        """Eliminate what is left in columns of earlier blocks; return the factors if nothing remains."""
        while rest.entries:
            column = max(rest.entries, key=self._turn)
            b = self._block_of[column]
            if column not in self._pivots and b not in self._done:
                self._open(b)
                continue
            if column not in self._pivots:  # the row says something new of an earlier block
                self._pivots[column] = (len(self._pivots), rest)
                return None
            rest.eliminate(column, self._pivots[column][1])
        return rest.factors

    def _open(self, b: int) -> None:
        """Make the pivots of an earlier block of one row."""
        self._done.add(b)
        (e,) = self.blocks[b]
        entries = self.row(e)
        if entries is not None:
            self._pivots[self.assignment[e]] = (len(self._pivots), _Reduced(dict(entries), {e: 1.0}))

    def _turn(self, column: int) -> tuple[int, int]:
        """Return the place of a column in the order of elimination: latest blocks first, pivots as they were."""
        order = self._pivots[column][0] if column in self._pivots else len(self._pivots)
        return self._block_of[column], -order
