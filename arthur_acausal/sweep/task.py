"""A run that is to be carried out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from arthur_acausal.sweep.job import Job, StateSet, Values


@dataclass(frozen=True, slots=True)
class Task:
    """The run of number ``number`` with its own ``values``; ``attempts`` have failed before.

    ``system_for`` makes the job's system for another set of states.
    """

    number: int
    job: Job
    values: Values
    system_for: Callable[[StateSet], bytes]
    attempts: int = 0

    def tried_again(self) -> Task:
        """Return the same after one more attempt that failed."""
        return replace(self, attempts=self.attempts + 1)
