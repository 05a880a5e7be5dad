"""`arthur sweep` and `arthur merge`: many runs of a model, kept in a directory."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from arthur_acausal.cli.failure import note, quiet
from arthur_acausal.cli.table import count, duration, number, table
from arthur_acausal.errors import UsageError
from arthur_acausal.request.settings import assignments

if TYPE_CHECKING:
    from arthur_acausal.sweep.carry_out import How, Tally
    from arthur_acausal.sweep.plan import Plan
    from arthur_acausal.sweep.specification import Specification

LARGE = 10e9  # bytes of trajectories above which a sweep must be confirmed
KEYS = {
    "stop-time": "stop_time",
    "rtol": "tolerance",
}  # options -> keys of a specification, where they differ
SHOWN = 12  # runs of a dry run's table at its head; a few more at its end


@dataclass(frozen=True, slots=True)
class Request:
    """What the command line asks for; texts as they were typed, None where an option was not given."""

    model: str
    output: Path | None = None
    vary: Sequence[str] = ()
    zip: Sequence[str] = ()
    derive: Sequence[str] = ()
    settings: Sequence[str] = ()
    inputs: Sequence[str] = ()
    starts: Sequence[str] = ()
    keep: Sequence[str] = ()
    reduce: Sequence[str] = ()
    scalars: dict[str, Any] = field(default_factory=dict)
    interval: str | None = None
    trajectories: bool = True
    replicates: int | None = None
    seed_parameter: str | None = None
    workers: int | None = None
    scheduler: str = ""
    resume: bool = False
    timeout: float | None = None
    retry: int = 2
    shard: str | None = None
    dry_run: bool = False
    yes: bool = False
    as_json: bool = False


def sweep(request: Request) -> tuple[str, bool]:
    """Carry out ``arthur sweep``; return what is to be printed, and whether any run succeeded."""
    from arthur_acausal.request.locate import find_model
    from arthur_acausal.sweep.carry_out import carry_out
    from arthur_acausal.sweep.plan import Plan

    with quiet(request.as_json):
        specification, folder = read(request)
        plan = Plan(specification, folder, find_model)
        how = _how(request)
        if request.dry_run:
            return dry_run(plan, how), True
        if request.output is None:
            raise UsageError("no directory for the results", remedy="-o DIR")
        _confirm(plan, request)
        watch = Watch(plan, request.output)
        try:
            tally = carry_out(plan, request.output, how, watch)
        except KeyboardInterrupt:
            watch.close()
            note(f"{request.output} keeps what has ended; --resume goes on")
            raise
        watch.close()
    if request.as_json:
        return json.dumps(as_object(tally, request.output), ensure_ascii=False), bool(tally.ok)
    return as_text(tally, request.output), bool(tally.ok)


def read(request: Request) -> tuple[Specification, Path]:
    """Return the specification of a TOML file or of options, and the folder that its files stand in."""
    from arthur_acausal.sweep.specification import from_mapping, from_toml

    if request.model.endswith(".toml"):
        if named := _specifying(request):
            raise UsageError(
                f"{request.model} says what the sweep is", remedy=f"write {', '.join(named)} into the file"
            )
        file = Path(request.model)
        return from_toml(file), file.resolve().parent
    output: dict[str, Any] = {"variables": list(request.keep), "trajectories": request.trajectories}
    if request.interval is not None:
        output["interval"] = request.interval
    if request.reduce:
        output["reductions"] = list(request.reduce)
    given: dict[str, Any] = {
        "model": request.model,
        "vary": assignments(request.vary, "--vary"),
        "zip": [[path.strip() for path in group.split(",")] for group in request.zip],
        "derive": assignments(request.derive, "--derive"),
        "set": assignments(request.settings, "--set"),
        "inputs": assignments(request.inputs, "--input"),
        "start": assignments(request.starts, "--start"),
        "output": output,
    }
    given |= {KEYS.get(name, name): v for name, v in request.scalars.items() if v is not None}
    if request.replicates is not None or request.seed_parameter is not None:
        given["replicates"] = {"count": request.replicates or 1, "parameter": request.seed_parameter or ""}
    given.setdefault("stop_time", _stop_time(request.model))
    return from_mapping(given), Path.cwd()


def _specifying(request: Request) -> list[str]:
    """Return the options given that say what a sweep is, rather than how it is carried out."""
    given = {
        "--vary": request.vary,
        "--zip": request.zip,
        "--derive": request.derive,
        "--set": request.settings,
        "--input": request.inputs,
        "--start": request.starts,
        "--keep": request.keep,
        "--reduce": request.reduce,
        "--interval": request.interval,
        "--no-trajectories": not request.trajectories,
        "--replicates": request.replicates,
        "--seed-parameter": request.seed_parameter,
        **{f"--{name}": value is not None for name, value in request.scalars.items()},
    }
    return [name for name, value in given.items() if value]


def _stop_time(model: str) -> float:
    from arthur_acausal.cli.simulate import STOP_TIME
    from arthur_acausal.request.locate import find_model

    return float(getattr(find_model(model), "stop_time", STOP_TIME))


def _how(request: Request) -> How:
    from arthur_acausal.sweep.carry_out import How

    if request.workers is not None and request.workers < 1:
        raise UsageError(f"-j {request.workers}: at least one worker is needed")
    if request.timeout is not None and not request.timeout > 0.0:
        raise UsageError(f"--timeout {request.timeout:g} is not positive")
    return How(
        request.workers,
        request.scheduler,
        request.resume,
        request.timeout,
        request.retry,
        _shard(request.shard),
    )


def _shard(text: str | None) -> tuple[int, int] | None:
    if text is None:
        return None
    first, slash, second = text.partition("/")
    if not (slash and first.isdigit() and second.isdigit() and 1 <= int(first) <= int(second)):
        raise UsageError(f"--shard {text}", remedy="write i/n with 1 <= i <= n, such as 2/8")
    return int(first), int(second)


def size(plan: Plan) -> float:
    """Return the bytes of a sweep's trajectories before compression."""
    job = plan.prepared(plan.runs[0]).job
    return 8.0 * len(plan.runs) * len(job.variables) * (job.grid.size if job.variables else 0)


