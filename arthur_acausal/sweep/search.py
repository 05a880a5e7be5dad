"""Runs that an optimiser asks for: each one is a row of a store, evaluated by the same workers as a sweep's."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.errors import UsageError
from arthur_acausal.sweep import store as stores
from arthur_acausal.sweep.carry_out import How, about, backend, row_of
from arthur_acausal.sweep.design import Run
from arthur_acausal.sweep.execute import Outcome
from arthur_acausal.sweep.factor import Factor, parse_factor, quantity
from arthur_acausal.sweep.job import Job
from arthur_acausal.sweep.lock import Lock
from arthur_acausal.sweep.plan import Plan
from arthur_acausal.sweep.store import Store
from arthur_acausal.sweep.supply import Start
from arthur_acausal.sweep.task import Task

FloatArray = NDArray[np.float64]


class Unknowns:
    """What is searched: each factor of the specification from a low to a high value, in its own unit.

    Attributes
    ----------
    names : paths.
    low, high : (n,), in SI.
    """

    def __init__(self, plan: Plan) -> None:
        factors = {
            name: parse_factor(name, given, plan.folder) for name, given in plan.specification.vary.items()
        }
        if not factors:
            raise UsageError("nothing to search", remedy="--vary PATH=low:high")
        for name, factor in factors.items():
            if factor.distribution not in ("uniform", "loguniform"):
                raise UsageError(f"{name} is no range", remedy=f"--vary {name}=low:high")
        self.names = list(factors)
        self.low = self._si(plan, factors, 0)
        self.high = self._si(plan, factors, 1)

    def _si(self, plan: Plan, factors: Mapping[str, Factor], side: int) -> FloatArray:
        values = {name: quantity(f.arguments[side], f.unit) for name, f in factors.items()}
        columns = plan.task(_run(plan, 0, values))[1]
        return np.array([float(columns[name]) for name in factors])


def _run(plan: Plan, number: int, values: Mapping[str, Any]) -> Run:
    return Run(number, plan.specification.models[0], values)


class Evaluations:
    """Evaluates points of the unknowns, in SI, in batches; keeps each as a row.

    Attributes
    ----------
    count : evaluations so far.
    """

    def __init__(
        self, plan: Plan, unknowns: Unknowns, store: Store, start: Start, times: Sequence[float] = ()
    ) -> None:
        self._plan, self._unknowns, self._store, self._start = plan, unknowns, store, start
        self._times = tuple(times)
        self._job: Job | None = None  # that of all evaluations, with their times
        self.count = 0

    def __call__(self, points: FloatArray) -> list[Outcome]:
        """Return what comes of each point (k, n), in their order."""
        tasks, columns = [], {}
        for point in points:
            number = self.count
            self.count += 1
            values = dict(zip(self._unknowns.names, point.tolist(), strict=True))
            task, columns[number] = self._plan.task(_run(self._plan, number, values))
            self._job = self._job or replace(task.job, times=self._times)
            tasks.append(replace(task, job=self._job))
        first = tasks[0].number
        outcomes: dict[int, Outcome] = {}
        pending: Iterator[Task] = iter(tasks)
        for task, outcome in self._start(lambda: next(pending, None)):
            self._store.add(
                row_of(task.number, columns[task.number], outcome, task.attempts), None, task.number
            )
            outcomes[task.number - first] = outcome
        return [outcomes[k] for k in range(len(tasks))]


@contextmanager
def evaluations(
    plan: Plan, folder: Path, how: How, kind: str, times: Sequence[float] = ()
) -> Iterator[tuple[Unknowns, Evaluations]]:
    """Open a store for a search, and what evaluates points into it."""
    plan = replace(plan, chosen=[_run(plan, 0, {})])
    unknowns = Unknowns(plan)
    stores.make_folder(folder)
    with Lock(folder), backend(how, 10**9) as start:
        told = {**about(plan), "factors": unknowns.names, "search": kind}
        told["trajectories"] = {"variables": [], "units": [], "time": []}
        store = Store.create(folder, told)
        evaluate = Evaluations(plan, unknowns, store, start, times)
        with closing(store):
            try:
                yield unknowns, evaluate
            finally:
                store.describe({**store.about, "runs": evaluate.count})
                store.fold()
