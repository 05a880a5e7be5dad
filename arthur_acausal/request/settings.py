"""What the options --set and --input say."""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from arthur_acausal.errors import UsageError, nearest

if TYPE_CHECKING:
    from arthur_acausal.solve.inputs import Input

NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*")
STEP = re.compile(r"(\w+)(?:\[(\d+)\])?")
TRUTH = {"true": True, "yes": True, "1": True, "false": False, "no": False, "0": False}


class Settings(NamedTuple):
    """What --set gives: structural parameters for the model's class, and parameter values by path."""

    structural: dict[str, Any]
    parameters: dict[str, float | str]


def assignments(texts: Iterable[str], option: str) -> dict[str, str]:
    """Split ``path=value`` texts; the last one for a path counts."""
    split = {}
    for text in texts:
        path, equals, value = text.partition("=")
        if not equals or not path.strip() or not value.strip():
            raise UsageError(f"{option} {text}: write {option} path=value")
        split[path.strip()] = value.strip()
    return split


def read_settings(model: type[Any], texts: Iterable[str]) -> Settings:
    """Read the --set options for a model class.

    A name without a dot that is a structural parameter of the class gets that parameter's type; all others
    are parameters: a number in SI, or a number with its unit ("150bar"). Those that the class requires are given
    where the model is made, like the structural ones.
    """
    structural: dict[str, Any] = {}
    parameters: dict[str, float | str] = {}
    for path, text in assignments(texts, "--set").items():
        if path in structural_parameters(model):
            structural[path] = convert(model, path, text)
        elif path in required_parameters(model):
            structural[path] = quantity(text, f"--set {path}={text}")
        else:
            parameters[path] = quantity(text, f"--set {path}={text}")
    return Settings(structural, parameters)


def required_parameters(model: type[Any]) -> set[str]:
    """Parameters of a model class itself that have no default."""
    quantities = model._declarations.written
    return {name for name, q in quantities.items() if q.kind == "parameter" and q.default is None}


def structural_parameters(model: type[Any]) -> Mapping[str, Any]:
    """Structural parameters of a model class: name to default."""
    declared: Mapping[str, Any] = model._declarations.structural
    return declared


def structural_parts(model: Any, paths: Iterable[str]) -> dict[str, type[Any]]:
    """Return which paths are structural parameters of parts of a model, with the classes of these parts."""
    from arthur_acausal.declare.bind import bind_root
    from arthur_acausal.declare.model import Model
    from arthur_acausal.declare.scope import Scope

    wanted = [path for path in paths if "." in path]
    root = bind_root(model, Scope()) if wanted else None
    found = {}
    for path in wanted:
        place, _, name = path.rpartition(".")
        part: Any = root
        for step in STEP.findall(place):
            part = _step(part, *step)
        if isinstance(part, Model) and name in part._declarations.structural:
            found[path] = type(part)
    return found


def _step(part: Any, name: str, number: str) -> Any:
    """Return what stands at ``name`` or ``name[number]`` of a part, None where there is nothing."""
    below = vars(part).get(name) if part is not None else None
    if not number:
        return below
    return below[int(number)] if isinstance(below, list) and int(number) < len(below) else None


def annotation(model: type[Any], name: str) -> Any:
    """The type of a structural parameter; that of its default where the annotation cannot be evaluated."""
    owner = next(kind for kind in model.__mro__ if name in vars(kind).get("__annotations__", {}))
    declared = vars(owner)["__annotations__"][name]
    if not isinstance(declared, str):
        return declared
    try:
        return eval(declared, dict(vars(sys.modules[owner.__module__])))
    except NameError:  # a name that is imported for type checkers only
        return type(structural_parameters(model)[name])


def convert(model: type[Any], name: str, text: str) -> Any:
    """Read a structural parameter by its annotation: bool, int, float, str, a Literal, or None besides."""
    wanted = annotation(model, name)
    choices = getattr(wanted, "__args__", ())
    if text.lower() == "none" and type(None) in choices:
        return None
    types = [kind for kind in choices if kind is not type(None)] if type(None) in choices else [wanted]
    literals = [value for value in choices if not inspect.isclass(value)]
    for value in literals:
        if str(value) == text:
            return value
    if literals:
        names = [str(value) for value in literals]
        raise UsageError(
            f"--set {name}={text}: {name} is one of {', '.join(names)}", remedy=nearest(text, names)
        )
    for kind in types:
        try:
            if kind is bool:
                return TRUTH[text.lower()]
            if kind in (int, float, str):
                return kind(text)
        except (ValueError, KeyError):
            continue
    kinds = " or ".join(getattr(kind, "__name__", str(kind)) for kind in types)
    raise UsageError(f"--set {name}={text}: {name} is a structural parameter of type {kinds}")


def quantity(text: str, option: str) -> float | str:
    """A number (SI), or the text of a number with a unit, for the parameter's own unit to judge."""
    match = NUMBER.fullmatch(text)
    if match is None:
        raise UsageError(f"{option}: {text!r} is no number", remedy="write 3e-6, 150bar or '150 bar'")
    return f"{float(match[1])!r} {match[2]}" if match[2] else float(match[1])


def read_inputs(texts: Iterable[str], units: Mapping[str, str]) -> dict[str, Input]:
    """Read the --input options: constants, or columns of CSV files over time.

    Parameters
    ----------
    texts : "path=value", "path=value unit", "path=file.csv" or "path=file.csv:column".
    units : the model's inputs and their SI units.

    Raises
    ------
    UsageError
        Where the model has no such input, or the file or its column is missing or holds no numbers.
    """
    from arthur_acausal.units import to_si

    inputs: dict[str, Input] = {}
    for path, text in assignments(texts, "--input").items():
        if path not in units:
            known = f"it has {', '.join(units)}" if units else "it has none"
            raise UsageError(f"the model has no input {path!r}", remedy=nearest(path, units) or known)
        is_file = any(Path(name).is_file() for name in (text, text.rpartition(":")[0]))
        if NUMBER.fullmatch(text) and not is_file:
            inputs[path] = to_si(quantity(text, "--input"), units[path], path=path)
        else:
            inputs[path] = read_column(text)
    return inputs


def read_column(text: str) -> Input:
    """A column of a CSV file over its column "time": "file.csv:column", or "file.csv" if it has no other."""
    from arthur_acausal.solve.table import Table

    file, colon, column = text.rpartition(":")
    if not colon or Path(text).is_file():
        return Table.from_csv(text)
    return Table.from_csv(file, column=column)
