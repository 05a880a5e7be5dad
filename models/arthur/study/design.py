"""The runs of the study: a main table, and what is varied about it one thing at a time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from arthur_acausal.models.arthur.dimensions import JOINT_NAMES, Dimensions
from arthur_acausal.models.arthur.study.schemes import Scheme
from arthur_acausal.models.arthur.study.tasks import TASK, TASKS, Task

DISPLACED = 0.02
"""Most that a joint is displaced at the start [rad], by the seed."""
HORIZONS = (0.3, 0.0, 0.03, 0.09, 0.18)
"""How far ahead the plan is used [s]; the first is the schemes' own."""
ERRORS = (0.0, -0.2, -0.1, 0.1, 0.2)
"""By how much the model of a scheme that foresees errs [1]; see the power unit."""
VARIED = ("trot 0.5",)
"""Tasks at which set points, horizons and errors are varied."""


@dataclass(frozen=True, slots=True)
class Size:
    """How large a study is.

    Attributes
    ----------
    tasks : of the main table. seeds : of its core tasks. few : of the other tasks, and of what is varied.
    bare : tasks that are also run without the accumulator. horizons, errors : that are tried.
    set_points : how many of each scheme.
    """

    tasks: tuple[str, ...] = tuple(TASK)
    seeds: int = 10
    few: int = 3
    bare: tuple[str, ...] = ("stand", "trot 0.5")
    horizons: tuple[float, ...] = HORIZONS
    errors: tuple[float, ...] = ERRORS
    set_points: int = 5


QUICK = Size(tasks=("stand", "trot 0.3", "trot 0.5"), seeds=3, few=2, bare=(), horizons=(), errors=(), set_points=3)


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
    """Return the scheme's runs of the main table: every task, as the scheme is."""
    own = scheme.set_point.values[0]
    chosen = [TASK[name] for name in size.tasks]
    return [Case(task, k, own) for task in chosen for k in range(size.seeds if task.core else size.few)]


def varied_cases(scheme: Scheme, size: Size) -> list[Case]:
    """Return the scheme's runs with one thing changed: set point, accumulator, horizon, or error of the model."""
    own, *others = scheme.set_point.values[: size.set_points]
    seeds, varied = range(size.few), [TASK[name] for name in VARIED]

    def all_of(tasks: Sequence[Task]) -> Iterator[tuple[Task, int]]:
        return ((task, k) for task in tasks for k in seeds)

    cases = [Case(task, k, value) for value in others for task, k in all_of(varied)]
    bare = [TASK[name] for name in size.bare]
    cases += [Case(task, k, own, accumulator=False) for task, k in all_of(bare)]
    if scheme.foresees:
        cases += [Case(t, k, own, horizon=h) for h in size.horizons[1:] for t, k in all_of(varied)]
        cases += [Case(t, k, own, error=e) for e in size.errors[1:] for t, k in all_of(varied)]
    return cases


def specification(scheme: Scheme, cases: Sequence[Case]) -> dict[str, Any]:
    """Return the sweep of a scheme's runs, as `arthur_acausal.sweep.sweep` takes it."""
    point = scheme.set_point
    vary: dict[str, list[Any]] = {
        "task": [TASKS.index(case.task) for case in cases],
        "noise": [case.seed for case in cases],
        "duration": [case.task.end for case in cases],
        "shove.F": [case.task.push for case in cases],
        "terrain": ["slope" if case.task.slope else "flat" for case in cases],
        "accumulator": [case.accumulator for case in cases],
        point.path: [case.set_point * point.unit for case in cases],
    }
    if scheme.foresees:
        vary |= {
            "unit.horizon": [case.horizon for case in cases],
            "unit.model_error": [case.error for case in cases],
        }
    poses = [pose(case.seed) for case in cases]
    vary |= {f"body.{joint}_phi": [p[i] for p in poses] for i, joint in enumerate(JOINT_NAMES)}
    return {
        "vary": vary,
        "method": "zip",
        "set": {"scheme": scheme.name},
        "stop_time": max(case.task.end for case in cases) + 0.1,
        "tolerance": 1e-3,
        "output": {
            "trajectories": False,
            "interval": 0.01,
            "reductions": ["arthur_acausal.models.arthur.study.measures:measures"],
        },
    }


def pose(seed: int) -> list[float]:
    """Return the joints' angles at the start [rad]: standing, displaced by the seed."""
    shift = np.random.default_rng([seed, 1]).uniform(-DISPLACED, DISPLACED, len(JOINT_NAMES))
    return [float(x) for x in np.array(Dimensions().stand * 4) + shift]