def _confirm(plan: Plan, request: Request) -> None:
    if not plan.runs:
        raise UsageError("the specification has no runs")
    if size(plan) <= LARGE or request.yes:
        return
    told = f"the trajectories take up to {size(plan) / 1e9:.0f} GB"
    if not sys.stdin.isatty():
        raise UsageError(told, remedy="--yes confirms it; --keep, --interval and --no-trajectories keep less")
    typer.confirm(f"{told}. Go on?", abort=True)


def dry_run(plan: Plan, how: How) -> str:
    """Return the table of runs, and what they will take: the first one is tried for that."""
    from arthur_acausal.sweep.supply import here, supplied

    runs = plan.runs
    if not runs:
        raise UsageError("the specification has no runs")
    task, columns = plan.task(runs[0])
    head, tail = runs[:SHOWN], runs[max(SHOWN, len(runs) - 3) :]
    names = list(columns)
    rows = [["run", *names]]
    for run in [*head, *tail]:
        if tail and run is tail[0] and run.number > SHOWN:
            rows.append(["..."] + [""] * len(names))
        values = plan.task(run)[1]
        rows.append([str(run.number), *(_shown(values.get(name, "")) for name in names)])
    pending = iter([task, task])  # the first one also loads libraries
    *_, (_, trial) = supplied(here)(lambda: next(pending, None))
    workers = how.workers or os.cpu_count() or 1
    lines = [table(rows, "r" * len(rows[0]), indent=0), ""]
    if trial.status not in ("ok", "terminated"):
        lines.append(f"run 0 fails: {trial.error}")
    total = trial.wall_s * len(runs) / workers
    lines.append(
        f"{count(len(runs), 'run')} take about {duration(total)} with {count(workers, 'worker')}, "
        f"{duration(trial.wall_s)} each as run 0 did;"
    )
    lines.append(f"their trajectories take up to {_bytes(size(plan))} before compression")
    return "\n".join(lines)


def _shown(value: object) -> str:
    return number(value) if isinstance(value, float) else str(value)


def _bytes(value: float) -> str:
    for unit, scale in (("GB", 1e9), ("MB", 1e6), ("kB", 1e3)):
        if value >= scale:
            return f"{value / scale:.3g} {unit}"
    return f"{value:.0f} bytes"


def as_object(tally: Tally, folder: Path) -> dict[str, Any]:
    """Return what ``--json`` prints."""
    return {
        "runs": tally.total,
        "ok": tally.ok,
        "failed": tally.failed,
        "retried": tally.retried,
        "wall_s": tally.wall_s,
        "store": str(folder),
    }


def as_text(tally: Tally, folder: Path) -> str:
    """Return the summary at the end."""
    lines = [
        f"{count(tally.total, 'run')} in {folder}: {tally.ok:,} ok, {tally.failed:,} failed"
        + (f", {tally.kept:,} were there already" if tally.kept else "")
        + f", {duration(tally.wall_s)}"
    ]
    if tally.retried:
        lines.append(f"{count(tally.retried, 'attempt')} more after workers died")
    worst = sorted(tally.causes.items(), key=lambda pair: -pair[1])
    lines += [f"  {times} times: {cause}" for cause, times in worst[:5]]
    if len(worst) > 5:
        lines.append(f"  and {len(worst) - 5} other causes: column `error` of the table")
    return "\n".join(lines)


class Watch:
    """Shows how far a sweep is: a live bar on a terminal, else a line now and then, on standard error."""

    INTERVAL = 60.0  # s between lines

    def __init__(self, plan: Plan, folder: Path) -> None:
        self._last = 0.0
        self._bar: Any = None
        if sys.stderr.isatty():
            from arthur_acausal.cli.progress import appear

            self._bar = appear()
            self._task = self._bar.add_task("translating", total=None)
        else:
            typer.echo(f"{count(len(plan.runs), 'run')} into {folder}", err=True)

    def __call__(self, tally: Tally) -> None:
        done = tally.ok + tally.failed
        rate = (done - tally.kept) / tally.wall_s if tally.wall_s > 0.0 else 0.0
        told = f"{done:,} of {tally.total:,}, {tally.failed:,} failed, {60.0 * rate:.3g} a minute"
        if self._bar is not None:
            self._bar.update(
                self._task,
                completed=done,
                total=tally.total,
                description=told,
                refresh=tally.wall_s - self._last > 0.1,
            )
            self._last = tally.wall_s if tally.wall_s - self._last > 0.1 else self._last
        elif tally.wall_s - self._last > self.INTERVAL:
            self._last = tally.wall_s
            left = duration((tally.total - done) / rate) if rate > 0.0 else "?"
            typer.echo(f"{told}, {left} left", err=True)

    def close(self) -> None:
        """Remove the bar."""
        if self._bar is not None:
            self._bar.stop()


def merge(folders: Sequence[Path], target: Path) -> str:
    """Carry out ``arthur merge``."""
    from arthur_acausal.sweep.merge import merge as carry_out
    from arthur_acausal.sweep.store import read_about

    runs = carry_out(folders, target)
    expected = int(read_about(target)["runs"])
    missing = f", {expected - runs:,} are missing" if runs < expected else ""
    return f"{count(runs, 'run')} of {expected:,} in {target}{missing}"
