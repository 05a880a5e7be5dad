"""Refinement: algebraic unknowns and derivatives solved anew from the states at every output.

Between its steps the integrator interpolates: states are within the tolerance, but y' and the algebraic unknowns
then fulfil no equation exactly. Newton's method on F(t, y, y', ...) = 0 with the states held makes constraints and
balances hold to rounding.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.codegen.compiled import CompiledDAE

FloatArray = NDArray[np.float64]

DENSE_UP_TO = 200  # unknowns: batches of dense systems; above, one sparse system after the other
BATCH = 4_000_000  # matrix entries at once
ITERATIONS = 4


@dataclass(frozen=True, slots=True)
class Rows:
    """Arguments of the kernels at nt times: t (nt,), y, yp (nt, n), p, u, z, m (nt, .)."""

    t: FloatArray
    y: FloatArray
    yp: FloatArray
    p: FloatArray
    u: FloatArray
    z: FloatArray
    m: FloatArray

    def part(self, rows: slice) -> Rows:
        """Return some of the times."""
        return Rows(
            self.t[rows], self.y[rows], self.yp[rows], self.p, self.u[rows], self.z[rows], self.m[rows]
        )

    def arguments(self) -> list[FloatArray]:
        """Return the kernels' arguments, one column a time."""
        n = len(self.t)
        p = np.repeat(self.p.reshape(-1, 1), n, axis=1)
        return [self.t.reshape(1, -1), self.y.T, self.yp.T, p, self.u.T, self.z.T, self.m.T]


def refine(dae: CompiledDAE, rows: Rows) -> tuple[FloatArray, FloatArray]:
    """Return (y, y') with the algebraic entries of y and the derivatives of states solved anew from the states.

    Where Newton's method does not reduce the residual (a singular point), the integrator's values stay.
    """
    y, yp = rows.y.copy(), rows.yp.copy()
    if not dae.n or not len(rows.t):
        return y, yp
    size = max(1, BATCH // dae.n**2) if dae.n <= DENSE_UP_TO else 1
    for first in range(0, len(rows.t), size):
        part = slice(first, first + size)
        y[part], yp[part] = _newton(dae, rows.part(part))
    return y, yp


def _newton(dae: CompiledDAE, rows: Rows) -> tuple[FloatArray, FloatArray]:
    differential = dae.differential
    count = len(rows.t)
    residual = dae.functions["residual"].map(count)
    y, yp = rows.y.copy(), rows.yp.copy()
    now = Rows(rows.t, y, yp, rows.p, rows.u, rows.z, rows.m)
    value = (
        np.asarray(residual(*dae.completed(now.arguments(), "residual")), dtype=float).reshape(dae.n, count).T
    )
    for _ in range(ITERATIONS):
        step = _steps(dae, now, value)
        trial_y = np.where(differential, y, y - step)
        trial_yp = np.where(differential, yp - step, yp)
        trial = Rows(rows.t, trial_y, trial_yp, rows.p, rows.u, rows.z, rows.m)
        new = (
            np.asarray(residual(*dae.completed(trial.arguments(), "residual")), dtype=float)
            .reshape(dae.n, count)
            .T
        )
        better = np.linalg.norm(new, axis=1) < np.linalg.norm(value, axis=1)  # False where not finite
        y[better], yp[better], value[better] = trial_y[better], trial_yp[better], new[better]
        if not better.any():
            break
    return y, yp


def _steps(dae: CompiledDAE, rows: Rows, value: FloatArray) -> FloatArray:
    """Return Newton's steps (nt, n) for the unknowns: y' of states, y of algebraic variables."""
    count, n = len(rows.t), dae.n
    arguments = dae.completed(rows.arguments(), "solving")
    dy, dyp = (_entries(dae, name, arguments, count) for name in ("jacobian_y", "jacobian_yp"))
    column = np.repeat(np.arange(n), np.diff(dae.sparsity.colind))
    entries = np.where(dae.differential[column], dyp, dy)
    if n > DENSE_UP_TO:
        return _sparse_step(dae, entries[0], value[0]).reshape(1, n)
    matrix = np.zeros((count, n, n))
    matrix[:, dae.sparsity.row, column] = entries
    try:
        return np.asarray(np.linalg.solve(matrix, value[..., None])[..., 0], dtype=np.float64)
    except np.linalg.LinAlgError:
        each = [np.linalg.lstsq(a, b, rcond=None)[0] for a, b in zip(matrix, value, strict=True)]
        return np.asarray(each, dtype=np.float64)


def _entries(dae: CompiledDAE, name: str, arguments: list[FloatArray], count: int) -> FloatArray:
    """Return the nonzeros (nt, nnz) of a Jacobian at all times."""
    values = dae.functions[name].map(count)(*arguments)
    return np.array(values.nonzeros(), dtype=float).reshape(count, dae.sparsity.nnz)


def _sparse_step(dae: CompiledDAE, entries: FloatArray, right: FloatArray) -> FloatArray:
    from scipy.sparse import csc_matrix
    from scipy.sparse.linalg import splu

    matrix = csc_matrix((entries, dae.sparsity.row, dae.sparsity.colind), shape=(dae.n, dae.n))
    try:
        return np.asarray(splu(matrix).solve(right))
    except RuntimeError:  # exactly singular
        return np.zeros(dae.n)
