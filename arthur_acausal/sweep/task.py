"""A run that is to be carried out."""

from __future__ import annotations

from dataclasses import dataclass, replace

from arthur_acausal.sweep.job import Job, Values


@dataclass(frozen=True, slots=True)
class Task:
    """The run of number ``number`` with its own ``values``; ``attempts`` have failed before."""

    number: int
    job: Job
    values: Values
    attempts: int = 0

    def tried_again(self) -> Task:
        """Return the same after one more attempt that failed."""
        return replace(self, attempts=self.attempts + 1)
