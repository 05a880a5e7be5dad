"""What to tell the user when the equations at one instant have no solution, or too many."""

from __future__ import annotations

import numpy as np

from arthur_acausal.errors import InitializationError
from arthur_acausal.solve.conditions import Conditions
from arthur_acausal.solve.consistent import ConsistentSystem
from arthur_acausal.solve.diagnosis import listed, null_vectors, scaled_rows
from arthur_acausal.solve.newton import Index, Solved
from arthur_acausal.solve.protocol import DAE, Evaluator

NEARER = "give start values inside the range of the equations and nearer to the solution"
WORST = 5  # residuals in one message


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
    dae: DAE, evaluator: Evaluator, system: ConsistentSystem, solved: Solved, remedy: str = NEARER
) -> InitializationError:
    """The error for equations at one instant that are not solved."""
    rows = row_names(dae, system)
    residual = system.residual(system.unknowns()).copy()
    bad = np.flatnonzero(~np.isfinite(residual))
    if solved.reason == "not finite" or bad.size:
        calls = evaluator.external.without_value() if evaluator.external is not None else ()
        written = evaluator.blamed([i for i in bad.tolist() if i < dae.n])
        told = listed(calls or [*written, *(rows[i] for i in bad.tolist() if i >= dae.n)], "; ")
        return InitializationError(
            f"at t = {evaluator.t[0]:g} s these have no finite value: {told}",
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
    worst = np.argsort(-np.abs(scaled), kind="stable")[:WORST]
    told = "; ".join(f"{rows[i]}: {residual[i]:.3g} (scaled {scaled[i]:.1g})" for i in worst.tolist())
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


def undetermined(dae: DAE, conditions: Conditions) -> InitializationError:
    """The error for unknowns of the initial system that nothing determines."""
    n = dae.n
    names = [dae.y_paths[j] if j < n else f"der({dae.y_paths[j - n]})" for j in conditions.undetermined]
    rows = [dae.init_labels[i - n] for i in conditions.conflict if i >= n]
    told = f"these initial conditions determine more than there is: {listed(rows, '; ')}" if rows else ""
    return InitializationError(
        f"the equations and initial conditions determine nothing about {listed(names)}",
        cause=told,
        remedy="give an initial condition for it, or remove one that says too much elsewhere",
    )
