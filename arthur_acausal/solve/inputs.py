"""External inputs of a model: constants, functions of time, tables."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from arthur_acausal.errors import UsageError, nearest
from arthur_acausal.solve.protocol import FloatArray
from arthur_acausal.solve.table import Piecewise, Table

Input: TypeAlias = "float | Callable[[float], float] | Table"


@dataclass(frozen=True, slots=True)
class _Function:
    index: int
    path: str
    function: Callable[[float], float]


class Inputs:
    """Writes the inputs' values at a time into `u`.

    At a jump of a table the value depends on the side: `begin(t)` selects the piece that starts at t or holds t,
    and until the next `begin` all values come from that piece.

    Attributes
    ----------
    varying : whether any input depends on time.
    jumps : times of all jumps inside the run, ascending, s.
    """

    def __init__(
        self,
        paths: Sequence[str],
        default: FloatArray,
        given: Mapping[str, Input],
        u: FloatArray,
        start_time: float,
        stop_time: float,
    ) -> None:
        self._u = u
        u[:] = default
        self._functions: list[_Function] = []
        tables: list[tuple[int, Table]] = []
        place = {path: index for index, path in enumerate(paths)}
        for path, value in given.items():
            if path not in place:
                raise UsageError(
                    f"the model has no input {path!r}", remedy=nearest(path, paths) or _listing(paths)
                )
            index = place[path]
            if isinstance(value, Table):
                tables.append((index, value.over(start_time, stop_time, path)))
            elif callable(value):
                self._functions.append(_Function(index, path, value))
            else:
                u[index] = _constant(path, value)
        self._groups = [Piecewise(indices, members, u) for indices, members in _grouped(tables)]
        self.varying = bool(self._functions or self._groups)
        self.jumps = sorted({t for group in self._groups for t in group.jumps if start_time < t < stop_time})
        self.refresh = self._refresher()
        for item in self._functions:
            _check_function(item, start_time)
        self.begin(start_time)

    def begin(self, t: float, ahead: float = 0.0) -> None:
        """Enter the piece of every table that holds t + ahead or starts there, and write its values at t."""
        for group in self._groups:
            group.begin(t + ahead)
        self.refresh(t)

    def next_jump(self, t: float) -> float:
        """The first jump after t, or infinity."""
        after = bisect_right(self.jumps, t)
        return self.jumps[after] if after < len(self.jumps) else float("inf")

    def sample(self, times: FloatArray) -> FloatArray:
        """Values at `times`, which lie in the present piece: shape (len(times), nu); (nu,) if all are constant."""
        if not self.varying:
            return self._u.copy()
        values = np.empty((times.size, self._u.size))
        values[:] = self._u
        for group in self._groups:
            values[:, group.indices] = group.sample(times)
        for item in self._functions:
            values[:, item.index] = [item.function(t) for t in times.tolist()]
        return values

    def _refresher(self) -> Callable[[float], None]:
        """The cheapest function that does the work."""
        u = self._u
        groups = [group.refresh for group in self._groups]
        functions = [(item.index, item.function) for item in self._functions]
        if len(groups) == 1 and not functions:
            return groups[0]

        def refresh(t: float) -> None:
            for group in groups:
                group(t)
            for index, function in functions:
                u[index] = function(t)

        return refresh


def _grouped(tables: list[tuple[int, Table]]) -> list[tuple[list[int], list[Table]]]:
    """Tables with the same times and the same interpolation are evaluated together."""
    groups: dict[tuple[str, bytes], list[tuple[int, Table]]] = {}
    for index, table in sorted(tables, key=lambda item: item[0]):
        groups.setdefault((table.interpolation, table.times.tobytes()), []).append((index, table))
    return [([i for i, _ in group], [table for _, table in group]) for group in groups.values()]


def _constant(path: str, value: object) -> float:
    if isinstance(value, bool | int | float | np.number):
        number = float(value)
        if np.isfinite(number):
            return number
    raise UsageError(
        f"input {path!r} is {value!r}", remedy="give a finite number, a function of time or a Table"
    )


def _check_function(item: _Function, t: float) -> None:
    value = item.function(t)
    try:
        float(value)
    except (TypeError, ValueError):
        raise UsageError(f"input {item.path!r} is a function that returns {value!r}, not a number") from None


def _listing(paths: Sequence[str]) -> str:
    return f"it has {', '.join(paths)}" if paths else "it has none"
