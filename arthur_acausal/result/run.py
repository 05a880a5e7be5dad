"""How a solution came about: model, options, statistics, events, versions."""

from __future__ import annotations

import dataclasses
import json
import math
import platform
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib import metadata
from types import SimpleNamespace
from typing import Any

import numpy as np

from arthur_acausal.solve.statistics import Statistics
from arthur_acausal.solve.trajectory import Event

Json = Any  # what json.dumps takes: None, bool, int, float, str, lists and dictionaries of these

PACKAGES = {
    "arthur": "arthur-acausal",
    "casadi": "casadi",
    "numpy": "numpy",
    "scikit-sundae": "scikit-sundae",
}


@dataclass(frozen=True, slots=True)
class Run:
    """All of a solution but its values; `plain` turns everything in it into JSON.

    Attributes
    ----------
    model : name of the model class, "Powertrain".
    description : one line about it.
    start_time, stop_time : the interval that was asked for, s.
    status : "finished", "terminated" (by the model), "failed" or "interrupted".
    message : why it ended, for people.
    parameters, inputs, start : what was set for this run, by path, SI; of an input that varies, where its
        values came from.
    options : tolerances and all other options of the solver: a dataclass, or a namespace from a file.
    statistics : counts and wall times of the run: likewise.
    events : in order of time.
    audit : the model's energy terms: for each term the paths of the variables that sum to it.
    externals : functions that are no equations and can be made again: {path of their component, function, data}.
    beside : what a film of the model's bodies shows beside them: title -> {label: path}, as for `Solution.plot`.
    versions : of Arthur, of what it runs on, of Python and the platform, where a file says them; empty for a
        solution of this process.
    """

    model: str = ""
    description: str = ""
    start_time: float = 0.0
    stop_time: float = 0.0
    status: str = "finished"
    message: str = ""
    parameters: Mapping[str, Json] = field(default_factory=dict)
    inputs: Mapping[str, Json] = field(default_factory=dict)
    start: Mapping[str, Json] = field(default_factory=dict)
    options: Any = None
    statistics: Any = None
    events: tuple[Event, ...] = ()
    audit: Mapping[str, Json] = field(default_factory=dict)
    externals: Sequence[Mapping[str, Json]] = ()
    beside: Mapping[str, Json] = field(default_factory=dict)
    versions: Mapping[str, str] = field(default_factory=dict)


def versions_here() -> dict[str, str]:
    """Versions of everything that shapes the numbers, by name, as this process has them."""
    found = {"python": platform.python_version(), "platform": f"{sys.platform} {platform.machine()}"}
    for name, package in PACKAGES.items():
        try:
            found[name] = metadata.version(package)
        except metadata.PackageNotFoundError:  # run from a source tree that is not installed
            found[name] = "unknown"
    return found


def plain(value: object) -> Json:
    """Turn dataclasses, NumPy numbers and arrays, tuples and paths into what JSON can say.

    Numbers that are not finite become text, since JSON has none.
    """
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, float):
        return value if math.isfinite(value) else repr(float(value))
    if isinstance(value, Statistics):
        return plain(value.as_dict())
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {f.name: plain(getattr(value, f.name)) for f in dataclasses.fields(value)}
    if isinstance(value, SimpleNamespace):
        return plain(vars(value))
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple | set | frozenset):
        return [plain(item) for item in value]
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    return str(value)


def to_json(value: object) -> str:
    """One line of JSON, the same for the same value."""
    return json.dumps(plain(value), ensure_ascii=False, allow_nan=False)
