"""A sweep from its specification to its store: what is missing is run, wherever, and kept as it comes in."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter
from typing import Any

from arthur_acausal.errors import ArthurError, UsageError
from arthur_acausal.sweep import store as stores
from arthur_acausal.sweep.design import Run
from arthur_acausal.sweep.execute import COUNTS, GOOD, Outcome
from arthur_acausal.sweep.lock import Lock
from arthur_acausal.sweep.plan import Plan
from arthur_acausal.sweep.specification import differences
from arthur_acausal.sweep.store import Row, Store
from arthur_acausal.sweep.supply import Start, supplied
from arthur_acausal.sweep.task import Task


@dataclass(frozen=True, slots=True)
class How:
    """Where and how runs are carried out; nothing of it changes a result.

    Attributes
    ----------
    workers : processes; None for one a core.
    scheduler : "" for processes of our own, "local-dask", or the address of a Dask scheduler.
    resume : go on with what is in the directory.
    timeout : s of wall time that a run may take.
    retry : how often the run of a worker that died is tried again.
    shard : (i, n): only every n-th run from the i-th on, counted from 1.
    """

    workers: int | None = None
    scheduler: str = ""
    resume: bool = False
    timeout: float | None = None
    retry: int = 2
    shard: tuple[int, int] | None = None


@dataclass
class Tally:
    """How far a sweep is; ``last`` is the message of the latest failure."""

    total: int
    kept: int = 0
    ok: int = 0
    failed: int = 0
    retried: int = 0
    wall_s: float = 0.0
    last: str = ""
    causes: dict[str, int] = field(default_factory=dict)

    def add(self, outcome: Outcome, attempts: int = 0) -> None:
        """Count one run, before which so many attempts have failed."""
        self.retried += attempts
        if outcome.status in GOOD:
            self.ok += 1
            return
        self.failed += 1
        self.last = outcome.error
        cause = outcome.error.partition("\n")[0]
        self.causes[cause] = self.causes.get(cause, 0) + 1


Watch = Callable[[Tally], None]


def carry_out(plan: Plan, folder: Path, how: How, watch: Watch | None = None) -> Tally:
    """Run what is missing, and keep each run as soon as it has ended.

    ``watch`` is called after each run. Raises UsageError for a directory that holds another sweep or is in use,
    ResultError where it cannot be written; what was kept before stays.
    """
    begun = perf_counter()
    if not plan.runs:
        raise UsageError("the specification has no runs")
    stores.make_folder(folder)
    with Lock(folder):
        store = _opened(plan, folder, how)
        with closing(store):
            return _fill(plan, store, how, watch, begun)


def _fill(plan: Plan, store: Store, how: How, watch: Watch | None, begun: float) -> Tally:
    finished = stores.done(store.folder)
    mine = [run for run in plan.runs if _in_shard(run, how.shard)]
    missing = [run for run in mine if run.number not in finished]
    tally = Tally(len(mine), kept=len(mine) - len(missing))
    tally.ok = sum(finished.get(run.number) in GOOD for run in mine)
    tally.failed = tally.kept - tally.ok
    with backend(how, len(missing)) as start:
        broken: list[tuple[Run, str]] = []
        columns: dict[int, dict[str, float | str]] = {}

        def tasks() -> Iterator[Task]:
            for run in missing:
                try:
                    task, columns[run.number] = plan.task(run)
                except ArthurError as error:  # a value out of bounds, a structure that does not translate
                    broken.append((run, str(error)))
                    continue
                yield task

        pending = tasks()
        for task, outcome in start(lambda: next(pending, None)):
            row = row_of(task.number, columns.pop(task.number), outcome, task.attempts)
            store.add(row, outcome.trajectory, task.number)
            tally.add(outcome, task.attempts)
            _flush(broken, store, tally)
            tally.wall_s = perf_counter() - begun
            if watch is not None:
                watch(tally)
    _flush(broken, store, tally)
    store.fold()
    tally.wall_s = perf_counter() - begun
    return tally


def _flush(broken: list[tuple[Run, str]], store: Store, tally: Tally) -> None:
    """Keep the runs that could not begin."""
    while broken:
        run, error = broken.pop(0)
        columns = {path: value for path, value in run.values.items() if isinstance(value, float)}
        outcome = Outcome("failed", error)
        store.add(row_of(run.number, columns, outcome, 0), None, run.number)
        tally.add(outcome)


def _in_shard(run: Run, shard: tuple[int, int] | None) -> bool:
    return shard is None or run.number % shard[1] == shard[0] - 1


def row_of(number: int, columns: Mapping[str, float | str], outcome: Outcome, attempts: int) -> Row:
    """Return one row of the table; the columns are described in docs/sweeps.md."""
    return {
        "run": number,
        **columns,
        "status": outcome.status,
        "error": outcome.error,
        "end_time": outcome.end_time,
        **outcome.reductions,
        **{name: outcome.statistics.get(name, 0) for name in COUNTS},
        "notes": outcome.notes,
        "attempts": attempts + 1,
        "wall_s": outcome.wall_s,
        "cpu_s": outcome.cpu_s,
        "engine": outcome.engine,
        "platform": outcome.platform,
    }


def _opened(plan: Plan, folder: Path, how: How) -> Store:
    """Make the store, or find it as this specification left it."""
    if not (folder / stores.ABOUT).exists():
        return Store.create(folder, about(plan))
    if not how.resume:
        raise UsageError(
            f"{folder} holds a sweep already", remedy="--resume goes on with it; else name another directory"
        )
    store = Store.existing(folder)
    now, then = plan.specification.to_object(), dict(store.about["specification"])
    more = plan.specification.method in ("random", "sobol")
    if more and (now["samples"] or 0) > (then.get("samples") or 0):
        then["samples"] = now["samples"]  # further samples leave the earlier ones as they are
    if found := differences(then, now):
        raise UsageError(
            f"{folder} holds the sweep of another specification",
            cause="; ".join(found),
            remedy="name another directory, or give the specification that it was made with",
        )
    if len(plan.runs) > int(store.about["runs"]):
        store.describe({**store.about, "specification": now, "runs": len(plan.runs)})
    return store


def about(plan: Plan) -> dict[str, Any]:
    """Return what `sweep.json` says: it is settled by the first run's structure."""
    from arthur_acausal.result.run import versions_here

    prepared = plan.prepared(plan.runs[0])
    job, recovery = prepared.job, prepared.translation.dae.recovery
    _, columns = plan.task(plan.runs[0])
    infos = prepared.translation.dae.parameters
    units = {p: infos.infos[infos.find(p)].unit for p in columns if p in infos.number or p in infos.alias}
    own = [r for r in job.reductions if r.kind != "function"]
    units |= {r.name: r.unit(recovery.units[recovery.find(r.path)]) for r in own}
    return {
        "format": 1,
        "specification": plan.specification.to_object(),
        "runs": len(plan.runs),
        "factors": list(columns),
        "units": units,
        "trajectories": {
            "variables": list(job.variables),
            "units": [recovery.units[recovery.find(path)] for path in job.variables],
            "time": job.grid.tolist() if job.variables else [],
        },
        "versions": versions_here(),
    }


@contextmanager
def backend(how: How, tasks: int) -> Iterator[Start]:
    """Give a function from where tasks come to what comes of them, carried out as ``how`` says."""
    if not how.scheduler:
        from arthur_acausal.sweep.pool import Crew

        workers = max(1, min(how.workers or os.cpu_count() or 1, tasks))
        with Crew(workers, how.timeout, how.retry) as crew:
            yield supplied(crew.run)
        return
    from arthur_acausal.sweep.cluster import connect, run_on_cluster

    client, close = connect(how.scheduler, how.workers)
    try:
        yield supplied(lambda take: run_on_cluster(client, take, how.timeout, how.retry))
    finally:
        close()
