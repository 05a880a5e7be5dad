"""Refinement: algebraic unknowns and derivatives solved anew from the states at every output.

Between its steps the integrator interpolates: states are within the tolerance, but y' and the algebraic unknowns
then fulfil no equation exactly. Newton's method on F(t, y, y', ...) = 0 with the states held makes constraints and
balances hold to rounding.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from arthur_acausal.codegen.calls import Completion
from arthur_acausal.codegen.compiled import CompiledDAE
from arthur_acausal.codegen.kernel import Kernel
from arthur_acausal.codegen.threads import one_thread

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

DENSE_UP_TO = 200  # unknowns: batches of dense systems; above, one sparse system after the other
BATCH = 4_000_000  # matrix entries at once
ITERATIONS = 8
GAIN = 0.5  # what is left of the residual, at most, where another iteration is worth while


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

    def part(self, rows: slice | IntArray) -> Rows:
        """Return some of the times."""
        return Rows(
            self.t[rows], self.y[rows], self.yp[rows], self.p, self.u[rows], self.z[rows], self.m[rows]
        )

    def arguments(self) -> list[FloatArray]:
        """Return the kernels' arguments, one column a time."""
        n = len(self.t)
        p = np.repeat(self.p.reshape(-1, 1), n, axis=1)
        return [self.t.reshape(1, -1), self.y.T, self.yp.T, p, self.u.T, self.z.T, self.m.T]


@one_thread()
def refine(dae: CompiledDAE, rows: Rows) -> tuple[FloatArray, FloatArray]:
    """Return (y, y') with the algebraic entries of y and the derivatives of states solved anew from the states.

    Where Newton's method does not reduce the residual (a singular point), the integrator's values stay.
    """
    y, yp = rows.y.copy(), rows.yp.copy()
    if not dae.n or not len(rows.t):
        return y, yp
    complete = dae.completion(exact=False)
    size = max(1, BATCH // dae.n**2) if dae.n <= DENSE_UP_TO else 1
    for first in range(0, len(rows.t), size):
        part = slice(first, first + size)
        y[part], yp[part] = _newton(dae, rows.part(part), complete)
    return y, yp


def _newton(dae: CompiledDAE, rows: Rows, complete: Completion) -> tuple[FloatArray, FloatArray]:
    """Newton's method, with the derivatives of external functions, which cost most, kept from its first iteration."""
    differential, needs = dae.differential, dae.needs
    y, yp = rows.y.copy(), rows.yp.copy()
    going = np.arange(len(rows.t))  # the times at which there is something to gain
    arguments = complete(rows.arguments(), needs.get("residual"))
    external = arguments[len(rows.arguments()) :]  # e and d, or none
    if external and "solving" in needs:
        external[1] = complete(rows.arguments(), needs["solving"])[-1]
    value = _residual(dae, arguments)
    for _ in range(ITERATIONS):
        now = replace(rows, y=y, yp=yp).part(going)
        step = _steps(dae, now, [x[:, going] for x in external], value[going])
        trial_y = np.where(differential, now.y, now.y - step)
        trial_yp = np.where(differential, now.yp - step, now.yp)
        arguments = complete(replace(now, y=trial_y, yp=trial_yp).arguments(), needs.get("residual"))
        new = _residual(dae, arguments)
        before, after = (np.linalg.norm(r, axis=1) for r in (value[going], new))
        better = after < before  # False where not finite
        taken = going[better]
        y[taken], yp[taken], value[taken] = trial_y[better], trial_yp[better], new[better]
        if external:
            external[0][:, taken] = arguments[-2][:, better]
        going = going[(after < GAIN * before) & (after > 0.0)]
        if not going.size:
            break
    return y, yp


def _residual(dae: CompiledDAE, arguments: list[FloatArray]) -> FloatArray:
    """Return F (nt, n)."""
    return _at_all(dae.functions["residual"], arguments)


def _steps(dae: CompiledDAE, rows: Rows, external: list[FloatArray], value: FloatArray) -> FloatArray:
    """Return Newton's steps (nt, n) for the unknowns: y' of states, y of algebraic variables."""
    count, n = len(rows.t), dae.n
    arguments = [*rows.arguments(), *external]
    dy, dyp = (_at_all(dae.functions[name], arguments) for name in ("jacobian_y", "jacobian_yp"))
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


def _at_all(function: ca.Function, arguments: list[FloatArray]) -> FloatArray:
    """Return the nonzeros (nt, nnz) of a function at all times.

    One call after the other: CasADi's map copies its matrices element by element, which cost ten times as much.
    """
    point = [np.zeros(function.nnz_in(i)) for i in range(function.n_in())]
    kernel = Kernel(function, point)
    values = np.empty((arguments[0].shape[1], function.nnz_out(0)))
    columns = [np.ascontiguousarray(np.transpose(a)) for a in arguments]
    for k in range(len(values)):
        for array, column in zip(point, columns, strict=True):
            array[:] = column[k]
        values[k] = kernel()
    return values


def _sparse_step(dae: CompiledDAE, entries: FloatArray, right: FloatArray) -> FloatArray:
    from scipy.sparse import csc_matrix
    from scipy.sparse.linalg import splu

    matrix = csc_matrix((entries, dae.sparsity.row, dae.sparsity.colind), shape=(dae.n, dae.n))
    try:
        return np.asarray(splu(matrix).solve(right))
    except RuntimeError:  # exactly singular
        return np.zeros(dae.n)
