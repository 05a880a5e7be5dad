"""A function of time given by points, and its fast evaluation together with others on the same times."""

from __future__ import annotations

import csv
from bisect import bisect_right
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from arthur_acausal.errors import UsageError, nearest
from arthur_acausal.solve.protocol import FloatArray


@dataclass(frozen=True, slots=True, init=False, eq=False)
class Table:
    """A function of time given by points.

    Attributes
    ----------
    times : (k,), s, ascending. A time that stands twice is a jump: the first value holds up to it, the second
        from it on.
    values : (k,), in the input's SI unit.
    interpolation : "linear", or "pchip": a smooth cubic that overshoots nowhere (Fritsch and Carlson, 1980).
    extrapolation : "error", or "hold": the first and last value hold outside.
    source : where the points come from, for messages.
    """

    times: FloatArray
    values: FloatArray
    interpolation: Literal["linear", "pchip"]
    extrapolation: Literal["error", "hold"]
    source: str

    def __init__(
        self,
        times: ArrayLike,
        values: ArrayLike,
        *,
        interpolation: Literal["linear", "pchip"] = "linear",
        extrapolation: Literal["error", "hold"] = "error",
        source: str = "table",
    ) -> None:
        t, v = np.array(times, dtype=np.float64), np.array(values, dtype=np.float64)
        _check_points(t, v, source)
        if interpolation not in ("linear", "pchip"):
            raise UsageError(
                f"{source}: interpolation {interpolation!r}", remedy='choose "linear" or "pchip"'
            )
        if extrapolation not in ("error", "hold"):
            raise UsageError(f"{source}: extrapolation {extrapolation!r}", remedy='choose "error" or "hold"')
        for array in (t, v):
            array.setflags(write=False)
        for name, value in (
            ("times", t),
            ("values", v),
            ("interpolation", interpolation),
            ("extrapolation", extrapolation),
            ("source", source),
        ):
            object.__setattr__(self, name, value)

    @classmethod
    def from_csv(
        cls,
        path: str | Path,
        time: str = "time",
        column: str | None = None,
        *,
        interpolation: Literal["linear", "pchip"] = "linear",
        extrapolation: Literal["error", "hold"] = "error",
    ) -> Table:
        """Read two columns, by the names in the file's first line; without `column`, the only one besides `time`."""
        times, values, name = _read_csv(Path(path), time, column)
        source = f"{path}, column {name!r}"
        return cls(times, values, interpolation=interpolation, extrapolation=extrapolation, source=source)

    def over(self, start_time: float, stop_time: float, path: str) -> Table:
        """This table, held at its ends as far as the run goes; an error if it is too short and may not be."""
        first, last = float(self.times[0]), float(self.times[-1])
        if first <= start_time and stop_time <= last:
            return self
        if self.extrapolation != "hold":
            raise UsageError(
                f"input {path!r}: {self.source} covers {first:g} s to {last:g} s, the run {start_time:g} s to "
                f"{stop_time:g} s",
                remedy='add points, shorten the run, or declare extrapolation="hold"',
            )
        before = [start_time] if start_time < first else []
        after = [stop_time] if stop_time > last else []
        return Table(
            np.concatenate([before, self.times, after]),
            np.concatenate([self.values[:1][: len(before)], self.values, self.values[-1:][: len(after)]]),
            interpolation=self.interpolation,
            extrapolation=self.extrapolation,
            source=self.source,
        )


class Piecewise:
    """Some tables with the same times: a polynomial in t - times[i] on each interval i.

    `coefficients` has shape (intervals, order + 1, tables), the highest power first. A piece reaches from one jump
    to the next.
    """

    def __init__(self, indices: list[int], tables: list[Table], u: FloatArray) -> None:
        times = tables[0].times
        values = np.column_stack([table.values for table in tables])
        self.indices = indices
        self._times: list[float] = times.tolist()
        self._knots = times
        self._steps = [i for i in range(len(self._times) - 1) if self._times[i] == self._times[i + 1]]
        self.jumps = [self._times[i] for i in self._steps]
        bounds = [0, *(i + 1 for i in self._steps), len(self._times)]
        self._coefficients = _coefficients(times, values, bounds, tables[0].interpolation)
        self._powers = np.ones(self._coefficients.shape[1])
        self._cubic = self._powers.size == 4
        self._bounds = bounds
        contiguous = indices == list(range(indices[0], indices[0] + len(indices)))
        self._u = u
        self._view = u[indices[0] : indices[0] + len(indices)] if contiguous else None
        self._target = self._view if self._view is not None else np.empty(len(indices))
        self._scatter = np.array(indices, dtype=np.intp)
        self.begin(self._times[0])

    def begin(self, t: float) -> None:
        """Enter the piece that starts at t or holds it."""
        piece = bisect_right(self.jumps, t)
        self._low, self._high = self._bounds[piece], self._bounds[piece + 1]
        self._enter(t)

    def _enter(self, t: float) -> None:
        """Select the interval of the present piece that holds t, or its first or last one."""
        low, high = self._low, self._high
        i = bisect_right(self._times, t, low, high) - 1
        i = max(low, min(i, high - 2))
        self._origin = self._times[i]
        self._from = self._origin if i > low else -np.inf
        self._to = self._times[i + 1] if i < high - 2 else np.inf
        self._polynomial = self._coefficients[i]

    def refresh(self, t: float) -> None:
        """Write the values at t."""
        if not self._from <= t < self._to:
            self._enter(t)
        powers, dt = self._powers, t - self._origin
        powers[-2] = dt
        if self._cubic:
            powers[1] = dt * dt
            powers[0] = dt * dt * dt
        target = self._target
        np.dot(powers, self._polynomial, out=target)
        if self._view is None:
            self._u[self._scatter] = target

    def sample(self, times: FloatArray) -> FloatArray:
        """Values at times of the present piece, shape (len(times), tables)."""
        low, high = self._low, self._high
        i = low + np.searchsorted(self._knots[low:high], times, side="right") - 1
        i = np.maximum(low, np.minimum(i, high - 2))
        dt = (times - self._knots[i])[:, None]
        result = self._coefficients[i, 0]
        for power in range(1, self._powers.size):
            result = result * dt + self._coefficients[i, power]
        return np.asarray(result)


