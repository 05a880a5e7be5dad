"""Optimisation: the parameters for which a reduction is least or greatest, within ranges and other limits."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.errors import SimulationError, UsageError
from arthur_acausal.result.atomic import write_atomically
from arthur_acausal.sweep.carry_out import GOOD, How
from arthur_acausal.sweep.execute import Outcome
from arthur_acausal.sweep.plan import Plan
from arthur_acausal.sweep.search import evaluations

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
    sign = -1.0 if maximize else 1.0
    best: tuple[float, FloatArray, Outcome] | None = None
    failed = 0
    with evaluations(plan, folder, how, "optimize") as (unknowns, evaluate):

        def value(points: FloatArray) -> FloatArray:
            nonlocal best, failed
            points = np.atleast_2d(points.T)
            scores = []
            for point, outcome in zip(points, evaluate(points), strict=True):
                score = _score(outcome, objective, sign, bounds)
                failed += outcome.status not in GOOD
                scores.append(score)
                if outcome.status in GOOD and (best is None or score < best[0]):
                    best = score, point, outcome
            return np.array(scores)

        found: Any = differential_evolution(
            value,
            list(zip(unknowns.low.tolist(), unknowns.high.tolist(), strict=True)),
            maxiter=generations,
            popsize=population,
            rng=np.random.default_rng(plan.specification.seed),
            polish=False,
            updating="deferred",
            vectorized=True,
        )
        if best is None:
            raise SimulationError("every run failed", remedy=f"see the column error of {folder}")
        _, point, outcome = best
        result = Optimum(
            dict(zip(unknowns.names, point.tolist(), strict=True)),
            outcome.reductions[objective],
            {b.name: outcome.reductions[b.name] for b in bounds},
            evaluate.count,
            failed,
            bool(found.success) and all(b.violation(outcome.reductions[b.name]) == 0.0 for b in bounds),
            str(found.message),
        )
    write_atomically(folder / "optimum.json", json.dumps(asdict(result), indent=1).encode())
    return result


def _score(outcome: Outcome, objective: str, sign: float, limits: Sequence[_Limit]) -> float:
    if outcome.status not in GOOD or not math.isfinite(outcome.reductions.get(objective, math.nan)):
        return BAD
    broken = sum(limit.violation(outcome.reductions[limit.name]) for limit in limits)
    return 1e30 * (1.0 + broken) if broken > 0.0 else sign * outcome.reductions[objective]


def _limit(text: str) -> _Limit:
    match = _LIMIT.fullmatch(text)
    try:
        if match is None:
            raise ValueError
        return _Limit(match[1].strip(), 1.0 if match[2][0] == "<" else -1.0, float(match[3]))
    except ValueError:
        raise UsageError(f"{text!r} is no limit", remedy="write 'max(path) < 2e7', in SI") from None
