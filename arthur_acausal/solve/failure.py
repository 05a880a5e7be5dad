"""From a failed integration to one clear message."""

from __future__ import annotations

import re

import numpy as np

from arthur_acausal.errors import SimulationError
from arthur_acausal.solve.callbacks import Monitor
from arthur_acausal.solve.diagnosis import listed, null_vectors, scaled_rows
from arthur_acausal.solve.ida import Stretch
from arthur_acausal.solve.newton import SparseMatrix, factorise
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.protocol import DAE, Evaluator, FloatArray, IntArray
from arthur_acausal.solve.trajectory import Trajectory

TINY = 1e-300
NO_FINITE = "give limits or smooth laws that keep the equation in its range, or a smaller max_step"
TOLERANCE = (
    "check the nominal values and tolerances; a smooth law in place of a jump; relations that make events"
)

# IDA's return flags (SUNDIALS manual, IDA constants): what it means, and what may help.
MEANING = {
    -1: ("too many steps between two output times", "raise max_steps, or loosen rtol"),
    -2: ("more accuracy is asked for than double precision has", "raise rtol or atol"),
    -3: ("the error test failed repeatedly: no step is short enough", TOLERANCE),
    -4: ("Newton's iteration did not converge: no step is short enough", TOLERANCE),
    -5: ("the linear solver could not be started", "choose another linear_solver"),
    -6: ("the linear solver could not factorise the Jacobian", "choose another linear_solver"),
    -7: ("the linear solver failed", "choose another linear_solver"),
    -14: ("the residual or the linear solver failed and could not recover", TOLERANCE),
}


class SolverFailure(SimulationError):  # noqa: N818 - the name says what happened
    """The integration stopped early; `trajectory` holds what was computed up to there."""

    trajectory: Trajectory | None = None


class SolverInterrupted(KeyboardInterrupt):
    """Ctrl-C; `trajectory` holds what was computed up to there."""

    def __init__(self, trajectory: Trajectory) -> None:
        super().__init__(trajectory.message)
        self.trajectory = trajectory


def too_many_steps(monitor: Monitor, options: SolverOptions, suspect: str) -> SolverFailure:
    """The failure of a run that used up its steps."""
    return SolverFailure(
        f"more than {options.max_steps} steps; stopped at t = {monitor.t:.9g} s with steps of {monitor.h:.2g} s",
        cause=suspect,
        remedy="raise max_steps, loosen rtol, or check what moves that fast",
    )


def integration_failure(
    dae: DAE, evaluator: Evaluator, monitor: Monitor, stretch: Stretch, t: float, suspect: str
) -> SolverFailure:
    """The failure that IDA reports; t is the time of the last good values, `suspect` names what limits the step."""
    meaning, remedy = MEANING.get(stretch.flag, (stretch.message, ""))
    if monitor.halted == "stalled":
        meaning, remedy = "the steps have become as small as the rounding of time", TOLERANCE
    found = re.search(r"\bh = ([-+.\deE]+)", stretch.message)
    step = abs(float(found[1])) if found else monitor.h
    cause = suspect
    offence = monitor.offence
    if offence is not None and offence.t > t:
        told = listed(offence.labels, "; ")
        cause = f"no finite value at t = {offence.t:.9g} s: {told}; {_state(dae, offence.y, offence.rows)}"
        what = "an external function" if offence.calls else "an equation"
        meaning, remedy = f"{what} has no finite value", NO_FINITE
    elif monitor.jacobian_offence is not None and monitor.jacobian_offence[0] > t:
        row = int(dae.sparsity.row[monitor.jacobian_offence[1]])
        column = int(np.searchsorted(dae.sparsity.colind, monitor.jacobian_offence[1], side="right")) - 1
        cause = f"{dae.row_labels[row]} has no finite derivative with respect to {dae.y_paths[column]}"
        meaning, remedy = "the Jacobian has a value that is not finite", NO_FINITE
    elif stretch.flag in (-4, -6, -7, -14):
        cause = _singular(dae, evaluator, step) or suspect
    return SolverFailure(
        f"integration failed at t = {t:.9g} s with a step of {step:.2g} s: {meaning}",
        cause=cause,
        remedy=remedy,
    )


def suspect(
    dae: DAE, evaluator: Evaluator, t: float, y: FloatArray, yp: FloatArray, rtol: float, atol: FloatArray
) -> str:
    """Which variable's error dominates, and which equation's residual, judged from the last trial state.

    `y`, `yp` are the last good values at t. What the trial state differs from the straight line through them is,
    in units of the tolerance, of the size of the error estimate.
    """
    trial = evaluator.y.copy()
    h = max(float(evaluator.t[0]) - t, 0.0)
    if not dae.n or not np.isfinite(trial).all():
        return ""
    weight = rtol * np.abs(y) + atol
    error = np.abs(trial - y - h * np.where(dae.differential, yp, 0.0)) / weight
    k = int(np.argmax(error))
    told = f"the error of {dae.y_paths[k]} dominates (it is {y[k]:.6g} at t = {t:.9g} s)"
    residual = evaluator.residual().copy()
    evaluator.cj[0] = 1.0 / max(h, TINY)
    matrix = _matrix(dae, evaluator.jacobian())
    if h > 0.0 and np.isfinite(residual).all() and np.isfinite(matrix.values).all():
        scaled = np.abs(scaled_rows(matrix, residual, weight))
        row = int(np.argmax(scaled))
        if scaled[row] > 1.0:
            told += f"; the largest residual is that of {dae.row_labels[row]}"
    return told


def _singular(dae: DAE, evaluator: Evaluator, step: float) -> str:
    """Names the unknowns and equations of a singular iteration matrix; empty if it is regular."""
    if not np.isfinite(evaluator.y).all() or not step > 0.0:
        return ""
    evaluator.cj[0] = 1.0 / step
    matrix = _matrix(dae, evaluator.jacobian())
    scale = np.ones(dae.n)
    if not np.isfinite(matrix.values).all() or not factorise(matrix, scale)[1]:
        return ""
    unknowns, rows = null_vectors(matrix, scale)
    return (
        f"the Jacobian is singular: {listed([dae.y_paths[j] for j in unknowns])} not determined by "
        f"{listed([dae.row_labels[i] for i in rows], '; ')}"
    )


def _matrix(dae: DAE, values: FloatArray) -> SparseMatrix:
    pattern = dae.sparsity
    columns = np.repeat(np.arange(dae.n), np.diff(pattern.colind))
    return SparseMatrix(values.copy(), np.asarray(pattern.row, np.intp), columns, pattern.colind)


def _state(dae: DAE, y: FloatArray, rows: IntArray) -> str:
    """Values of the unknowns in these rows."""
    columns = np.repeat(np.arange(dae.n), np.diff(dae.sparsity.colind))
    present = np.unique(columns[np.isin(dae.sparsity.row, rows)])
    return "there " + listed([f"{dae.y_paths[int(j)]} = {y[j]:.6g}" for j in present])
