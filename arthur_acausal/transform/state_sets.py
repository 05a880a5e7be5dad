"""Sets of states: which derivatives are dummies, chosen by numbers where a structural choice may become singular.

Mattsson and Soderlind (1993), SIAM J. Sci. Comput. 14, 677-692: at each level, the differentiated equations must
determine the dummy derivatives. Their Jacobian is the same at all levels; its best columns are found by QR with
column pivoting, and the set is changed where its own columns are far worse than the best.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from casadi import SX
from numpy.typing import NDArray

from arthur_acausal.transform.rows import Nodes, Row

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class StateSets:
    """All that choosing a set of states needs.

    ``rows``: the equations differentiated most often; ``columns``: the highest derivatives that they may determine.
    ``place``: (row, column) of each entry of their Jacobian. ``levels``: of each row, how often it was
    differentiated; ``chains``: of each column, its node and the nodes of lower order, down to the first derivative.
    ``weight`` (columns,): a nominal magnitude times how gladly the column becomes a dummy.
    """

    rows: list[int]
    columns: list[int]
    place: list[tuple[int, int]]
    levels: list[int]
    chains: list[list[int]]
    weight: FloatArray

    def choose(self, entries: FloatArray) -> frozenset[int]:
        """Return the best dummies for the numbers of the Jacobian's entries."""
        matrix = self._matrix(entries)
        dummies: set[int] = set()
        columns = list(range(len(self.columns)))
        for level in range(max(self.levels, default=0)):
            rows = [i for i, times in enumerate(self.levels) if times > level]
            columns = [columns[k] for k in pivots(matrix[np.ix_(rows, columns)])[0][: len(rows)]]
            dummies |= {self.chains[k][level] for k in columns}
            columns = [k for k in columns if len(self.chains[k]) > level + 1]
        return frozenset(dummies)

    def margin(self, entries: FloatArray, dummies: frozenset[int]) -> float:
        """Return how far the set is from singular: its determinant over the best set's, the least of all levels."""
        matrix = self._matrix(entries)
        least = 1.0
        for level in range(max(self.levels, default=0)):
            rows = [i for i, times in enumerate(self.levels) if times > level]
            mine = [
                k for k, chain in enumerate(self.chains) if len(chain) > level and chain[level] in dummies
            ]
            able = [k for k, chain in enumerate(self.chains) if len(chain) > level]
            best = float(np.prod(pivots(matrix[np.ix_(rows, able)])[1][: len(rows)]))
            own = float(np.prod(pivots(matrix[np.ix_(rows, mine)])[1])) if len(mine) == len(rows) else 0.0
            least = min(least, own / best if best > 0.0 else 0.0)
        return least

    def _matrix(self, entries: FloatArray) -> FloatArray:
        matrix = np.zeros((len(self.rows), len(self.columns)))
        for (i, j), value in zip(self.place, entries.tolist(), strict=True):
            matrix[i, j] = value
        matrix = matrix * self.weight
        size = np.max(np.abs(matrix), axis=1, keepdims=True)
        return np.asarray(matrix / np.where(size > 0.0, size, 1.0))


def pivots(matrix: FloatArray) -> tuple[list[int], FloatArray]:
    """Return the columns in the order of QR with column pivoting, and the size of R's diagonal."""
    import scipy.linalg.lapack

    count = min(matrix.shape)
    if not count:
        return list(range(matrix.shape[1])), np.zeros(0)
    dgeqp3: Any = getattr(scipy.linalg.lapack, "dgeqp3")  # noqa: B009 - made at run time
    factors, order = dgeqp3(matrix)[:2]
    return (order - 1).tolist(), np.abs(np.diagonal(factors))[:count]


def state_sets(
    rows: Sequence[Row],
    nodes: Nodes,
    derivative: Sequence[int],
    equation_derivative: Sequence[int],
    weight: Sequence[float],
) -> tuple[StateSets, list[tuple[Row, SX]]] | None:
    """Return the sets of states and the entries of their Jacobian; None where all entries are constant.

    ``weight[node]``: how gladly the derivative of a node's variable becomes a dummy.
    """
    origin = {successor: e for e, successor in enumerate(equation_derivative) if successor >= 0}
    lower = {successor: n for n, successor in enumerate(derivative) if successor >= 0}
    top = [e for e, successor in enumerate(equation_derivative) if successor < 0 and e in origin]
    highest = [n for n, successor in enumerate(derivative) if successor < 0 and n in lower]
    column = {n: j for j, n in enumerate(highest)}
    place: list[tuple[int, int]] = []
    entries: list[tuple[Row, SX]] = []
    for i, e in enumerate(top):
        row = rows[e]
        for node, slope in _slopes(row).items():
            if node in column:
                place.append((i, column[node]))
                entries.append((row, slope))
    if all(slope.is_constant() for _, slope in entries):
        return None
    levels = [_steps(e, origin) for e in top]
    chains = [_chain(n, lower) for n in highest]
    weights = np.array([weight[chain[-1]] for chain in chains])
    return StateSets(top, highest, place, levels, chains, weights), entries


def _slopes(row: Row) -> dict[int, SX]:
    """Return d(row)/d(node) over the row's own symbols, one for each node as in every row made by differentiation."""
    found: dict[int, SX] = {}
    for symbol, ref in zip(row.expression.symbols, row.refs, strict=True):
        if ref.kind == "node":
            slope = ca.jacobian(row.expression.value, symbol)
            if slope.nnz():
                found[ref.number] = slope
    return found


def _steps(equation: int, origin: dict[int, int]) -> int:
    count = 0
    while equation in origin:
        equation = origin[equation]
        count += 1
    return count


def _chain(node: int, lower: dict[int, int]) -> list[int]:
    """Return a derivative and those of lower order, down to the first."""
    chain = []
    while node in lower:
        chain.append(node)
        node = lower[node]
    return chain
