"""Shapes of the passages of a servo valve's spool, and how their open area grows (ARTHuR report, Table 4, 4.1.2)."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, radians, sin, sqrt, tan
from typing import Literal

from casadi import SX, asin, fmax, fmin
from casadi import acos as arc_cosine
from casadi import sqrt as root

Shape = Literal[
    "square",
    "chord",
    "lens",
    "tear drop 60",
    "tear drop",
    "concave tear drop",
    "diamond",
    "equilateral triangle",
    "isosceles triangle",
    "convex tear drop",
    "tipped convex tear drop",
    "house",
]
"""``square`` (3.32, 3.50); round ports that a straight edge (``chord``, after 3.11) or a round one (``lens``) uncovers;
then the nine shapes of Table 4 in its order.

Table 4 has names and apex angles, no dimensions. They fix the triangles, the diamond and the tear drops whose sides are
tangents of the circle. The body of the house is a square: it gives figure 4-11's smaller deviation, 1/24. Three shapes
need one dimension more each, assumed: where the sides of the concave and of the convex tear drop leave the circle,
and how wide the tip of the tipped one is; below it is shape 7 (4.1.2: "otherwise identical"). Of equal area (4.1.2:
"roughly equivalent") the nine are then 0.036 to 0.074 in wide, as the "approximately 0.04 to 0.07" of 4.1.2.
"""

APEX = {
    "tear drop 60": 60.0,
    "tear drop": 38.9,
    "concave tear drop": 49.2,
    "diamond": 59.8,
    "equilateral triangle": 60.0,
    "isosceles triangle": 39.7,
    "convex tear drop": 53.1,
    "tipped convex tear drop": 40.0,
    "house": 53.1,
}
"""Apex angle [deg] of each shape of Table 4."""

CONCAVE_TANGENT = radians(45.0)
"""Where the concave tear drop's sides leave the circle, from the horizontal: assumed, half way up the quarter circle.

Below 24.6 deg they would not be concave. The convex one's leave it at 0, upright, assumed: the roundest side there is;
from 26.6 deg on they would not be convex."""

TIP = 0.2
"""Share of the width that the tip of the tipped tear drop stands on: assumed, 4.1.2 calls it narrow."""

EDGE = 1.0 - 1e-12
"""Circles end here: the slope of sqrt(1 - t^2) at t = 1 has no value, and the area to 1 differs by 1e-18."""

Half = Callable[[SX], SX]


def open_area(shape: Shape, s: SX) -> SX:
    """Return the open area over the square of the passage's width [1], where the share ``s`` [1] of it is uncovered.

    The valve moves across the width, apexes point along the valve's axis. ``s`` is limited to 0..1; the area is
    exact, in closed form.
    """
    s = fmin(fmax(s, 0), 1)
    if shape == "lens":
        away = fmin(1 - s, EDGE)
        return (arc_cosine(away) - away * root(1 - away**2)) / 2
    half, x = _halves(shape), 2 * s - 1
    return (half(SX(1)) + half(fmax(x, 0)) - half(fmax(-x, 0))) / 4


def full_area(shape: Shape) -> float:
    """Return the area of the whole passage over the square of its width [1]."""
    return float(open_area(shape, SX(1)))


def _halves(shape: Shape) -> Half:
    """Return the area of a passage of half width 1 between its axis and the distance t, 0 <= t <= 1."""
    if shape == "square":
        return lambda t: 2 * t
    if shape == "chord":
        return lambda t: 2 * _arc(t, 0.0, 1.0)
    slope = 1 / tan(radians(APEX[shape]) / 2)
    if shape == "house":
        return lambda t: 2 * t + _line(t, slope)
    if shape.endswith("triangle"):
        return lambda t: _line(t, slope)
    if shape == "diamond":
        return lambda t: 2 * _line(t, slope)
    top = _top(shape, radians(APEX[shape]) / 2)
    return lambda t: _arc(t, 0.0, 1.0) + top(t)


def _top(shape: Shape, beta: float) -> Half:
    """Return the same for the upper part of a tear drop on a circle of radius 1; ``beta``: half the apex angle."""
    if shape == "concave tear drop":
        gamma = CONCAVE_TANGENT
        # An arc that touches the circle from outside and meets the axis under beta.
        radius = cos(gamma) / (cos(beta) - cos(gamma))
        x, y = (1 + radius) * cos(gamma), (1 + radius) * sin(gamma)
        return _joined(cos(gamma), lambda t: y * t - _arc(t, x, radius), lambda t: _arc(t, 0.0, 1.0))
    if shape == "convex tear drop":
        return _ogive(beta)
    if shape == "tipped convex tear drop":
        beta_7 = radians(APEX["convex tear drop"]) / 2
        radius = 1 / (1 - cos(beta_7))
        foot = sqrt(radius**2 - (TIP + radius - 1) ** 2)
        return _joined(TIP, lambda t: foot * t + _line(t, 1 / tan(beta), TIP), _ogive(beta_7))
    return _joined(
        cos(beta), lambda t: sin(beta) * t + _line(t, 1 / tan(beta), cos(beta)), lambda t: _arc(t, 0.0, 1.0)
    )


def _ogive(beta: float) -> Half:
    """Two arcs that rise upright at t = 1 and meet on the axis."""
    radius = 1 / (1 - cos(beta))
    return lambda t: _arc(t, 1 - radius, radius)


def _joined(at: float, inner: Half, outer: Half) -> Half:
    """``inner`` up to ``at``, ``outer`` from there."""
    return lambda t: inner(fmin(t, at)) + outer(fmax(t, at)) - outer(SX(at))


def _line(t: SX, slope: float, end: float = 1.0) -> SX:
    """Integral from 0 to t of slope (end - t)."""
    return slope * (end * t - t**2 / 2)


def _arc(t: SX, centre: float, radius: float) -> SX:
    """Integral from 0 to t of sqrt(radius^2 - (t - centre)^2)."""

    def of_unit(w: SX) -> SX:
        w = fmin(w, EDGE)
        return (w * root(1 - w**2) + asin(w)) / 2

    return radius**2 * (of_unit((t - centre) / radius) - of_unit(SX(-centre / radius)))
