"""The square systems that lead to a state of rest, and their matrices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from arthur_acausal.codegen.compiled import CompiledDAE, Evaluator
from arthur_acausal.solve.protocol import FloatArray

NULL = 1e-10  # singular value of the scaled matrix, to its largest, below which a direction is free


@dataclass(slots=True)
class Rest:
    """The bordered system for (y, r); works in place on the evaluator."""

    evaluator: Evaluator
    dae: CompiledDAE
    null: FloatArray
    origin: FloatArray
    scale: FloatArray

    def residual(self, w: FloatArray) -> FloatArray:
        """F and the conditions on the free directions."""
        n, e = self.dae.n, self.evaluator
        e.y[:] = w[:n]
        e.yp[:] = np.where(self.dae.differential, self.null @ w[n:], 0.0)
        closing = self.null.T @ ((w[:n] - self.origin) / self.scale**2)
        return np.concatenate([e.residual(), closing])

    def matrix(self) -> FloatArray:
        """[[F_y, F_yp N], [N^T / scale^2, 0]]."""
        k = self.null.shape[1]
        return np.block(
            [
                [dense(self.dae, self.evaluator.jacobian_y()), rates(self.dae, self.evaluator) @ self.null],
                [self.null.T / self.scale**2, np.zeros((k, k))],
            ]
        )


@dataclass(slots=True)
class Euler:
    """F(t, y, (y - before) / h) = 0 for y."""

    evaluator: Evaluator
    dae: CompiledDAE
    before: FloatArray
    h: float

    def residual(self, w: FloatArray) -> FloatArray:
        """F after a step."""
        e = self.evaluator
        e.y[:] = w
        e.yp[:] = np.where(self.dae.differential, (w - self.before) / self.h, 0.0)
        return e.residual()

    def matrix(self) -> FloatArray:
        """dF/dy + dF/dy' / h."""
        e = self.evaluator
        return dense(self.dae, e.jacobian_y()) + rates(self.dae, e) / self.h


def null_vectors(matrix: FloatArray) -> FloatArray:
    """Return orthonormal null vectors as columns; rows are scaled to a largest entry of 1."""
    if not np.isfinite(matrix).all():
        return np.zeros((matrix.shape[1], 0))
    rows = np.abs(matrix).max(axis=1, initial=0.0)
    rows[rows == 0.0] = 1.0
    _, values, right = np.linalg.svd(matrix / rows[:, None])
    small = values <= NULL * max(float(values.max(initial=0.0)), np.finfo(float).tiny)
    null: FloatArray = right[small].T
    return null


def dense(dae: CompiledDAE, entries: FloatArray) -> FloatArray:
    """Return the full matrix (n, n) of the entries of a Jacobian."""
    matrix = np.zeros((dae.n, dae.n))
    matrix[dae.sparsity.row, np.repeat(np.arange(dae.n), np.diff(dae.sparsity.colind))] = entries
    return matrix


def rates(dae: CompiledDAE, evaluator: Evaluator) -> FloatArray:
    """Return dF/dy'."""
    evaluator.cj[0] = 1.0
    return dense(dae, evaluator.jacobian_yp())
