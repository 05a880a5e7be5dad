"""Linearisation of a model about a point: dx/dt = A x + B u, v = C x + D u, its modes and frequency responses.

From F(x', x, z, u) = 0 with algebraic unknowns z: (x', z) = -[F_x' F_z]^-1 (F_x x + F_u u), with the exact
Jacobians of the generated code. Participation factors as Perez-Arriaga, Verghese and Schweppe (1982), IEEE Trans.
Power App. Syst. 101, 3117-3125.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from arthur_acausal.codegen.compiled import CompiledDAE
from arthur_acausal.codegen.refine import Rows, refine
from arthur_acausal.errors import StructureError, UsageError

if TYPE_CHECKING:
    from arthur_acausal.result.chain import Piece
    from arthur_acausal.solve.trajectory import Trajectory

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

SHARE = 0.05  # a state takes part in a mode from this share on
SINGULAR = 1e-14  # reciprocal condition of the equilibrated matrix


@dataclass(frozen=True, slots=True)
class Mode:
    """One eigenvalue [1/s], or the upper one of a conjugate pair, and the states that take part in it.

    ``frequency`` [Hz] is that of the undamped oscillation, |eigenvalue| / 2 pi; ``damping`` the damping ratio: 1
    for a decaying real eigenvalue, 0 for an integrator. ``participation``: shares by state, largest first, sum 1 over
    all states, of which those from `SHARE` on are listed.
    """

    eigenvalue: complex
    frequency: float
    damping: float
    participation: dict[str, float]


@dataclass(frozen=True, slots=True)
class LinearModel:
    """dx/dt = A x + B u, v = C x + D u for small deviations from the point at time ``t``; all in SI."""

    t: float
    states: list[str]
    inputs: list[str]
    outputs: list[str]
    A: FloatArray
    B: FloatArray
    C: FloatArray
    D: FloatArray
    state_values: FloatArray

    def eigenvalues(self) -> ComplexArray:
        """Return the eigenvalues of A [1/s], by descending real part."""
        values: ComplexArray = np.zeros(0, dtype=np.complex128)
        if self.states:
            values = np.asarray(np.linalg.eigvals(self.A), dtype=np.complex128)
        return values[np.lexsort((values.imag, -values.real))]

    def modes(self) -> list[Mode]:
        """Return the modes, slowest first; one for each conjugate pair."""
        if not self.states:
            return []
        found_values, right = np.linalg.eig(self.A)
        values = np.asarray(found_values, dtype=np.complex128)
        try:
            left = np.linalg.inv(right).T
        except np.linalg.LinAlgError:  # a defective matrix: its eigenvectors do not span
            left = np.linalg.pinv(right).T
        shares = np.abs(right * left)
        shares = shares / np.maximum(shares.sum(axis=0), np.finfo(float).tiny)
        found = []
        for k in np.argsort(np.abs(values)):
            if values[k].imag < 0.0:
                continue
            order = np.argsort(-shares[:, k])
            part = {self.states[i]: float(shares[i, k]) for i in order if shares[i, k] >= SHARE}
            size = float(abs(values[k]))
            damping = float(-values[k].real / size) if size > 0.0 else 0.0
            found.append(Mode(complex(values[k]), size / (2 * np.pi), damping, part))
        return found

    def response(self, frequencies: ArrayLike) -> ComplexArray:
        """Return the frequency response (n_frequencies, n_outputs, n_inputs) at the frequencies [Hz]."""
        s = 2j * np.pi * np.atleast_1d(np.asarray(frequencies, dtype=float))
        eye = np.eye(len(self.states))
        return np.array(
            [self.C @ np.linalg.solve(x * eye - self.A, self.B.astype(complex)) + self.D for x in s]
        )


def linearize(
    dae: CompiledDAE, trajectory: Trajectory, at: float | None = None, outputs: Sequence[str] | None = None
) -> LinearModel:
    """Linearise about a point of a trajectory: the time ``at`` [s] nearest to an output, by default the last.

    ``outputs``: paths of any variables; by default all states. Inputs are the model's external inputs.

    Raises UsageError for a time outside of the trajectory, StructureError where the point is singular.
    """
    row = _row(trajectory, at)
    x = trajectory
    part = slice(row, row + 1)
    rows = Rows(x.t[part], x.y[part], x.yp[part], x.p, x.u[part], x.z[part], x.m[part])
    y, yp = refine(dae, rows)
    point = dae.completed(Rows(rows.t, y, yp, rows.p, rows.u, rows.z, rows.m).arguments())
    fy, fyp, fu = (
        np.array(dae.functions[name](*point), dtype=float)
        for name in ("jacobian_y", "jacobian_yp", "jacobian_u")
    )
    states = np.flatnonzero(dae.differential)
    other = np.flatnonzero(~dae.differential)
    matrix = np.hstack([fyp[:, states], fy[:, other]])
    solved = _solve(matrix, -np.hstack([fy[:, states], fu]), float(x.t[row]))
    n = len(states)
    a_b, z_xu = solved[:n], solved[n:]
    names = [dae.y_paths[k] for k in states]
    wanted = names if outputs is None else list(outputs)
    c_d = _outputs(dae, wanted, point, states, other, a_b, z_xu)
    return LinearModel(
        float(x.t[row]),
        names,
        list(dae.u_paths),
        wanted,
        a_b[:, :n],
        a_b[:, n:],
        c_d[:, :n],
        c_d[:, n:],
        y[0, states],
    )


def linearize_run(
    pieces: Sequence[Piece], at: float | None = None, outputs: Sequence[str] | None = None
) -> LinearModel:
    """Linearise about a point of a run: in the system whose states were chosen there; see ``linearize``."""
    if not pieces:
        raise UsageError(
            "the solution was read from a file: it has no equations", remedy="simulate the model anew"
        )
    chosen = pieces[-1]
    if at is not None:
        chosen = next((p for p in reversed(pieces) if p.trajectory.t[0] <= at), pieces[0])
    return linearize(chosen.dae, chosen.trajectory, at, outputs)


def _solve(matrix: FloatArray, right: FloatArray, t: float) -> FloatArray:
    """Solve with rows and columns scaled. Raises StructureError where the matrix is singular or not finite."""
    rows = np.abs(matrix).max(axis=1, initial=0.0)
    rows[rows == 0.0] = 1.0
    scaled = matrix / rows[:, None]
    columns = np.abs(scaled).max(axis=0, initial=0.0)
    columns[columns == 0.0] = 1.0
    scaled = scaled / columns
    finite = bool(np.isfinite(scaled).all())
    if finite and (not matrix.size or np.linalg.cond(scaled, 1) < 1.0 / SINGULAR):
        return np.asarray(np.linalg.solve(scaled, right / rows[:, None]) / columns[:, None], dtype=np.float64)
    raise StructureError(
        f"the model cannot be linearised at t = {t:g} s",
        cause="its equations do not determine derivatives and algebraic unknowns there (singular Jacobian)"
        if finite
        else "its Jacobian is not finite there",
        remedy="choose another point: a little later, or away from the limit of a law",
    )


def _row(trajectory: Trajectory, at: float | None) -> int:
    if at is None:
        return len(trajectory.t) - 1
    if not trajectory.t[0] <= at <= trajectory.t[-1]:
        raise UsageError(f"t = {at:g} s is outside of the run, {trajectory.t[0]:g} to {trajectory.t[-1]:g} s")
    nearest = np.flatnonzero(np.abs(trajectory.t - at) == np.min(np.abs(trajectory.t - at)))
    return int(nearest[-1])


def _through_calls(
    dae: CompiledDAE, point: list[FloatArray], d_y: FloatArray, d_yp: FloatArray, d_u: FloatArray
) -> FloatArray:
    """Return the derivatives of the outputs of external functions by the chain rule, in the order of the calls."""
    outputs, slopes = point[7], np.asarray(point[8]).reshape(-1)
    found = np.zeros((outputs.size, d_y.shape[1]))
    for call in dae.calls:
        f = call.inputs
        by_argument = f.jacobian()(*point, f(*point))
        by_y, by_yp, by_u, by_e = (np.array(by_argument[k], dtype=float) for k in (1, 2, 4, 7))
        n, m = call.function.n_outputs, call.function.n_inputs
        own = slopes[call.slope : call.slope + n * m].reshape(n, m)
        inputs = by_y @ d_y + by_yp @ d_yp + by_u @ d_u + by_e @ found
        found[call.first : call.first + n] = own @ inputs
    return found


def _outputs(
    dae: CompiledDAE,
    paths: Sequence[str],
    point: list[FloatArray],
    states: NDArray[np.intp],
    other: NDArray[np.intp],
    a_b: FloatArray,
    z_xu: FloatArray,
) -> FloatArray:
    """Return [C D] of any variables: directly of y, yp and u, or by the chain rule through the eliminated ones."""
    n, n_u = len(states), len(dae.u_paths)
    d_y = np.zeros((dae.n, n + n_u))
    d_y[states, :n] = np.eye(n)
    d_y[other] = z_xu
    d_yp = np.zeros((dae.n, n + n_u))
    d_yp[states] = a_b
    d_u = np.hstack([np.zeros((n_u, n)), np.eye(n_u)])
    recovery = dae.recovery
    column = recovery.observed(*point)
    by_argument = recovery.observed.jacobian()(*point, column)  # in the order t, y, yp, p, u, z, m
    oy, oyp, ou = (np.array(by_argument[k], dtype=float) for k in (1, 2, 4))
    d_observed = oy @ d_y + oyp @ d_yp + ou @ d_u
    if dae.calls:
        d_observed += np.array(by_argument[7], dtype=float) @ _through_calls(dae, point, d_y, d_yp, d_u)
    table = {"y": d_y, "yp": d_yp, "u": d_u, "observed": d_observed}
    result = np.zeros((len(paths), n + n_u))
    for k, path in enumerate(paths):
        source = recovery.sources[recovery.find(path)]
        if source.kind in table:
            result[k] = source.sign * table[source.kind][source.index]
    return result
