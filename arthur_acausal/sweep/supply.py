"""Runs that change their set of states: the compiled system for the next set is made here, and they are run again.

Workers have no model to make it from. Which sets a run comes through is known only when it does; so the first run of
each set pays for it, and those that follow have it from the start. What is run again begins anew, with the same bits.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

from arthur_acausal.errors import ArthurError
from arthur_acausal.sweep.direct import execute_many
from arthur_acausal.sweep.execute import Outcome
from arthur_acausal.sweep.job import Job
from arthur_acausal.sweep.task import Task

Take = Callable[[], Task | None]
Start = Callable[[Take], Iterable[tuple[Task, Outcome]]]
"""From where tasks come (None: there are no more for now) to what comes of them."""


def here(take: Take) -> Iterator[tuple[Task, Outcome]]:
    """Carry out tasks in this process."""
    while (task := take()) is not None:
        yield task, execute_many(task.job, [task.values])[0]


def supplied(start: Start) -> Start:
    """Return the same for tasks that may ask for further systems."""

    def run(take: Take) -> Iterator[tuple[Task, Outcome]]:
        again: deque[Task] = deque()
        richer: dict[str, Job] = {}  # by the digest of a job as it was at first

        def following() -> Task | None:
            task = again.popleft() if again else take()
            return task and replace(task, job=richer.get(task.job.base, task.job))

        for task, outcome in start(following):
            if outcome.wants is None:
                yield task, outcome
                continue
            job = richer.get(task.job.base, task.job)
            try:
                if outcome.wants not in job.others:
                    more = {**job.others, outcome.wants: task.system_for(outcome.wants)}
                    richer[job.base] = replace(job, others=more)
            except ArthurError as error:
                yield task, Outcome("failed", str(error))
                continue
            again.append(task)

    return run
