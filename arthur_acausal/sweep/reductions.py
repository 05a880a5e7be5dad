"""Numbers that stand for a trajectory: final, extreme and mean values, integrals, quantiles, times of crossings."""

from __future__ import annotations

import importlib
import math
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.errors import UsageError, nearest

if TYPE_CHECKING:
    from arthur_acausal.result.solution import Solution

FloatArray = NDArray[np.float64]

DEFAULT = ("final", "min", "max", "mean", "rms")
_CALL = re.compile(r"\s*(\w+)\s*\(\s*(.+?)\s*\)\s*", re.DOTALL)
_FUNCTION = re.compile(r"\s*[A-Za-z_]\w*(\.\w+)*:\w+\s*")
_CROSSING = re.compile(r"(.+?)\s*(<=|>=|<|>)\s*([^<>=]+)")


def _integral(t: FloatArray, x: FloatArray) -> float:
    return float(np.trapezoid(x, t))


def _mean(t: FloatArray, x: FloatArray) -> float:
    span = float(t[-1] - t[0])
    return _integral(t, x) / span if span > 0.0 else float(x[-1])


_OF_TRAJECTORY: dict[str, Callable[[FloatArray, FloatArray], float]] = {
    "final": lambda t, x: float(x[-1]),
    "initial": lambda t, x: float(x[0]),
    "min": lambda t, x: float(np.min(x)),
    "max": lambda t, x: float(np.max(x)),
    "mean": _mean,
    "rms": lambda t, x: math.sqrt(max(_mean(t, x * x), 0.0)),
    "integral": _integral,
}


@dataclass(frozen=True, slots=True)
class Reduction:
    """One column of the table of runs.

    Attributes
    ----------
    name : as it was written, and the column's name.
    kind : "final", "initial", "min", "max", "mean" (over time), "rms", "integral" [unit s], "quantile" (over time),
        "first" (time at which a relation holds for the first time, s; NaN if never), or "function".
    path : variable, or "module:function", which is given the `Solution` and returns a number or a mapping of them.
    argument : the quantile, or the bound of the relation.
    relation : "<", "<=", ">" or ">=" of "first".
    """

    name: str
    kind: str
    path: str
    argument: float = math.nan
    relation: str = ""

    def unit(self, of_variable: str) -> str:
        """Return the unit of the column."""
        if self.kind == "first":
            return "s"
        if self.kind == "integral":
            return "s" if of_variable == "1" else f"{of_variable}*s"
        return of_variable

    def of(self, solution: Solution) -> Mapping[str, float]:
        """Return the column's value; a function may give several columns."""
        if self.kind == "function":
            return self._called(solution)
        t, x = solution.t, solution[self.path]
        if not t.size:
            return {self.name: math.nan}
        if self.kind == "quantile":
            return {self.name: _quantile(t, x, self.argument)}
        if self.kind == "first":
            sign = 1.0 if self.relation[0] == ">" else -1.0
            return {self.name: _first(t, sign * (x - self.argument))}
        return {self.name: _OF_TRAJECTORY[self.kind](t, x)}

    def _called(self, solution: Solution) -> Mapping[str, float]:
        module, _, name = self.path.partition(":")
        found = getattr(importlib.import_module(module), name)(solution)
        if isinstance(found, Mapping):
            return {f"{name}.{key}": float(value) for key, value in found.items()}
        return {name: float(found)}


def parse(texts: Iterable[str] | None, variables: Iterable[str], paths: Iterable[str]) -> list[Reduction]:
    """Return the reductions that the texts name; where there are none, the default ones of ``variables``.

    ``paths``: all that the model has. Raises UsageError for an unknown reduction or variable.
    """
    known = list(paths)
    if texts is None:
        return [Reduction(f"{kind}({path})", kind, path) for path in variables for kind in DEFAULT]
    return [_parse(text, known) for text in texts]


def _parse(text: str, known: list[str]) -> Reduction:
    if _FUNCTION.fullmatch(text):
        return _function(text.strip())
    call = _CALL.fullmatch(text)
    kinds = [*_OF_TRAJECTORY, "quantile", "first"]
    if call is None:
        raise UsageError(
            f"{text!r} is no reduction", remedy="write max(path), quantile(path, 0.95) or module:function"
        )
    kind, inner = call[1], call[2]
    if kind not in kinds:
        raise UsageError(
            f"{text!r}: there is no reduction {kind!r}",
            remedy=nearest(kind, kinds) or f"one of {', '.join(kinds)}",
        )
    argument, relation = math.nan, ""
    if kind == "quantile":
        inner, _, level = inner.rpartition(",")
        argument = _bound(level, text)
        if not 0.0 <= argument <= 1.0:
            raise UsageError(f"{text!r}: a quantile is between 0 and 1", remedy="write quantile(path, 0.95)")
    elif kind == "first":
        crossing = _CROSSING.fullmatch(inner)
        if crossing is None:
            raise UsageError(f"{text!r} has no relation", remedy="write first(path > 1e5), in SI")
        inner, relation, argument = crossing[1], crossing[2], _bound(crossing[3], text)
    path = inner.strip()
    if path not in known:
        raise UsageError(f"{text!r}: there is no variable {path!r}", remedy=nearest(path, known))
    return Reduction(text.strip(), kind, path, argument, relation)


def _function(text: str) -> Reduction:
    """Return the reduction by a function; it is imported now, so that a mistake shows before the first run."""
    module, _, name = text.partition(":")
    try:
        function = getattr(importlib.import_module(module), name, None)
    except ImportError as error:
        raise UsageError(f"{text!r} cannot be imported", cause=str(error)) from None
    if not callable(function):
        raise UsageError(f"{text!r} is no function")
    return Reduction(name, "function", text)


def _bound(text: str, whole: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise UsageError(f"{whole!r}: {text.strip()!r} is no number") from None


def _quantile(t: FloatArray, x: FloatArray, level: float) -> float:
    """Return the value below which a trajectory is for this part of the time; linear between instants."""
    span = np.diff(t)
    middle, weight = 0.5 * (x[1:] + x[:-1]), span
    if not weight.sum() > 0.0:
        return float(x[-1])
    order = np.argsort(middle, kind="stable")
    reached = (np.cumsum(weight[order]) - 0.5 * weight[order]) / weight.sum()
    return float(np.interp(level, reached, middle[order]))


def _first(t: FloatArray, above: FloatArray) -> float:
    """Return the first time at which a trajectory is above zero, by linear interpolation; NaN if never."""
    found = np.flatnonzero(above > 0.0)
    if not found.size:
        return math.nan
    k = int(found[0])
    if k == 0 or t[k] == t[k - 1]:
        return float(t[k])
    a, b = float(above[k - 1]), float(above[k])
    return float(t[k - 1] + (t[k] - t[k - 1]) * (-a) / (b - a))
