"""Sweeps from Python: the same as the command line's, with a progress bar on a terminal or in a notebook."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any

from arthur_acausal.request.locate import find_model
from arthur_acausal.sweep.carry_out import How, Tally, Watch, carry_out
from arthur_acausal.sweep.opened import Sweep
from arthur_acausal.sweep.plan import Plan
from arthur_acausal.sweep.specification import from_mapping


def sweep(
    model: Any,
    *,
    vary: Mapping[str, Any],
    stop_time: float | str,
    folder: str | os.PathLike[str] | None = None,
    workers: int | None = None,
    scheduler: str = "",
    resume: bool = False,
    timeout: float | None = None,
    retry: int = 2,
    progress: bool | Watch = True,
    **specification: Any,
) -> Sweep:
    """Run many variants of a model, and return what came of them.

    Parameters
    ----------
    model : a class, or a name as the command line takes it; or several of them.
    vary : path -> factor: a list of values, or text such as "150bar:250bar:6", see `parse_factor`.
    stop_time : s, or text with a unit.
    folder : where the results are kept; by default a new temporary folder.
    workers, scheduler, resume, timeout, retry : see `How`.
    progress : whether to show a bar, or a function that is called with the `Tally` after each run.
    specification : further fields of `Specification`: method, samples, seed, zip, derive, set, inputs, start,
        output, replicates, tolerance.

    Raises UsageError for a specification that does not fit, ResultError where the folder cannot be written. Runs
    that fail are rows of the table.
    """
    several = model if isinstance(model, Sequence) and not isinstance(model, str) else [model]
    classes = {f"{kind.__module__}:{kind.__qualname__}": kind for kind in several if isinstance(kind, type)}
    names = [
        f"{kind.__module__}:{kind.__qualname__}" if isinstance(kind, type) else str(kind) for kind in several
    ]
    given = {"models": names, "vary": dict(vary), "stop_time": stop_time, **specification}
    plan = Plan(from_mapping(given), Path.cwd(), lambda name: classes.get(name) or find_model(name))
    target = Path(folder) if folder is not None else Path(tempfile.mkdtemp(prefix="arthur-sweep-"))
    how = How(workers, scheduler, resume, timeout, retry)
    if callable(progress):
        carry_out(plan, target, how, progress)
    elif progress:
        with _Bar() as bar:
            carry_out(plan, target, how, bar)
    else:
        carry_out(plan, target, how)
    return Sweep(target)


class _Bar:
    """A bar of rich, which shows on a terminal and in a notebook."""

    def __enter__(self) -> _Bar:
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

        columns = TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn()
        self._progress = Progress(*columns, transient=True)
        self._progress.start()
        self._task = self._progress.add_task("sweep", total=None)
        return self

    def __call__(self, tally: Tally) -> None:
        failed = f", {tally.failed} failed" if tally.failed else ""
        self._progress.update(
            self._task, completed=tally.ok + tally.failed, total=tally.total, description=f"sweep{failed}"
        )

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._progress.stop()
