"""Damped Newton's method for the square systems of initialisation and events.

Natural monotonicity test: a step is shortened until the simplified correction, computed with the same factors, is
smaller than the correction. This does not depend on how the equations are scaled. Deuflhard (2011), Newton Methods
for Nonlinear Problems, sections 2.1.2 and 3.3.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from arthur_acausal.solve.protocol import FloatArray

SMALLEST_DAMPING = 1e-8
ROUNDING = 1e5  # corrections up to this many tolerances may be rounding errors that do not shrink any more
SINGULAR = 1e-14  # reciprocal condition of the scaled matrix


class Square(Protocol):
    """A square system of equations with its scaled matrix."""

    def residual(self, w: FloatArray) -> FloatArray:
        """Residual at w; the array may be reused by the next call."""
        ...

    def matrix(self) -> Any:
        """Jacobian at the w of the last `residual` call: an (k, k) array, or a sparse matrix in columns."""
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
    """

    w: FloatArray
    reason: str
    iterations: int
    correction: float


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
    size = np.inf
    for iteration in range(1, most + 1):
        matrix = system.matrix()
        solve, singular = factorise(matrix, np.maximum(np.abs(w), scale))
        step = -solve(residual)
        size = _size(step, w, scale)
        if size <= tolerance or not np.isfinite(size):
            w = np.clip(w + step, low, high) if np.isfinite(size) else w
            return Solved(w, "singular" if singular else "", iteration, size)
        found = _damped(system, solve, w, step, size, scale, low, high)
        if found is None:
            done = size <= ROUNDING * tolerance and not singular
            return Solved(w, "" if done else "singular" if singular else "no progress", iteration, size)
        w, residual, correction = found
        size = _size(correction, w, scale)
        if size <= tolerance and not singular:
            return Solved(np.clip(w + correction, low, high), "", iteration, size)
    return Solved(w, "iterations", most, size)


def _damped(
    system: Square,
    solve: Callable[[FloatArray], FloatArray],
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


def equilibrated(matrix: FloatArray, scale: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Columns times scale, then rows over their largest entry; and those largest entries."""
    scaled = matrix * scale
    rows = np.max(np.abs(scaled), axis=1, initial=0.0)
    rows[rows == 0.0] = 1.0
    return scaled / rows[:, None], rows


def factorise(matrix: Any, scale: FloatArray) -> tuple[Callable[[FloatArray], FloatArray], bool]:
    """A solver for the matrix, and whether it is numerically singular (the solver then gives the least step)."""
    if isinstance(matrix, np.ndarray):
        return _factorise_dense(matrix, scale)
    return _factorise_sparse(matrix, scale)


def _factorise_dense(
    matrix: FloatArray, scale: FloatArray
) -> tuple[Callable[[FloatArray], FloatArray], bool]:
    from scipy.linalg import lapack

    if not matrix.size:
        return (lambda b: b), False
    scaled, rows = equilibrated(matrix, scale)
    if not np.isfinite(scaled).all():
        return (lambda b: np.full_like(b, np.nan)), True
    lu, pivots, info = lapack.dgetrf(scaled)
    norm = np.max(np.sum(np.abs(scaled), axis=0))
    if info > 0 or lapack.dgecon(lu, norm)[0] < SINGULAR:
        return (lambda b: scale * np.linalg.lstsq(scaled, b / rows, rcond=1e-12)[0]), True
    return (lambda b: scale * lapack.dgetrs(lu, pivots, b / rows)[0]), False


def _factorise_sparse(matrix: Any, scale: FloatArray) -> tuple[Callable[[FloatArray], FloatArray], bool]:
    from scipy.sparse import diags_array
    from scipy.sparse.linalg import splu

    scaled = (matrix @ diags_array(scale)).tocsr()
    rows = abs(scaled).max(axis=1).toarray().ravel()
    rows[rows == 0.0] = 1.0
    scaled = (diags_array(1.0 / rows) @ scaled).tocsc()
    if not np.isfinite(scaled.data).all():
        return (lambda b: np.full_like(b, np.nan)), True
    try:
        factors = splu(scaled)
    except RuntimeError:  # "Factor is exactly singular"
        return (lambda b: np.full_like(b, np.nan)), True
    pivots = np.abs(factors.U.diagonal())
    return (lambda b: scale * factors.solve(b / rows)), bool(pivots.min() < SINGULAR * pivots.max())
