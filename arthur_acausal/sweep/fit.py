"""Calibration: parameters for which a model comes closest to measurements, by least squares."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.errors import SimulationError, UsageError
from arthur_acausal.result.atomic import write_atomically
from arthur_acausal.sweep.carry_out import How
from arthur_acausal.sweep.execute import GOOD
from arthur_acausal.sweep.plan import Plan
from arthur_acausal.sweep.search import Evaluations, Unknowns, evaluations

FloatArray = NDArray[np.float64]

STEP = 1e-4  # of a parameter's range, for the finite differences of the Jacobian


@dataclass(frozen=True, slots=True)
class Fitted:
    """One parameter: its value (SI), standard error, and whether it stands at a bound of its range."""

    path: str
    value: float
    error: float
    at_bound: bool


@dataclass(frozen=True, slots=True)
class Fit:
    """What a calibration found.

    Attributes
    ----------
    parameters : the best ones.
    rms : of the residuals of each variable, in its own unit.
    evaluations : how many runs it took.
    success, message : whether the search converged, and what it says.
    """

    parameters: list[Fitted]
    rms: Mapping[str, float]
    evaluations: int
    success: bool
    message: str


def fit(plan: Plan, measured: Path, match: Mapping[str, str], folder: Path, how: How, most: int = 50) -> Fit:
    """Find the parameters in the ranges of ``plan.specification.vary`` for which the model is closest to a file.

    Parameters
    ----------
    measured : CSV with a column "time" [s] and one for each variable, in SI.
    match : variable -> column. Each is weighed by the standard deviation of its measurements.
    folder : where every evaluation is kept as a row, and the result as ``fit.json``.
    most : iterations.

    Trust region reflective (Branch, Coleman and Li, 1999), from the middle of the ranges; forward differences, whose
    runs go to the workers together. Standard errors by the linearised model at the optimum.
    """
    import scipy.optimize

    least_squares: Any = scipy.optimize.least_squares  # whose annotation knows a Jacobian by its name only

    times, columns = _read(measured, match, plan.specification.stop_time)
    output = plan.specification.output.model_copy(
        update={"variables": tuple(match), "trajectories": True, "reductions": ()}
    )
    plan = Plan(plan.specification.model_copy(update={"output": output}), plan.folder, plan.find)
    spread = np.array([max(float(np.std(columns[v])), 1e-300) for v in match])
    target = np.column_stack([columns[v] for v in match])
    with evaluations(plan, folder, how, "fit", times) as (unknowns, evaluate):
        problem = _Problem(unknowns, evaluate, target, spread, list(match))
        found = least_squares(
            problem.residual,
            np.full(len(unknowns.names), 0.5),
            problem.jacobian,
            bounds=(0.0, 1.0),
            max_nfev=most,
        )
        residual = problem.residual(found.x).reshape(target.shape)
        result = Fit(
            _fitted(unknowns, found, target.size),
            {v: float(np.sqrt(np.mean((residual[:, k] * spread[k]) ** 2))) for k, v in enumerate(match)},
            evaluate.count,
            bool(found.success),
            str(found.message),
        )
    write_atomically(folder / "fit.json", json.dumps(asdict(result), indent=1).encode())
    return result


class _Problem:
    """Residuals and their Jacobian over the unknowns scaled to 0...1; remembers the latest point."""

    def __init__(
        self,
        unknowns: Unknowns,
        evaluate: Evaluations,
        target: FloatArray,
        spread: FloatArray,
        names: list[str],
    ) -> None:
        self._unknowns, self._evaluate = unknowns, evaluate
        self._target, self._spread, self._names = target, spread, names
        self._known: dict[bytes, FloatArray] = {}

    def residual(self, x: FloatArray) -> FloatArray:
        return np.asarray(self._at(x[None])[0])

    def jacobian(self, x: FloatArray) -> FloatArray:
        steps = np.where(x + STEP <= 1.0, STEP, -STEP)
        points = np.vstack([x[None], x + np.diag(steps)])
        values = self._at(points)
        return np.asarray(((values[1:] - values[0]) / steps[:, None]).T)

    def _at(self, points: FloatArray) -> FloatArray:
        new = [p for p in points if p.tobytes() not in self._known]
        if new:
            u = self._unknowns
            outcomes = self._evaluate(u.low + np.array(new) * (u.high - u.low))
            for point, outcome in zip(new, outcomes, strict=True):
                at = u.low + point * (u.high - u.low)
                told = ", ".join(f"{n} = {v:.5g}" for n, v in zip(u.names, at.tolist(), strict=True))
                values = outcome.trajectory
                if outcome.status not in GOOD or values is None or not np.isfinite(values).all():
                    cause = outcome.error or f"it has no finite values beyond t = {outcome.end_time:g} s"
                    raise SimulationError(f"the run at {told} cannot be compared", cause=cause)
                self._known[point.tobytes()] = ((values - self._target) / self._spread).reshape(-1)
        return np.array([self._known[p.tobytes()] for p in points])


def _fitted(unknowns: Unknowns, found: Any, measurements: int) -> list[Fitted]:
    span = unknowns.high - unknowns.low
    free = max(measurements - span.size, 1)
    covariance = np.linalg.pinv(found.jac.T @ found.jac) * 2.0 * found.cost / free
    errors = np.sqrt(np.maximum(np.diag(covariance), 0.0)) * span
    return [
        Fitted(
            name, float(unknowns.low[k] + found.x[k] * span[k]), float(errors[k]), bool(found.active_mask[k])
        )
        for k, name in enumerate(unknowns.names)
    ]


def _read(
    file: Path, match: Mapping[str, str], stop_time: float
) -> tuple[list[float], dict[str, FloatArray]]:
    from arthur_acausal.solve.table import Table

    if not match:
        raise UsageError("nothing to match", remedy="--match VARIABLE=COLUMN")
    columns = {}
    times: list[float] = []
    for variable, column in match.items():
        table = Table.from_csv(file, column=column)
        times, columns[variable] = table.times.tolist(), np.array(table.values)
    if times[-1] > stop_time * (1.0 + 1e-12) or not math.isfinite(times[0]):
        raise UsageError(f"{file} reaches to {times[-1]:g} s, and the run ends at {stop_time:g} s")
    return times, columns
