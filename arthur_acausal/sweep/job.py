"""What travels to a worker, once for each structure: the compiled system and what every run of it shares."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.sweep.reductions import Reduction

StateSet = tuple[frozenset[int], bool]
"""Dummy derivatives, by the numbers of the translation, and whether a run is continued with them."""


Content = tuple[bytes, str, Mapping[StateSet, bytes]]


@dataclass(frozen=True)
class Signal:
    """An external input over time: ``values`` at ``times`` [s], linear in between."""

    times: tuple[float, ...]
    values: tuple[float, ...]
    source: str


@dataclass(frozen=True)
class Job:
    """One structure of one model, as its runs need it.

    Attributes
    ----------
    system : the compiled system, see `arthur_acausal.codegen.portable`.
    description, audit : one line about the model, and its energy audit's terms.
    start_time, stop_time : s.
    tolerance : relative.
    interval, resolution : of the trajectories kept, and of the instants that reductions look at, s.
    variables : paths whose trajectories are kept.
    reductions : columns of the table.
    parameters, inputs, start : fixed values by path, SI; inputs may be signals.
    times : of the trajectories in place of ``interval``, s.
    trusted : modules of the user that sampled functions and reductions may come from.
    folders : where these modules are found.
    batch : how many runs a worker is given at once at most; 1 where they are not for the engine without events.
    others : the compiled system for further sets of states, as far as runs have asked for them.
    """

    system: bytes = field(repr=False)
    description: str
    audit: Mapping[str, Any]
    start_time: float
    stop_time: float
    tolerance: float
    interval: float
    resolution: float
    variables: tuple[str, ...]
    reductions: tuple[Reduction, ...]
    parameters: Mapping[str, float]
    inputs: Mapping[str, float | Signal]
    start: Mapping[str, float]
    times: tuple[float, ...] = ()
    trusted: tuple[str, ...] = ()
    folders: tuple[str, ...] = ()
    batch: int = 1
    others: Mapping[StateSet, bytes] = field(default_factory=dict, repr=False)

    @cached_property
    def grid(self) -> NDArray[np.float64]:
        """The times of the trajectories that are kept, s."""
        if self.times:
            return np.array(self.times)
        count = max(1, round((self.stop_time - self.start_time) / self.interval))
        return np.linspace(self.start_time, self.stop_time, count + 1)

    @cached_property
    def settings(self) -> str:
        """All but the systems, as JSON."""
        data = asdict(replace(self, system=b"", others={}))
        del data["system"], data["others"]
        return json.dumps(data, sort_keys=True)

    @cached_property
    def base(self) -> str:
        """A hash of the content, without `others`."""
        return hashlib.sha256(self.system + self.settings.encode()).hexdigest()

    @cached_property
    def digest(self) -> str:
        """What the job is known by: a hash of its content."""
        return "+".join(
            [self.base, *sorted(hashlib.sha256(data).hexdigest() for data in self.others.values())]
        )

    @property
    def content(self) -> Content:
        """All of it, see `restored`."""
        return self.system, self.settings, self.others

    @classmethod
    def restored(cls, system: bytes, settings: str, others: Mapping[StateSet, bytes]) -> Job:
        """Return the job again from its `content`."""
        data = json.loads(settings)
        data["variables"], data["times"] = tuple(data["variables"]), tuple(data["times"])
        data["reductions"] = tuple(Reduction(**r) for r in data["reductions"])
        data["trusted"], data["folders"] = tuple(data["trusted"]), tuple(data["folders"])
        data["inputs"] = {path: _input(value) for path, value in data["inputs"].items()}
        return cls(system=system, others=others, **data)


@dataclass(frozen=True, slots=True)
class Values:
    """What one run has of its own, by path, in SI."""

    parameters: Mapping[str, float]
    inputs: Mapping[str, float | Signal] = field(default_factory=dict)
    start: Mapping[str, float] = field(default_factory=dict)


def _input(value: Any) -> float | Signal:
    if not isinstance(value, Mapping):
        return float(value)
    return Signal(tuple(value["times"]), tuple(value["values"]), value["source"])
