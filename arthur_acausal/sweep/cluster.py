"""The same tasks on a Dask cluster; distributed is imported here only."""

from __future__ import annotations

import importlib
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import Any

from arthur_acausal.errors import UsageError
from arthur_acausal.sweep.direct import execute_many
from arthur_acausal.sweep.execute import Outcome
from arthur_acausal.sweep.job import Content, Job, Values
from arthur_acausal.sweep.spawn import apart
from arthur_acausal.sweep.supply import Take
from arthur_acausal.sweep.task import Task

AHEAD = 3  # tasks in flight for each thread of the cluster
CONNECTING = 10.0  # s
_ONE_AT_A_TIME = threading.Lock()
_JOBS: dict[str, Job] = {}


def connect(scheduler: str, workers: int | None) -> tuple[Any, Callable[[], None]]:
    """Return a client of the scheduler and what closes it; "local-dask" starts a cluster on loopback.

    Raises UsageError where distributed is missing or nobody answers.
    """
    try:
        distributed: Any = importlib.import_module("distributed")
    except ImportError:
        raise UsageError(
            "--scheduler needs Dask", remedy="pip install 'arthur-acausal[dask]', here and on the workers"
        ) from None
    if scheduler == "local-dask":
        stack = ExitStack()
        stack.enter_context(apart())  # as long as the cluster lives, for it starts dead workers anew
        cluster = stack.enter_context(
            distributed.LocalCluster(
                n_workers=workers, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
            )
        )
        return stack.enter_context(distributed.Client(cluster)), stack.close
    try:
        client = distributed.Client(scheduler, timeout=CONNECTING)
    except (OSError, ValueError) as error:
        raise UsageError(
            f"no Dask scheduler answers at {scheduler}", cause=str(error), remedy="write tcp://HOST:PORT"
        ) from None
    return client, client.close


def run_on_cluster(
    client: Any, take: Take, timeout: float | None, retry: int
) -> Iterator[tuple[Task, Outcome]]:
    """Yield what comes of each task, in the order in which they end; a bounded number is in flight."""
    distributed: Any = importlib.import_module("distributed")  # whose annotations are incomplete
    sent: dict[str, Any] = {}
    waiting: dict[Any, Task] = {}
    results = distributed.as_completed()

    def send() -> bool:
        task = take()
        if task is None:
            return False
        submit(task)
        return True

    def submit(task: Task) -> None:
        digest = task.job.digest
        if digest not in sent:
            sent[digest] = client.scatter(task.job.content, broadcast=True, hash=False)
        future = client.submit(
            work, sent[digest], digest, task.values, timeout, pure=False, retries=0, key=None
        )
        waiting[future] = task
        results.add(future)

    threads = max(1, sum(client.nthreads().values()))
    for _ in range(AHEAD * threads):
        if not send():
            break
    for future in results:
        task = waiting.pop(future)
        failure = future.exception() if future.status == "error" else None
        if future.status == "finished":
            yield task, future.result()
        elif task.attempts < retry:
            sent.pop(task.job.digest, None)  # the scattered data may have gone with the worker
            submit(task.tried_again())
            continue
        else:
            yield (
                task,
                Outcome("crashed", f"its worker died in each of {task.attempts + 1} attempts: {failure}"),
            )
        send()


def work(content: Content, digest: str, values: Values, timeout: float | None) -> Outcome:
    """Carry out one run on a worker; one at a time in a process, whatever threads it has."""
    with _ONE_AT_A_TIME:
        if digest not in _JOBS:
            _JOBS[digest] = Job.restored(*content)
        return execute_many(_JOBS[digest], [values], timeout)[0]
