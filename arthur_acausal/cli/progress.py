"""A progress bar for runs that take a while."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import perf_counter
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress

PATIENCE = 0.5  # s of wall time before the bar appears


class Bar:
    """Shows how far a run has come; nothing before `PATIENCE` is over."""

    def __init__(self, start_time: float, stop_time: float) -> None:
        self._start, self._stop = start_time, stop_time
        self._begun = perf_counter()
        self._progress: Progress | None = None

    def __call__(self, time: float) -> None:
        """Show that the run has reached ``time``, s."""
        if self._progress is None:
            if perf_counter() - self._begun < PATIENCE:
                return
            self._progress = appear()
            self._task = self._progress.add_task("simulating", total=self._stop - self._start)
        self._progress.update(
            self._task,
            completed=time - self._start,
            description=f"{time:.3g} of {self._stop:g} s",
            refresh=True,
        )

    def close(self) -> None:
        """Remove the bar."""
        if self._progress is not None:
            self._progress.stop()


def appear() -> Progress:
    """An empty bar on standard error. It draws when told to: a thread of its own would disturb the solver."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

    columns = TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeRemainingColumn()
    progress = Progress(
        *columns,
        console=Console(stderr=True),
        auto_refresh=False,
        transient=True,
        redirect_stdout=False,
        redirect_stderr=False,
    )
    progress.start()
    return progress


@contextmanager
def shown(start_time: float, stop_time: float) -> Iterator[Callable[[float], None] | None]:
    """A function to call with the present time, or None where standard error is no terminal."""
    if not sys.stderr.isatty():
        yield None
        return
    bar = Bar(start_time, stop_time)
    try:
        yield bar
    finally:
        bar.close()
