"""Consistent values at the start of a run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from arthur_acausal.errors import InitializationError
from arthur_acausal.solve.conditions import Conditions, choose
from arthur_acausal.solve.consistent import ConsistentSystem
from arthur_acausal.solve.diagnosis import listed, null_vectors, scaled_rows
from arthur_acausal.solve.modes import Modes
from arthur_acausal.solve.newton import Index, Solved
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.protocol import DAE, Attributes, Evaluator, FloatArray

NEARER = "give start values inside the range of the equations and nearer to the solution"
CONSISTENT = 1e-6  # scaled residual up to which a surplus initial condition counts as fulfilled


@dataclass(frozen=True, slots=True)
class Initialized:
    """What the initialisation did; the values themselves are in the evaluator."""

    iterations: int
    messages: list[str]


def initialize(
    dae: DAE,
    evaluator: Evaluator,
    attributes: Attributes,
    modes: Modes,
    options: SolverOptions,
) -> Initialized:
    """Find y, y', z and the relations' modes that fulfil all equations and initial conditions at evaluator.t.

    Raises InitializationError, naming equations and unknowns.
    """
    evaluator.y[:], evaluator.yp[:] = attributes.start, 0.0
    evaluator.z[:] = evaluator.zp[:] = attributes.z_start
    modes.update()
    conditions = choose(dae, evaluator, attributes)
    if conditions.undetermined:
        raise _undetermined(dae, conditions)
    free = np.setdiff1d(np.arange(dae.n), conditions.pinned)
    system = ConsistentSystem(dae, evaluator, attributes, free, conditions.rows)
    iterations = 0
    for _ in range(options.max_event_iterations):
        solved = system.solve(options.newton_tolerance, options.newton_iterations)
        iterations += solved.iterations
        if solved.reason:
            raise failure(dae, evaluator, system, solved, NEARER)
        changed = modes.assign_discrete() | modes.update()
        if not changed:
            break
    else:
        raise InitializationError(
            f"the relations do not settle in {options.max_event_iterations} iterations: {modes.last_changed()}",
            remedy=NEARER,
        )
    modes.settle()
    _check_surplus(dae, evaluator, attributes, conditions)
    return Initialized(iterations, _notices(dae, attributes, evaluator, conditions))


def unknown_names(dae: DAE, system: ConsistentSystem) -> list[str]:
    """Names of the system's unknowns, in order."""
    free: list[int] = system.free.tolist()
    states: list[int] = system.states.tolist()
    return [dae.y_paths[j] for j in free] + [f"der({dae.y_paths[j]})" for j in states]


def row_names(dae: DAE, system: ConsistentSystem) -> list[str]:
    """Names of the system's rows, in order."""
    conditions: list[int] = system.conditions.tolist()
    return [*dae.row_labels, *(dae.init_labels[k] for k in conditions)]


def failure(
    dae: DAE, evaluator: Evaluator, system: ConsistentSystem, solved: Solved, remedy: str
) -> InitializationError:
    """What to tell the user when the equations at one instant are not solved."""
    rows = row_names(dae, system)
    residual = system.residual(system.unknowns()).copy()
    bad = np.flatnonzero(~np.isfinite(residual))
    if solved.reason == "not finite" or bad.size:
        return InitializationError(
            f"at t = {evaluator.t[0]:g} s these have no finite value: {listed([rows[i] for i in bad.tolist()], '; ')}",
            cause=f"the values there are {_values(dae, evaluator, bad)}",
            remedy=remedy,
        )
    matrix, scale = system.matrix(), system.scale()
    scale = np.maximum(scale, np.abs(system.unknowns()))
    if solved.reason == "singular":
        unknowns, equations = null_vectors(matrix, scale)
        names = unknown_names(dae, system)
        return InitializationError(
            f"singular Jacobian at t = {evaluator.t[0]:g} s: the equations do not determine "
            f"{listed([names[j] for j in unknowns])}",
            cause=f"these equations depend on each other: {listed([rows[i] for i in equations], '; ')}",
            remedy="give the missing relation or initial condition, or remove what is said twice",
        )
    scaled = scaled_rows(matrix, residual, scale)
    worst = np.argsort(-np.abs(scaled), kind="stable")[:5].tolist()
    told = "; ".join(f"{rows[i]}: {residual[i]:.3g} (scaled {scaled[i]:.1g})" for i in worst)
    return InitializationError(
        f"no consistent values at t = {evaluator.t[0]:g} s after {solved.iterations} Newton iterations "
        f"({solved.reason}); largest residuals: {told}",
        remedy=remedy,
    )


