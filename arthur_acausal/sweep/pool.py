"""Worker processes on this machine: started anew, one thread each, replaced when they die or take too long."""

from __future__ import annotations

import multiprocessing as mp
import os
import threading
from collections import deque
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from time import monotonic
from typing import Any

from arthur_acausal.sweep.direct import execute_many
from arthur_acausal.sweep.execute import Outcome, system_of
from arthur_acausal.sweep.job import Job
from arthur_acausal.sweep.spawn import apart
from arthur_acausal.sweep.supply import Take
from arthur_acausal.sweep.task import Task

AHEAD = 2  # batches of tasks that a worker has at a time, so that it need not wait for the next one
QUICK, SLOW = 0.05, 0.2  # s that a batch takes below which the next one is larger, above which it is smaller
GRACE = 2.0  # s that a run over its time has to end by itself and to give back what it has
LOADING = 60.0  # s that a new worker may take before its first run begins


@dataclass
class _Worker:
    process: Any
    pipe: Connection
    known: set[str] = field(default_factory=set)  # digests of the jobs that it has
    batches: deque[list[Task]] = field(default_factory=deque)  # the first one is running
    size: int = 1  # of its next batch at most
    since: float = 0.0  # when that began, or has to begin, s


class Crew:
    """Worker processes, for as long as the ``with`` block lasts; they start when there is work for them.

    Parameters
    ----------
    workers : how many processes.
    timeout : s of wall time that a run may take.
    retry : how often the run of a worker that died is tried again.
    """

    def __init__(self, workers: int, timeout: float | None, retry: int) -> None:
        self._size, self._timeout, self._retry = workers, timeout, retry
        self._workers: list[_Worker] = []

    def __enter__(self) -> Crew:
        return self

    def __exit__(self, *_: object) -> None:
        for worker in self._workers:
            _stop(worker)
        self._workers.clear()

    def run(self, take: Take) -> Iterator[tuple[Task, Outcome]]:
        """Yield what comes of each task, in the order in which they end; ``take`` gives the next one, or None."""
        again: deque[Task] = deque()
        while True:
            self._hand_out(take, again)
            if not again and not any(worker.batches for worker in self._workers):
                return
            yield from _collect(self._workers, again, self._timeout, self._retry)

    def _hand_out(self, take: Take, again: deque[Task]) -> None:
        """Give each worker its next tasks, those with the fewest first."""
        while True:
            more = len(self._workers) < self._size and all(w.batches for w in self._workers)
            worker = None if more else min(self._workers, key=lambda w: len(w.batches), default=None)
            if not more and (worker is None or len(worker.batches) >= AHEAD):
                return
            batch = self._next(take, again, 1 if worker is None else worker.size)
            if not batch:
                return
            if worker is None:
                worker = _start()
                self._workers.append(worker)
            if not worker.batches:
                worker.since = max(worker.since, monotonic())
            worker.batches.append(batch)
            self._send(worker, batch)

    def _next(self, take: Take, again: deque[Task], size: int) -> list[Task]:
        """Return up to ``size`` tasks of one job; what is tried again, or has a time to keep, goes alone."""
        batch: list[Task] = []
        while (task := again.popleft() if again else take()) is not None:
            if batch and (task.job is not batch[0].job or task.attempts):
                again.appendleft(task)
                break
            batch.append(task)
            if task.attempts or self._timeout is not None or len(batch) >= min(size, task.job.batch):
                break
        return batch

    def _send(self, worker: _Worker, batch: list[Task]) -> None:
        content, job = None, batch[0].job
        if job.digest not in worker.known:
            worker.known.add(job.digest)
            content = job.content
        with suppress(OSError):  # it has just died: that shows when its pipe is read
            worker.pipe.send((job.digest, content, [task.values for task in batch], self._timeout))


def _collect(
    crew: list[_Worker], again: deque[Task], timeout: float | None, retry: int
) -> Iterator[tuple[Task, Outcome]]:
    """Wait for the next messages, deaths and overruns."""
    handles: dict[Any, _Worker] = {w.pipe: w for w in crew}
    patience = None
    if timeout is not None:
        busy = [w.since for w in crew if w.batches]
        due = min(busy) + timeout + GRACE if busy else 0.0
        patience = max(0.05, due - monotonic())
    for pipe in wait(list(handles), patience):
        worker = handles[pipe]
        try:
            outcomes = worker.pipe.recv()
        except (EOFError, OSError):
            yield from _bury(crew, worker, again, retry, "its process died")
            continue
        worker.since = monotonic()
        if outcomes is not None:  # else a job has been loaded
            took, size = sum(outcome.wall_s for outcome in outcomes), len(outcomes)
            worker.size = 2 * size if took < QUICK else max(1, size // 2) if took > SLOW else size
            yield from zip(worker.batches.popleft(), outcomes, strict=True)
    if timeout is not None:
        for worker in [w for w in crew if w.batches and monotonic() - w.since > timeout + GRACE]:
            (task,) = worker.batches.popleft()
            again.extend(waiting for batch in worker.batches for waiting in batch)
            worker.batches.clear()
            _stop(worker)
            crew.remove(worker)
            yield task, Outcome("timeout", f"stopped after {timeout:g} s of wall time", wall_s=timeout)


def _bury(
    crew: list[_Worker], worker: _Worker, again: deque[Task], retry: int, cause: str
) -> Iterator[tuple[Task, Outcome]]:
    """Remove a dead worker; its run is tried again, those that waited behind it are as before."""
    crew.remove(worker)
    worker.process.join(1.0)
    if worker.batches:
        begun = worker.batches.popleft()
        again.extend(waiting for batch in worker.batches for waiting in batch)
        code = worker.process.exitcode
        for task in begun:
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
    return _Worker(process, ours, since=monotonic() + LOADING)


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
                system_of(jobs[digest])
                pipe.send(None)
            pipe.send(execute_many(jobs[digest], values, timeout))


def _end_with_parent() -> None:
    parent = mp.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
