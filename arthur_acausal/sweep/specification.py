"""What a sweep is: read from TOML or built from options, checked by a schema, kept beside the results."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from arthur_acausal.errors import UsageError, nearest
from arthur_acausal.units import to_si

Method = Literal["grid", "zip", "random", "lhs", "sobol", "saltelli"]
RANDOM: tuple[Method, ...] = ("random", "lhs", "sobol", "saltelli")
Given = float | str | bool
Seconds = Annotated[float, Field(gt=0.0)]


class _Section(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Output(_Section):
    """What is kept of each run.

    Attributes
    ----------
    variables : paths or patterns; by default the model's named outputs.
    interval : of the trajectories that are kept, s.
    trajectories : whether they are kept at all.
    reductions : such as "final(load.s)", "quantile(p, 0.95)", "first(x > 1)" or "module:function"; by default
        final, min, max, mean and rms of each variable.
    """

    variables: tuple[str, ...] = ()
    interval: Seconds = 0.01
    trajectories: bool = True
    reductions: tuple[str, ...] | None = None


class Replicates(_Section):
    """Repetitions of each run with another seed: ``parameter`` is given seed, seed + 1, ..."""

    count: Annotated[int, Field(ge=1)] = 1
    parameter: str = ""


class Specification(_Section):
    """A sweep.

    Attributes
    ----------
    models : names as the command line takes them.
    stop_time, start_time : s.
    engine : "auto": runs without events by the engine for these, wholly in C, where it fits; "ida": all by the
        default one.
    tolerance : relative, of the integration.
    method : "grid" combines the values of all factors; "zip" takes the first of each, the second of each ...;
        "random", "lhs" (Latin hypercube) and "sobol" draw ``samples`` from the factors' ranges; "saltelli" makes
        the ``samples`` times (factors + 2) runs that Sobol indices need, see `importance`.
    vary : path -> factor, see `parse_factor`.
    zip : groups of paths that take their values together within a grid.
    derive : path -> expression over other paths, in SI.
    set, inputs, start : fixed parameters (structural ones too), inputs and start values by path.
    output : what is kept.
    replicates : repetitions.
    """

    models: Annotated[tuple[str, ...], Field(min_length=1)]
    stop_time: Seconds
    start_time: float = 0.0
    engine: Literal["auto", "ida"] = "auto"
    tolerance: Annotated[float, Field(gt=0.0, lt=0.1)] = 1e-6
    method: Method = "grid"
    samples: Annotated[int, Field(ge=1)] | None = None
    seed: Annotated[int, Field(ge=0)] = 0
    vary: dict[str, Given | list[Given]] = Field(default_factory=dict)
    zip: tuple[tuple[str, ...], ...] = ()
    derive: dict[str, str] = Field(default_factory=dict)
    set: dict[str, Given] = Field(default_factory=dict)
    inputs: dict[str, Given] = Field(default_factory=dict)
    start: dict[str, Given] = Field(default_factory=dict)
    output: Output = Output()
    replicates: Replicates = Replicates()

    @model_validator(mode="before")
    @classmethod
    def _spellings(cls, given: Any) -> Any:
        """Accept ``model`` for a single model, and times with a unit."""
        if not isinstance(given, Mapping):
            return given
        data = dict(given)
        if "model" in data and "models" not in data:
            data["models"] = [data.pop("model")]
        for name in ("stop_time", "start_time"):
            if isinstance(data.get(name), str):
                data[name] = to_si(data[name], "s", path=name)
        output = data.get("output")
        if isinstance(output, Mapping) and isinstance(output.get("interval"), str):
            data["output"] = {**output, "interval": to_si(output["interval"], "s", path="output.interval")}
        return data

    @model_validator(mode="after")
    def _whole(self) -> Specification:
        if self.method in RANDOM and self.samples is None:
            raise ValueError(f"the method {self.method} needs samples")
        if self.method not in RANDOM and self.samples is not None:
            raise ValueError(f"samples belong to {', '.join(RANDOM)}, not to {self.method}")
        if self.zip and self.method != "grid":
            raise ValueError("groups in zip belong to the method grid")
        for path in (path for group in self.zip for path in group):
            if path not in self.vary:
                raise ValueError(f"zip names {path}, which vary does not have")
        if self.replicates.count > 1 and not self.replicates.parameter:
            raise ValueError("replicates needs the parameter that is given the seed")
        if self.start_time >= self.stop_time:
            raise ValueError(f"start_time {self.start_time:g} s is not before stop_time {self.stop_time:g} s")
        return self

    def to_object(self) -> dict[str, Any]:
        """Return the specification as plain JSON values."""
        return self.model_dump(mode="json")


def from_mapping(data: Mapping[str, Any], source: str = "", text: str = "") -> Specification:
    """Return the specification of a mapping; ``text`` is where it was read from, for the lines of messages.

    Raises UsageError naming the key, and the line where there is a text.
    """
    try:
        return Specification.model_validate(data)
    except ValidationError as error:
        first = error.errors()[0]
        raise _mistake(first, source, text) from None


def from_toml(file: Path) -> Specification:
    """Read a specification from a TOML file. Raises UsageError with the line and the key of a mistake."""
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise UsageError(f"{file} cannot be read", cause=reason or "") from None
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise UsageError(f"{file} is not valid TOML", cause=str(error)) from None
    return from_mapping(data, file.name, text)


def differences(old: Mapping[str, Any], new: Mapping[str, Any], prefix: str = "") -> list[str]:
    """Return a line for each key whose value differs between two specifications as objects."""
    lines = []
    for key in sorted({*old, *new}):
        a, b = old.get(key), new.get(key)
        if isinstance(a, Mapping) and isinstance(b, Mapping):
            lines += differences(a, b, f"{prefix}{key}.")
        elif a != b:
            lines.append(f"{prefix}{key}: {a!r} there, {b!r} now")
    return lines


def _mistake(error: Any, source: str, text: str) -> UsageError:
    """Return the error that tells of the first mistake which the schema found."""
    location = [str(part) for part in error["loc"]]
    keys = [part for part in location if part not in ("float", "str", "bool")]
    name = ".".join(keys) or "the specification"
    line = _line_of(keys, text)
    message = error["msg"].removeprefix("Value error, ")
    remedy = ""
    if error["type"] == "extra_forbidden":
        message = "there is no such key"
        fields: Any = Specification
        for key in keys[:-1]:
            fields = fields.model_fields[key].annotation
        remedy = nearest(keys[-1], fields.model_fields) or f"one of {', '.join(fields.model_fields)}"
    elif error["type"] == "missing":
        name, message = "the specification", f"the key {keys[-1]} is missing"
    where = f"{source}:{line}" if line else source
    return UsageError(f"{name}: {message}", where=where, remedy=remedy)


def _line_of(keys: list[str], text: str) -> int:
    """Return the number of the line where a key stands, or its table; 0 if it cannot be found."""
    table: list[str] = []
    best, depth = 0, 0
    for number, line in enumerate(text.splitlines(), start=1):
        if header := re.fullmatch(r"\s*\[+\s*(.+?)\s*\]+\s*(#.*)?", line):
            table = _split(header[1])
            here = table
        elif entry := re.match(r"""\s*((?:[\w.-]|"[^"]*"|'[^']*')+)\s*=""", line):
            here = [*table, *_split(entry[1])]
        else:
            continue
        same = len(here) if here == keys[: len(here)] else 0
        if same > depth:
            best, depth = number, same
    return best


def _split(key: str) -> list[str]:
    """Return the parts of a dotted TOML key."""
    return [a or b or c for a, b, c in re.findall(r"""([\w-]+)|"([^"]*)"|'([^']*)'""", key)]
