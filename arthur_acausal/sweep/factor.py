"""What a varied quantity may be: a range, a list, a distribution, or a column of a file."""

from __future__ import annotations

import csv
import itertools
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.errors import UsageError, nearest

Value: TypeAlias = "float | str"

NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([^\d\s,:()][^,:()]*?)?\s*")
_CALL = re.compile(r"\s*(\w+)\s*\((.*)\)\s*", re.DOTALL)
DISTRIBUTIONS = {"uniform": 2, "loguniform": 2, "normal": 2, "triangular": 3}
FORMS = "low:high:count, low:high/step=x, a,b,c, uniform(low, high), csv(file:column)"


@dataclass(frozen=True, slots=True)
class Factor:
    """One varied quantity.

    Attributes
    ----------
    values : the values that it takes, numbers (SI) or texts (numbers with a unit, words, names of files); empty for
        a distribution.
    distribution : "uniform", "loguniform", "normal", "triangular", or "" for values.
    arguments : of the distribution, in ``unit``: low, high; mean, standard deviation; low, mode, high.
    unit : of the arguments; "" for SI.
    """

    values: tuple[Value, ...] = ()
    distribution: str = ""
    arguments: tuple[float, ...] = ()
    unit: str = ""

    def at(self, u: NDArray[np.float64]) -> list[Value]:
        """Return a value for each number of [0, 1): the quantile of the distribution, or one of the values."""
        if not self.distribution:
            last = len(self.values) - 1
            return [self.values[min(int(x * len(self.values)), last)] for x in u.tolist()]
        return [quantity(x, self.unit) for x in self._quantiles(u).tolist()]

    def _quantiles(self, u: NDArray[np.float64]) -> NDArray[np.float64]:
        from scipy import stats

        a = self.arguments
        if self.distribution == "uniform":
            return a[0] + (a[1] - a[0]) * u
        if self.distribution == "loguniform":
            return np.asarray(a[0] * (a[1] / a[0]) ** u)
        if self.distribution == "normal":
            inside = np.clip(
                u, 2.0**-53, 1.0 - 2.0**-53
            )  # Sobol's first point is 0: a value, not minus infinity
            return np.asarray(stats.norm.ppf(inside, loc=a[0], scale=a[1]))
        width = a[2] - a[0]
        return np.asarray(stats.triang.ppf(u, (a[1] - a[0]) / width, loc=a[0], scale=width))


def quantity(number: float, unit: str) -> Value:
    """Return a number as a value: itself in SI, else text with its unit."""
    return f"{number!r} {unit}" if unit else number


def parse_factor(name: str, given: object, folder: Path) -> Factor:
    """Return the factor that a text, number or list describes.

    Parameters
    ----------
    name : of the quantity, for messages.
    given : ``"150bar:250bar:6"`` (count), ``"1:2/step=0.25"``, ``"1e-6:1e-3:4/log"``, ``"0.1,0.3"``,
        ``"uniform(1 bar, 2 bar)"`` (also loguniform, normal, triangular; ``"low:high"`` is uniform),
        ``"csv(file.csv:column)"``; a number or a word alone is one value; a list has values.
    folder : where files stand; a name must not lead out of it.

    Raises UsageError for anything else.
    """
    try:
        if isinstance(given, list | tuple):
            return Factor(tuple(_value(entry) for entry in given))
        if isinstance(given, bool) or not isinstance(given, str):
            return Factor((_value(given),))
        return _parse_text(given, folder)
    except UsageError as error:
        raise UsageError(
            f"{name} = {given!r}: {error.message}", cause=error.cause, remedy=error.remedy or FORMS
        ) from None


def _parse_text(text: str, folder: Path) -> Factor:
    call = _CALL.fullmatch(text)
    if call is not None:
        return _parse_call(call[1], call[2], folder)
    if "," in text:
        return Factor(tuple(_value(entry) for entry in text.split(",")))
    if ":" in text:
        return _parse_range(text)
    return Factor((_value(text),))


def _value(given: object) -> Value:
    """Return one value: a number in SI, a text of a number with its unit, or a word."""
    if isinstance(given, bool):
        return str(given).lower()
    if isinstance(given, int | float):
        return float(given)
    if not isinstance(given, str) or not given.strip():
        raise UsageError(f"{given!r} is no value")
    match = NUMBER.fullmatch(given)
    if match is None:
        return given.strip()
    return quantity(float(match[1]), match[2] or "")


