"""Tables of one and two signals, named as in the Modelica Standard Library (Blocks.Tables)."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from itertools import pairwise
from os import PathLike
from pathlib import Path
from typing import Self

from casadi import SX, fmax, fmin

from arthur_acausal import (
    DeclarationError,
    Equations,
    Real,
    parameter,
    real_input,
    real_output,
    smooth_if_else,
)
from arthur_acausal.components.blocks.signal import SISO, Block


def check_increasing(name: str, values: Sequence[float]) -> None:
    """Raise DeclarationError unless there are at least two values and each is above the one before."""
    if len(values) < 2 or any(b <= a for a, b in pairwise(values)):
        raise DeclarationError(f"{name} must increase, with at least two values, not {tuple(values)}")


class Table1D(SISO):
    """y over u from a table: ``us`` increasing, ``ys``, tuples of numbers (structural).

    ``smoothness``: "linear", or "monotone", the cubic of Fritsch and Carlson (SIAM J. Numer. Anal. 17 (1980), 238),
    which has a continuous slope and no over- or undershoot. ``extrapolation``: "hold" the last value, or
    "linear", by the last slope. No events. ``u_unit``, ``y_unit``: what a number 1 in the table means.
    """

    us: tuple[float, ...]
    ys: tuple[float, ...]
    smoothness: str = "linear"
    extrapolation: str = "hold"
    _units = {"u": "{u}", "y": "{y}", "u_unit": "{u}", "y_unit": "{y}"}
    u_unit: Real = parameter("1", default=1.0, min=0.0)
    y_unit: Real = parameter("1", default=1.0)

    @classmethod
    def from_csv(cls, file: str | PathLike[str], u: str, y: str) -> Self:
        """Return the table of two columns, by their names in the header line of a CSV file."""
        with Path(file).open(newline="", encoding="utf-8") as lines:
            rows = list(csv.DictReader(lines))
        return cls(us=tuple(float(r[u]) for r in rows), ys=tuple(float(r[y]) for r in rows))

    def equations(self) -> Equations:
        check_increasing("us", self.us)
        x = self.u / self.u_unit
        pieces = cubics(self.us, self.ys, self.smoothness)
        if self.extrapolation == "hold":
            x = fmin(fmax(x, self.us[0]), self.us[-1])
            corners = self.us[1:-1]
        else:
            corners = self.us
            pieces = [tangent(pieces[0], 0.0), *pieces, tangent(pieces[-1], self.us[-1] - self.us[-2])]
        shape = polynomial(pieces[-1], x)
        for corner, piece in zip(reversed(corners), reversed(pieces[:-1]), strict=True):
            shape = smooth_if_else(x < corner, polynomial(piece, x), shape)
        yield self.y == self.y_unit * shape


Cubic = tuple[float, tuple[float, ...]]
"""A polynomial about a place: (place, coefficients from the constant on)."""


def cubics(xs: Sequence[float], ys: Sequence[float], smoothness: str) -> list[Cubic]:
    """Return one polynomial for each interval."""
    if smoothness == "linear":
        points = list(zip(xs, ys, strict=True))
        return [(a, (ya, (yb - ya) / (b - a))) for (a, ya), (b, yb) in pairwise(points)]
    from scipy.interpolate import PchipInterpolator  # imported when used

    c = PchipInterpolator(xs, ys).c
    return [(x, tuple(float(v) for v in c[::-1, i])) for i, x in enumerate(xs[:-1])]


def tangent(piece: Cubic, at: float) -> Cubic:
    """Return the tangent of a polynomial at the distance ``at`` from its place."""
    place, c = piece
    value = sum(v * at**k for k, v in enumerate(c))
    slope = sum(k * v * at ** (k - 1) for k, v in enumerate(c) if k)
    return place + at, (value, slope)


def polynomial(piece: Cubic, x: SX) -> SX:
    """Return the polynomial at ``x``, by Horner's rule."""
    place, c = piece
    total = SX(c[-1])
    for coefficient in reversed(c[:-1]):
        total = total * (x - place) + coefficient
    return total


class Table2D(Block):
    """y over u1 and u2, bilinear between the points of a grid: ``u1s``, ``u2s`` increasing, ``ys`` rows over u1.

    Structural: tuples of numbers. ``extrapolation``: "hold" the value at the edge, or "linear". No events.
    ``u1_unit``, ``u2_unit``, ``y_unit``: what a number 1 means.
    """

    u1s: tuple[float, ...]
    u2s: tuple[float, ...]
    ys: tuple[tuple[float, ...], ...]
    extrapolation: str = "hold"
    _units = {"u1": "{u}", "u2": "{u}", "y": "{y}", "u1_unit": "{u}", "u2_unit": "{u}", "y_unit": "{y}"}
    u1: Real = real_input("1")
    u2: Real = real_input("1")
    y: Real = real_output("1")
    u1_unit: Real = parameter("1", default=1.0, min=0.0)
    u2_unit: Real = parameter("1", default=1.0, min=0.0)
    y_unit: Real = parameter("1", default=1.0)

    def equations(self) -> Equations:
        rows = weights(self.u1 / self.u1_unit, self.u1s, self.extrapolation)
        columns = weights(self.u2 / self.u2_unit, self.u2s, self.extrapolation)
        total = SX(0.0)
        for row, values in zip(rows, self.ys, strict=True):
            along = sum((w * value for w, value in zip(columns, values, strict=True)), SX(0.0))
            total = total + row * along
        yield self.y == self.y_unit * total


def weights(x: SX, xs: Sequence[float], extrapolation: str) -> list[SX]:
    """Return the weight of each point in the linear interpolation at ``x``: hat functions, their sum is 1."""
    check_increasing("the points of a table", xs)
    if extrapolation == "hold":
        x = fmin(fmax(x, xs[0]), xs[-1])
    found, last = [], len(xs) - 1
    for i, at in enumerate(xs):
        sides = []
        if i > 0:  # rises from the point before; at the second point it goes on below the first
            rise = (x - xs[i - 1]) / (at - xs[i - 1])
            sides.append(rise if i == 1 else fmax(rise, 0))
        if i < last:
            fall = (xs[i + 1] - x) / (xs[i + 1] - at)
            sides.append(fall if i == last - 1 else fmax(fall, 0))
        hat = sides[0] if len(sides) == 1 else fmin(sides[0], sides[1])
        found.append(hat)
    return found
