"""Worker processes on this machine: started anew, one thread each, replaced when they die or take too long."""

from __future__ import annotations

import multiprocessing as mp
import os
import threading
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from time import monotonic
from typing import Any

from arthur_acausal.sweep.execute import Outcome, execute
from arthur_acausal.sweep.job import Job
from arthur_acausal.sweep.spawn import apart
from arthur_acausal.sweep.task import Task

AHEAD = 2  # tasks that a worker has at a time, so that it need not wait for the next one
GRACE = 2.0  # s that a run over its time has to end by itself and to give back what it has

Take = Callable[[], Task | None]


@dataclass
class _Worker:
    process: Any
    pipe: Connection
    known: set[str] = field(default_factory=set)  # digests of the jobs that it has
    tasks: deque[Task] = field(default_factory=deque)  # the first one is running
    since: float = 0.0  # when that began, s


def run_local(take: Take, workers: int, timeout: float | None, retry: int) -> Iterator[tuple[Task, Outcome]]:
    """Yield what comes of each task, in the order in which they end.

    Parameters
    ----------
    take : gives the next task, None when there is no more.
    workers : how many processes.
    timeout : s of wall time that a run may take.
    retry : how often the run of a worker that died is tried again.
    """
    crew: list[_Worker] = []
    again: deque[Task] = deque()
    exhausted = False
    try:
        while True:
            while len(crew) < workers and not (exhausted and not again and not _waiting(crew, workers)):
                crew.append(_start())
            for worker in sorted(crew, key=lambda w: len(w.tasks)):
                while (len(worker.tasks) < AHEAD and not exhausted) or (again and len(worker.tasks) < AHEAD):
                    task = again.popleft() if again else take()
                    if task is None:
                        exhausted = True
                        break
                    _give(worker, task, timeout)
            if exhausted and not again and not any(w.tasks for w in crew):
                return
            yield from _collect(crew, again, timeout, retry)
    finally:
        for worker in crew:
            _stop(worker)


def _waiting(crew: list[_Worker], workers: int) -> bool:
    return sum(len(w.tasks) for w in crew) >= workers > len(crew)


def _collect(
    crew: list[_Worker], again: deque[Task], timeout: float | None, retry: int
) -> Iterator[tuple[Task, Outcome]]:
    """Wait for the next messages, deaths and overruns."""
    handles: dict[Any, _Worker] = {w.pipe: w for w in crew}
    patience = None
    if timeout is not None:
        due = min(w.since for w in crew if w.tasks) + timeout + GRACE if any(w.tasks for w in crew) else 0.0
        patience = max(0.05, due - monotonic())
    for pipe in wait(list(handles), patience):
        worker = handles[pipe]
        try:
            outcome = worker.pipe.recv()
        except (EOFError, OSError):
            yield from _bury(crew, worker, again, retry, "its process died")
            continue
        task = worker.tasks.popleft()
        worker.since = monotonic()
        yield task, outcome
    if timeout is not None:
        for worker in [w for w in crew if w.tasks and monotonic() - w.since > timeout + GRACE]:
            task = worker.tasks.popleft()
            again.extend(worker.tasks)
            worker.tasks.clear()
            _stop(worker)
            crew.remove(worker)
            yield task, Outcome("timeout", f"stopped after {timeout:g} s of wall time", wall_s=timeout)


def _bury(
    crew: list[_Worker], worker: _Worker, again: deque[Task], retry: int, cause: str
) -> Iterator[tuple[Task, Outcome]]:
    """Remove a dead worker; its run is tried again, those that waited behind it are as before."""
    crew.remove(worker)
    worker.process.join(1.0)
    if worker.tasks:
        task = worker.tasks.popleft()
        again.extend(worker.tasks)
        code = worker.process.exitcode
        if task.attempts < retry:
            again.append(task.tried_again())
        else:
            told = f"{cause} (exit code {code}) in each of {task.attempts + 1} attempts"
            yield task, Outcome("crashed", told)
    _stop(worker)


def _start() -> _Worker:
    ours, theirs = mp.get_context("spawn").Pipe()
    process = mp.get_context("spawn").Process(target=_serve, args=(theirs,), daemon=True)
    with apart():
        process.start()
    theirs.close()
    return _Worker(process, ours, since=monotonic())


def _give(worker: _Worker, task: Task, timeout: float | None) -> None:
    if not worker.tasks:
        worker.since = monotonic()
    worker.tasks.append(task)
    content = None
    if task.job.digest not in worker.known:
        worker.known.add(task.job.digest)
        content = (task.job.system, task.job.settings)
    with suppress(OSError):  # it has just died: that shows when its pipe is read
        worker.pipe.send((task.job.digest, content, task.values, timeout))


def _stop(worker: _Worker) -> None:
    with suppress(OSError):
        worker.pipe.close()
    if worker.process.is_alive():
        worker.process.kill()
    worker.process.join()
    with suppress(ValueError):
        worker.process.close()


def _serve(pipe: Connection) -> None:
    """Work until the parent closes the pipe or is gone."""
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the parent's to handle
    threading.Thread(target=_end_with_parent, daemon=True).start()
    jobs: dict[str, Job] = {}
    with suppress(EOFError, OSError):
        while True:
            digest, content, values, timeout = pipe.recv()
            if content is not None:
                jobs[digest] = Job.restored(*content)
            pipe.send(execute(jobs[digest], values, timeout))


def _end_with_parent() -> None:
    parent = mp.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