def _parse_range(text: str) -> Factor:
    body, slash, option = text.partition("/")
    # a unit may have a slash of its own: the option is what stands behind the last one
    if slash:
        body, _, option = text.rpartition("/")
        if option.strip() != "log" and not option.strip().startswith("step"):
            body, option = text, ""
    parts = body.split(":")
    if len(parts) not in (2, 3):
        raise UsageError("a range is low:high:count")
    (low, unit_low), (high, unit_high) = _number(parts[0]), _number(parts[1])
    unit = unit_low or unit_high
    if unit_low and unit_high and unit_low != unit_high:
        raise UsageError(f"a range in {unit_low} and {unit_high}", remedy="use one unit")
    if option.strip().startswith("step"):
        return _stepped(low, high, option, unit)
    if len(parts) == 2:
        if option:
            return _distribution("loguniform", (low, high), unit)
        return _distribution("uniform", (low, high), unit)
    try:
        count = int(parts[2])
    except ValueError:
        raise UsageError(f"the count {parts[2]!r} is no whole number") from None
    if count < 1:
        raise UsageError(f"the count is {count}")
    if option and not low * high > 0.0:
        raise UsageError("a logarithmic range needs limits of one sign, not zero")
    numbers = np.geomspace(low, high, count) if option else np.linspace(low, high, count)
    return Factor(tuple(quantity(x, unit) for x in numbers.tolist()))


def _stepped(low: float, high: float, option: str, unit: str) -> Factor:
    name, equals, text = option.partition("=")
    if name.strip() != "step" or not equals:
        raise UsageError("a range with a step is low:high/step=x")
    step, unit_step = _number(text)
    if unit_step and unit and unit_step != unit:
        raise UsageError(f"a range in {unit} and a step in {unit_step}", remedy="use one unit")
    if step == 0.0 or (high - low) / step < 0.0:
        raise UsageError(f"no step of {step:g} leads from {low:g} to {high:g}")
    count = math.floor((high - low) / step * (1.0 + 1e-12)) + 1
    return Factor(tuple(quantity(low + k * step, unit or unit_step) for k in range(count)))


def _parse_call(name: str, inner: str, folder: Path) -> Factor:
    if name == "csv":
        return Factor(tuple(_column(inner, folder)))
    if name not in DISTRIBUTIONS:
        known = [*DISTRIBUTIONS, "csv"]
        raise UsageError(f"there is no {name}()", remedy=nearest(name, known) or f"one of {', '.join(known)}")
    pairs = [_number(entry) for entry in inner.split(",")]
    units = {unit for _, unit in pairs if unit}
    if len(units) > 1:
        raise UsageError(f"{name}() in {' and '.join(sorted(units))}", remedy="use one unit")
    return _distribution(name, tuple(number for number, _ in pairs), units.pop() if units else "")


def _distribution(name: str, arguments: tuple[float, ...], unit: str) -> Factor:
    if len(arguments) != DISTRIBUTIONS[name]:
        raise UsageError(f"{name}() takes {DISTRIBUTIONS[name]} numbers, not {len(arguments)}")
    rising = all(a <= b for a, b in itertools.pairwise(arguments)) and (arguments[0] < arguments[-1])
    if name == "normal":
        if arguments[1] <= 0.0:
            raise UsageError(f"the standard deviation is {arguments[1]:g}")
    elif not rising:
        raise UsageError(f"the limits {', '.join(f'{a:g}' for a in arguments)} do not rise")
    if name == "loguniform" and arguments[0] <= 0.0:
        raise UsageError("loguniform() needs limits above zero")
    return Factor(distribution=name, arguments=arguments, unit=unit)


def _number(text: str) -> tuple[float, str]:
    match = NUMBER.fullmatch(text)
    if match is None:
        raise UsageError(f"{text.strip()!r} is no number")
    return float(match[1]), match[2] or ""


def _column(inner: str, folder: Path) -> Sequence[Value]:
    """Return a column of a CSV file with a header row: ``file.csv:column``, or ``file.csv`` if it has only one."""
    name, _, column = inner.strip().rpartition(":")
    if not name:
        name, column = column, ""
    path = inside(name, folder)
    try:
        with path.open(newline="", encoding="utf-8-sig") as stream:
            rows = list(csv.DictReader(stream))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise UsageError(f"{name} cannot be read", cause=reason or "") from None
    if not rows:
        raise UsageError(f"{name} has no rows")
    header = [key for key in rows[0] if key]
    if not column and len(header) == 1:
        column = header[0]
    if column not in header:
        raise UsageError(f"{name} has no column {column!r}", remedy=f"it has {', '.join(header)}")
    return [_value((row[column] or "").strip()) for row in rows]


def inside(name: str, folder: Path) -> Path:
    """Return the path of a file below a folder; UsageError where the name leads out of it."""
    path = (folder / name).resolve()
    if not path.is_relative_to(folder.resolve()):
        raise UsageError(f"{name} is not inside of {folder}", remedy="put the file beside the specification")
    return path
