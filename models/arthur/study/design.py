"""The runs of the study: a main table, and what is varied about it one thing at a time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from arthur_acausal.models.arthur.displaced import start_of
from arthur_acausal.models.arthur.study.schemes import Scheme
from arthur_acausal.models.arthur.study.tasks import TASK, TASKS, Task

HORIZONS = (0.3, 0.0, 0.06, 0.15)
"""How far ahead the plan is used [s]; the first is the schemes' own."""
ERRORS = (0.0, -0.2, 0.2)
"""By how much the model of a scheme that foresees errs [1]; see the power unit."""
TOLERANCE = 1e-3
"""Relative, of the integration: powers are those with 1e-4 within 3e-4, the energy closes within 1e-4."""
VARIED = "trot 0.5"
"""Task at which horizons, errors and set points are varied."""


@dataclass(frozen=True, slots=True)
class Size:
    """How large a study is.

    Attributes
    ----------
    tasks : of the main table. seeds : of its core tasks. few : of the other tasks, and of what is varied.
    bare : tasks that are also run without the accumulator. moved : tasks at which set points are varied.
    set_points : how many of each scheme. horizons, errors : that are tried.
    """

    tasks: tuple[str, ...] = tuple(TASK)
    seeds: int = 10
    few: int = 10
    bare: tuple[str, ...] = ("stand", VARIED)
    moved: tuple[str, ...] = (VARIED, "fastest")
    horizons: tuple[float, ...] = HORIZONS
    errors: tuple[float, ...] = ERRORS
    set_points: int = 4


QUICK = Size(
    tasks=("stand", "trot 0.3", VARIED),
    seeds=3,
    few=2,
    bare=(),
    moved=(VARIED,),
    horizons=(),
    errors=(),
    set_points=3,
)


@dataclass(frozen=True, slots=True)
class Case:
    """One run of a scheme; ``set_point`` in the scheme's unit."""

    task: Task
    seed: int
    set_point: float
    accumulator: bool = True
    horizon: float = HORIZONS[0]
    error: float = ERRORS[0]


def main_cases(scheme: Scheme, size: Size) -> list[Case]:
    """Return the scheme's runs of the main table: every task, as the scheme is.

    One that knows the demand needs a run that is recorded for each: it has the core tasks, with few seeds.
    """
    own, cases = scheme.set_point.values[0], []
    for task in (TASK[name] for name in size.tasks):
        if task.core or not scheme.knows:
            seeds = size.seeds if task.core and not scheme.knows else size.few
            cases += [Case(task, seed, own) for seed in range(seeds)]
    return cases


def varied_cases(scheme: Scheme, size: Size) -> list[Case]:
    """Return the scheme's runs with one thing changed: set point, horizon, or error of the model."""
    if scheme.knows:
        return []
    own, *others = spread(scheme.set_point.values, size.set_points)

    def seeded(*tasks: str) -> list[tuple[Task, int]]:
        return [(TASK[name], k) for name in tasks for k in range(size.few)]

    cases = [Case(task, k, value) for value in others for task, k in seeded(*size.moved)]
    if scheme.foresees:
        cases += [Case(task, k, own, horizon=h) for h in size.horizons[1:] for task, k in seeded(VARIED)]
    if scheme.models:
        cases += [Case(task, k, own, error=e) for e in size.errors[1:] for task, k in seeded(VARIED)]
    return cases


def bare_cases(scheme: Scheme, size: Size) -> list[Case]:
    """Return the scheme's runs without the accumulator."""
    if scheme.knows:
        return []
    own = scheme.set_point.values[0]
    return [Case(TASK[name], k, own, accumulator=False) for name in size.bare for k in range(size.few)]


PARTS = {"main": main_cases, "varied": varied_cases, "bare": bare_cases}
"""Each is a sweep of each scheme."""


def spread(values: Sequence[float], count: int) -> list[float]:
    """Return so many of some values, at most all: the first, the last, and those evenly between them."""
    count = min(count, len(values))
    if count < 2:
        return list(values[:1])
    return [values[round(k * (len(values) - 1) / (count - 1))] for k in range(count)]


def specification(scheme: Scheme, cases: Sequence[Case], demands: Sequence[str] = ()) -> dict[str, Any]:
    """Return the sweep of a scheme's runs, as `arthur_acausal.sweep.sweep` takes it.

    ``demands``: for a scheme that knows it, the file with the demand of each case.
    """
    point, with_gas = scheme.set_point, cases[0].accumulator  # the same for all of a part
    vary: dict[str, list[Any]] = {
        "task": [TASKS.index(case.task) for case in cases],
        "noise": [case.seed for case in cases],
        "duration": [case.task.end for case in cases],
        "shove.F": [case.task.push for case in cases],
        "terrain": ["slope" if case.task.slope else "flat" for case in cases],
        point.path: [case.set_point * point.unit for case in cases],
    }
    if scheme.foresees:
        vary["unit.horizon"] = [case.horizon for case in cases]
    if scheme.models:
        vary["unit.model_error"] = [case.error for case in cases]
    if demands:
        vary["demand"] = list(demands)
    starts = [start_of(case.seed) for case in cases]
    vary |= {path: [start[path] for start in starts] for path in starts[0]}
    return {
        "vary": vary,
        "method": "zip",
        "set": {"scheme": scheme.name, "accumulator": with_gas, **scheme.tuning(with_gas)},
        "stop_time": max(case.task.end for case in cases) + 0.1,
        "tolerance": TOLERANCE,
        "output": {
            "trajectories": False,
            "interval": 0.02,  # measures look at ten times as many instants, and at both sides of each sample
            "reductions": ["arthur_acausal.models.arthur.study.measures:measures"],
        },
    }