def _coefficients(times: FloatArray, values: FloatArray, bounds: list[int], interpolation: str) -> FloatArray:
    """Polynomials of all intervals; those of no length (the jumps), and of pieces of one point, are constant."""
    order = 3 if interpolation == "pchip" else 1
    result = np.zeros((order + 1, len(times), values.shape[1]))
    result[-1] = values
    for low, high in pairwise(bounds):
        if high - low < 2:
            continue
        t, v = times[low:high], values[low:high]
        if interpolation == "pchip":
            from scipy.interpolate import PchipInterpolator

            with np.errstate(over="ignore"):  # slopes of almost no size are inverted on the way
                result[:, low : high - 1] = PchipInterpolator(t, v).c
        else:
            result[0, low : high - 1] = np.diff(v, axis=0) / np.diff(t)[:, None]
    return np.ascontiguousarray(result.transpose(1, 0, 2))


def _check_points(times: FloatArray, values: FloatArray, source: str) -> None:
    if times.ndim != 1 or times.shape != values.shape or not times.size:
        raise UsageError(
            f"{source}: {times.shape} times for {values.shape} values", remedy="give as many of each"
        )
    if not (np.isfinite(times).all() and np.isfinite(values).all()):
        raise UsageError(f"{source}: a time or a value is not finite")
    steps = np.diff(times)
    if (steps < 0.0).any():
        at = int(np.flatnonzero(steps < 0.0)[0])
        raise UsageError(f"{source}: time {times[at + 1]:g} s comes after {times[at]:g} s")
    if ((steps[1:] == 0.0) & (steps[:-1] == 0.0)).any():
        at = int(np.flatnonzero((steps[1:] == 0.0) & (steps[:-1] == 0.0))[0])
        raise UsageError(f"{source}: time {times[at]:g} s stands three times", remedy="twice makes a jump")


def _read_csv(path: Path, time: str, column: str | None) -> tuple[list[float], list[float], str]:
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            lines = csv.reader(file)
            header = [name.strip() for name in next(lines, [])]
            name = _column(path, header, time, column)
            place = (header.index(time), header.index(name))
            rows = [_numbers(path, lines.line_num, row, header, place) for row in lines if any(row)]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        cause = error.strerror if isinstance(error, OSError) else str(error)
        raise UsageError(f"{path} cannot be read as a CSV file", cause=(cause or "").lower()) from None
    if not rows:
        raise UsageError(f"{path} holds no rows below its header")
    return [row[0] for row in rows], [row[1] for row in rows], name


def _column(path: Path, header: list[str], time: str, column: str | None) -> str:
    others = [name for name in header if name != time]
    if column is None and len(others) == 1:
        column = others[0]
    for name in (time, column):
        if name not in header:
            wanted = f"column {name!r}" if name else "column to use, and several"
            raise UsageError(
                f"{path}, line 1: there is no {wanted}",
                remedy=nearest(str(name), header) or f"it has {header}",
            )
    return str(column)


def _numbers(path: Path, line: int, row: list[str], header: list[str], place: tuple[int, int]) -> list[float]:
    numbers = []
    for index in place:
        where = f"{path}, line {line}, column {header[index]!r}"
        if index >= len(row):
            raise UsageError(f"{where}: the line has only {len(row)} fields")
        try:
            numbers.append(float(row[index]))
        except ValueError:
            raise UsageError(f"{where}: {row[index]!r} is not a number") from None
    return numbers