def _values(dae: DAE, evaluator: Evaluator, rows: Index) -> str:
    """The values of the unknowns in some rows of F; of all where there are none."""
    columns = np.repeat(np.arange(dae.n), np.diff(dae.sparsity.colind))
    present = np.unique(columns[np.isin(dae.sparsity.row, rows)])
    chosen = present.tolist() or range(dae.n)
    return listed([f"{dae.y_paths[j]} = {evaluator.y[j]:.6g}" for j in chosen])


def _undetermined(dae: DAE, conditions: Conditions) -> InitializationError:
    n = dae.n
    names = [dae.y_paths[j] if j < n else f"der({dae.y_paths[j - n]})" for j in conditions.undetermined]
    return InitializationError(
        f"the equations and initial conditions determine nothing about {listed(names)}",
        cause=_conflict(dae, conditions) if conditions.conflict else "",
        remedy="give an initial condition for it, or remove one that says too much elsewhere",
    )


def _conflict(dae: DAE, conditions: Conditions) -> str:
    n = dae.n
    rows = [dae.init_labels[i - n] for i in conditions.conflict if i >= n]
    return f"these initial conditions determine more than there is: {listed(rows, '; ')}"


def _check_surplus(dae: DAE, evaluator: Evaluator, attributes: Attributes, conditions: Conditions) -> None:
    """Initial conditions that were left out must hold in the solution."""
    if not conditions.surplus:
        return
    values = evaluator.initial().copy()
    scale = _initial_scale(dae, evaluator, attributes)
    wrong = [k for k in conditions.surplus if not abs(values[k]) <= CONSISTENT * scale[k]]
    if wrong:
        told = "; ".join(f"{dae.init_labels[k]} (off by {values[k]:.6g})" for k in wrong)
        raise InitializationError(
            f"the initial conditions contradict each other: not fulfilled: {told}",
            cause=_conflict(dae, conditions),
            remedy="remove one of them, or replace a fixed start value by a guess",
        )


def _initial_scale(dae: DAE, evaluator: Evaluator, attributes: Attributes) -> FloatArray:
    """Largest change that the unknowns' magnitudes make in each initial condition."""
    row = np.asarray(dae.init_sparsity.row)
    column = np.repeat(np.arange(2 * dae.n), np.diff(dae.init_sparsity.colind))
    magnitude = np.maximum(np.abs(attributes.nominal), np.abs(evaluator.y))
    scale = np.zeros(dae.n_init)
    np.maximum.at(scale, row, np.abs(evaluator.initial_jacobian()) * np.tile(magnitude, 2)[column])
    return scale


def _notices(dae: DAE, attributes: Attributes, evaluator: Evaluator, conditions: Conditions) -> list[str]:
    """What was assumed."""
    messages = []
    if conditions.assumed.size:
        names = [f"{dae.y_paths[j]} = {evaluator.y[j]:g}" for j in conditions.assumed.tolist()]
        messages.append(f"no initial condition, start value taken: {listed(names)}")
    if conditions.surplus:
        labels = [dae.init_labels[k] for k in conditions.surplus]
        messages.append(f"initial conditions that say nothing new: {listed(labels)}")
    low, high = attributes.min, attributes.max
    outside = np.flatnonzero((evaluator.y < low) | (evaluator.y > high))
    if outside.size:
        names = [f"{dae.y_paths[j]} = {evaluator.y[j]:g}" for j in outside.tolist()]
        messages.append(f"initial values outside min and max: {listed(names)}")
    return messages
