"""Damped Newton's method for the square systems of initialisation and events.

Natural monotonicity test: a step is shortened until the simplified correction, computed with the same factors, is
smaller than the correction. This does not depend on how the equations are scaled. Deuflhard (2011), Newton Methods
for Nonlinear Problems, sections 2.1.2 and 3.3.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.solve.protocol import FloatArray, IntArray

Index = NDArray[np.intp]
Solve = Callable[[FloatArray], FloatArray]
Matrix: TypeAlias = "FloatArray | SparseMatrix"

SMALLEST_DAMPING = 1e-8
ROUNDING = 1e5  # corrections up to this many tolerances may be rounding errors that do not shrink any more
SINGULAR = 1e-14  # reciprocal condition of the scaled matrix


class Square(Protocol):
    """A square system of equations with its scaled matrix."""

    def residual(self, w: FloatArray) -> FloatArray:
        """Residual at w; the array may be reused by the next call."""
        ...

    def matrix(self) -> Matrix:
        """Jacobian at the w of the last `residual` call, (k, k)."""
        ...


@dataclass(frozen=True, slots=True)
class Solved:
    """Outcome of `newton`.

    Attributes
    ----------
    w : (k,), the last iterate.
    reason : "" if solved, else "singular", "no progress", "iterations" or "not finite".
    iterations : number of Jacobians.
    correction : largest scaled correction at the end.
    factors : solves with the last Jacobian; None if there was none.
    """

    w: FloatArray
    reason: str
    iterations: int
    correction: float
    factors: Solve | None = None


def newton(
    system: Square,
    w: FloatArray,
    scale: FloatArray,
    low: FloatArray,
    high: FloatArray,
    tolerance: float,
    most: int,
) -> Solved:
    """Solve from w; every iterate stays between low and high, unless w lies outside them."""
    low, high = np.minimum(low, w), np.maximum(high, w)
    residual = system.residual(w).copy()
    if not np.isfinite(residual).all():
        return Solved(w, "not finite", 0, np.inf)
    size = full = np.inf
    for iteration in range(1, most + 1):
        matrix = system.matrix()
        solve, singular = factorise(matrix, np.maximum(np.abs(w), scale))
        step = -solve(residual)
        size, before = _size(step, w, scale), full
        full = size
        rounding = (
            0.5 * before < size <= ROUNDING * tolerance and not singular
        )  # so near, Newton's steps shrink fast
        if size <= tolerance or rounding or not np.isfinite(size):
            w = np.clip(w + step, low, high) if np.isfinite(size) else w
            return Solved(w, "singular" if singular else "", iteration, size, solve)
        found = _damped(system, solve, w, step, size, scale, low, high)
        if found is None:
            done = size <= ROUNDING * tolerance and not singular
            return Solved(
                w, "" if done else "singular" if singular else "no progress", iteration, size, solve
            )
        w, residual, correction = found
        size = _size(correction, w, scale)
        if size <= tolerance and not singular:
            return Solved(np.clip(w + correction, low, high), "", iteration, size, solve)
    return Solved(w, "iterations", most, size)


def _damped(
    system: Square,
    solve: Solve,
    w: FloatArray,
    step: FloatArray,
    size: float,
    scale: FloatArray,
    low: FloatArray,
    high: FloatArray,
) -> tuple[FloatArray, FloatArray, FloatArray] | None:
    """The next iterate, its residual and its simplified correction; None if no damping makes progress."""
    damping = 1.0
    while damping >= SMALLEST_DAMPING:
        trial = np.clip(w + damping * step, low, high)
        residual = system.residual(trial).copy()
        if np.isfinite(residual).all():
            correction = -solve(residual)
            if _size(correction, w, scale) <= (1.0 - 0.25 * damping) * size:
                return trial, residual, correction
        damping *= 0.5
    return None


def _size(step: FloatArray, w: FloatArray, scale: FloatArray) -> float:
    return float(np.max(np.abs(step) / np.maximum(np.abs(w), scale), initial=0.0))


@dataclass(frozen=True, slots=True)
class SparseMatrix:
    """A square matrix in compressed columns, `row` ascending in each column; `column` is that of each value."""

    values: FloatArray
    row: Index
    column: Index
    colind: IntArray

    @property
    def size(self) -> int:
        """Number of rows."""
        return self.colind.size - 1


def sparse(values: FloatArray, row: Index, column: Index, size: int) -> SparseMatrix:
    """Sort entries into columns; entries at the same place are added."""
    from scipy.sparse import coo_matrix

    matrix: Any = coo_matrix((values, (row, column)), shape=(size, size)).tocsc()
    matrix.sum_duplicates()
    columns = np.repeat(np.arange(size), np.diff(matrix.indptr))
    return SparseMatrix(matrix.data, matrix.indices.astype(np.intp), columns, matrix.indptr)


def as_sparse(matrix: Matrix) -> SparseMatrix:
    """The same matrix with its nonzero entries only."""
    if isinstance(matrix, SparseMatrix):
        return matrix
    row, column = np.nonzero(matrix)
    return sparse(matrix[row, column], row, column, len(matrix))


def equilibrated(matrix: Matrix, scale: FloatArray) -> tuple[Matrix, FloatArray]:
    """Columns times scale, then rows over their largest entry; and those largest entries."""
    if isinstance(matrix, SparseMatrix):
        values = matrix.values * scale[matrix.column]
        rows = np.zeros(matrix.size)
        np.maximum.at(rows, matrix.row, np.abs(values))
        rows[rows == 0.0] = 1.0
        return replace(matrix, values=values / rows[matrix.row]), rows
    scaled = matrix * scale
    rows = np.max(np.abs(scaled), axis=1, initial=0.0)
    rows[rows == 0.0] = 1.0
    return scaled / rows[:, None], rows


def factorise(matrix: Matrix, scale: FloatArray) -> tuple[Solve, bool]:
    """A solver for the matrix, and whether it is numerically singular (a dense solver then gives the least step)."""
    scaled, rows = equilibrated(matrix, scale)
    values = scaled.values if isinstance(scaled, SparseMatrix) else scaled
    if not np.isfinite(values).all():
        return (lambda b: np.full_like(b, np.nan)), True
    if isinstance(scaled, SparseMatrix):
        return _factorise_sparse(scaled, rows, scale)
    return _factorise_dense(scaled, rows, scale)


def _factorise_dense(scaled: FloatArray, rows: FloatArray, scale: FloatArray) -> tuple[Solve, bool]:
    from scipy.linalg import get_lapack_funcs

    if not scaled.size:
        return (lambda b: b), False
    getrf, getrs, gecon = get_lapack_funcs(("getrf", "getrs", "gecon"), (scaled,))
    lu, pivots, info = getrf(scaled)
    norm = np.max(np.sum(np.abs(scaled), axis=0))
    if info > 0 or gecon(lu, norm)[0] < SINGULAR:
        return (lambda b: scale * np.linalg.lstsq(scaled, b / rows, rcond=1e-12)[0]), True
    return (lambda b: scale * getrs(lu, pivots, b / rows)[0]), False


def _factorise_sparse(scaled: SparseMatrix, rows: FloatArray, scale: FloatArray) -> tuple[Solve, bool]:
    factors = superlu(scaled)
    if factors is None:
        return (lambda b: np.full_like(b, np.nan)), True
    pivots = np.abs(factors.U.diagonal())
    return (lambda b: scale * factors.solve(b / rows)), bool(pivots.min() < SINGULAR * pivots.max())


def superlu(matrix: SparseMatrix) -> Any:
    """SuperLU's factors; None if the matrix is exactly singular."""
    from scipy.sparse import csc_matrix
    from scipy.sparse.linalg import splu

    shape = (matrix.size, matrix.size)
    try:
        return splu(csc_matrix((matrix.values, matrix.row, matrix.colind), shape=shape))
    except RuntimeError:  # "Factor is exactly singular"
        return None
