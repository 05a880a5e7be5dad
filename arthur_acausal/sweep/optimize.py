"""Optimisation: the parameters for which a reduction is least or greatest, within ranges and other limits."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.errors import SimulationError, UsageError
from arthur_acausal.result.atomic import write_atomically
from arthur_acausal.sweep.carry_out import How
from arthur_acausal.sweep.execute import GOOD, Outcome
from arthur_acausal.sweep.plan import Plan
from arthur_acausal.sweep.search import Evaluations, evaluations

FloatArray = NDArray[np.float64]
_LIMIT = re.compile(r"\s*(.+\))\s*(<=|>=|<|>)\s*([^<>=]+)")
BAD = 1e300  # the objective of a run that fails: worse than any other, and still a number


@dataclass(frozen=True, slots=True)
class Optimum:
    """What an optimisation found: the parameters (SI), the objective, the limits' values, runs, and what it says."""

    parameters: dict[str, float]
    objective: float
    limits: dict[str, float]
    evaluations: int
    failed: int
    success: bool
    message: str


@dataclass(frozen=True, slots=True)
class _Limit:
    name: str
    sign: float  # +1: at most the bound
    bound: float

    def violation(self, value: float) -> float:
        """How far beyond the bound, relative to it."""
        return max(0.0, self.sign * (value - self.bound)) / (abs(self.bound) or 1.0)


def optimize(
    plan: Plan,
    objective: str,
    folder: Path,
    how: How,
    *,
    maximize: bool = False,
    limits: Sequence[str] = (),
    population: int = 10,
    generations: int = 30,
) -> Optimum:
    """Search the ranges of ``plan.specification.vary``.

    Differential evolution (Storn and Price, 1997), whose generations go to the workers whole; a run that fails is
    worse than any other. ``limits``, such as "max(p) < 2e7", come first: what breaks them less is better (Deb, 2000).

    Parameters
    ----------
    objective : a reduction.
    population : points of a generation, for each unknown.
    generations : at most.
    folder : where every evaluation is kept as a row, and the result as ``optimum.json``.

    Raises SimulationError where every run failed.
    """
    from scipy.optimize import differential_evolution

    bounds = [_limit(text) for text in limits]
    output = plan.specification.output.model_copy(
        update={"trajectories": False, "reductions": (objective, *(b.name for b in bounds))}
    )
    plan = Plan(plan.specification.model_copy(update={"output": output}), plan.folder, plan.find)
    with evaluations(plan, folder, how, "optimize") as (unknowns, evaluate):
        search = _Search(evaluate, objective, -1.0 if maximize else 1.0, bounds)
        found: Any = differential_evolution(
            search,
            list(zip(unknowns.low.tolist(), unknowns.high.tolist(), strict=True)),
            maxiter=generations,
            popsize=population,
            rng=np.random.default_rng(plan.specification.seed),
            polish=False,
            updating="deferred",
            vectorized=True,
        )
        if search.best is None:
            raise SimulationError("every run failed", remedy=f"see the column error of {folder}")
        _, point, values = search.best
        result = Optimum(
            dict(zip(unknowns.names, point.tolist(), strict=True)),
            values[objective],
            {b.name: values[b.name] for b in bounds},
            evaluate.count,
            search.failed,
            bool(found.success) and all(b.violation(values[b.name]) == 0.0 for b in bounds),
            str(found.message),
        )
    write_atomically(folder / "optimum.json", json.dumps(asdict(result), indent=1).encode())
    return result


class _Search:
    """What is least: the scores of points (unknowns, points); remembers the best one and how many runs failed."""

    def __init__(self, evaluate: Evaluations, objective: str, sign: float, limits: Sequence[_Limit]) -> None:
        self._evaluate, self._objective, self._sign, self._limits = evaluate, objective, sign, limits
        self.best: tuple[float, FloatArray, Mapping[str, float]] | None = None
        self.failed = 0

    def __call__(self, points: FloatArray) -> FloatArray:
        points = np.atleast_2d(points.T)
        scores = []
        for point, outcome in zip(points, self._evaluate(points), strict=True):
            score = _score(outcome, self._objective, self._sign, self._limits)
            self.failed += score == BAD
            scores.append(score)
            if score < BAD and (self.best is None or score < self.best[0]):
                self.best = score, point, outcome.reductions
        return np.array(scores)


def _score(outcome: Outcome, objective: str, sign: float, limits: Sequence[_Limit]) -> float:
    """Return what is to be least: `BAD` for a run that failed, or has no value of what is asked for."""
    values = outcome.reductions
    asked = [objective, *(limit.name for limit in limits)]
    if outcome.status not in GOOD or not all(math.isfinite(values.get(name, math.nan)) for name in asked):
        return BAD
    broken = sum(limit.violation(values[limit.name]) for limit in limits)
    return 1e30 * (1.0 + broken) if broken > 0.0 else sign * values[objective]


def _limit(text: str) -> _Limit:
    match = _LIMIT.fullmatch(text)
    try:
        if match is None:
            raise ValueError
        return _Limit(match[1].strip(), 1.0 if match[2][0] == "<" else -1.0, float(match[3]))
    except ValueError:
        raise UsageError(f"{text!r} is no limit", remedy="write 'max(path) < 2e7', in SI") from None
