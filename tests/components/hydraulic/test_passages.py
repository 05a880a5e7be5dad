"""Open areas of the passages against outlines drawn point by point and cut: another construction, another integral."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from math import acos, asin, cos, pi, radians, sin, sqrt, tan
from typing import get_args

import numpy as np
import pytest
from casadi import SX, Function
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import root_scalar
from scipy.spatial import ConvexHull

from arthur_acausal.components.hydraulic.servo_valves import APEX, Shape, full_area, open_area

Points = NDArray[np.float64]
N = 2001
"""Points of an arc: the outlines are off by less than 1e-6 of the area."""


def arc(centre: tuple[float, float], radius: float, begin: float, end: float) -> Points:
    angle = np.linspace(begin, end, N)
    return np.column_stack([centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle)])


def mirrored(right: Points) -> Points:
    """Return the outline of which ``right`` is the half on the right, from the bottom up to the apex."""
    return np.vstack([right, (right * [-1.0, 1.0])[::-1]])


def ogive(half: float) -> Points:
    """Return the arc that rises upright from (1, 0) and meets the axis under ``half``."""
    radius = float(root_scalar(lambda r: acos((r - 1) / r) - half, bracket=(1.5, 200.0), xtol=1e-12).root)
    return arc((1 - radius, 0.0), radius, 0.0, half)


def touching(half: float, gamma: float) -> Points:
    """Return the arc that leaves the unit circle at ``gamma``, curved the other way, and meets the axis under ``half``.

    The arc's tangent turns from the circle's own, ``gamma`` to the vertical, to ``half`` on the axis: so many radii
    further. It is followed in small steps.
    """

    def followed(radius: float) -> Points:
        turn = np.linspace(gamma, half, 20 * N)  # of the tangent, from the vertical
        length = radius * (gamma - half) / (turn.size - 1)
        middle = (turn[1:] + turn[:-1]) / 2
        steps = np.column_stack([-np.sin(middle), np.cos(middle)]) * length
        return np.vstack([[cos(gamma), sin(gamma)], steps]).cumsum(axis=0)

    return followed(float(root_scalar(lambda r: followed(r)[-1, 0], bracket=(0.1, 100.0), xtol=1e-12).root))


@cache
def outline(shape: Shape) -> Points:
    """Return the passage's outline, half a width being 1, the apex upwards."""
    half = radians(APEX.get(shape, 90.0)) / 2
    height, bottom = 1 / tan(half), arc((0.0, 0.0), 1.0, -pi / 2, 0.0)
    if shape == "square":
        return np.array([[-1, -1], [1, -1], [1, 1], [-1, 1.0]])
    if shape == "chord":
        return arc((0.0, 0.0), 1.0, 0.0, 2 * pi)
    if shape == "house":
        return np.array([[-1, -2], [1, -2], [1, 0], [0, height], [-1, 0.0]])
    if shape == "diamond":
        return np.array([[0, -height], [1, 0], [0, height], [-1, 0.0]])
    if shape.endswith("triangle"):
        return np.array([[-1, 0], [1, 0], [0, height]])
    if shape == "concave tear drop":
        side = arc((0.0, 0.0), 1.0, -pi / 2, radians(45.0))
        return mirrored(np.vstack([side, touching(half, radians(45.0))]))
    if shape == "convex tear drop":
        return mirrored(np.vstack([bottom, ogive(half)]))
    if shape == "tipped convex tear drop":
        side = ogive(radians(53.1) / 2)
        below = side[side[:, 0] > 0.2]
        foot = np.interp(-0.2, -side[:, 0], side[:, 1])
        tip = np.array([[0.2, foot], [0.0, foot + 0.2 / tan(half)]])
        return mirrored(np.vstack([bottom, below, tip]))
    points = np.vstack([arc((0.0, 0.0), 1.0, 0.0, 2 * pi), [0.0, 1 / sin(half)]])  # tangents: the convex hull
    hull: Points = points[ConvexHull(points).vertices]
    return hull


def cut(points: Points, x: float) -> float:
    """Return the area of a polygon on the left of ``x``: Sutherland and Hodgman (1974), then the shoelace formula."""
    following = np.roll(points, -1, axis=0)
    inside, next_inside = points[:, 0] <= x, following[:, 0] <= x
    crosses = inside != next_inside
    run = np.where(crosses, following[:, 0] - points[:, 0], 1.0)
    crossing = points + ((x - points[:, 0]) / run)[:, None] * (following - points)
    both = np.stack([points, crossing], axis=1)[np.column_stack([inside, crosses])]
    X, Y = both.T
    return abs(float(X @ np.roll(Y, -1) - Y @ np.roll(X, -1))) / 2 if len(both) else 0.0


def lens(s: float) -> float:
    """Return the overlap of two circles of the diameter 1, 1 - s apart, by the heights of both."""
    apart = (1 - s) / 2
    x = np.sin(np.linspace(0.0, pi / 2, 20001)) * (0.5 - apart)  # dense where the height falls to 0
    return 4 * float(np.trapezoid(np.sqrt(np.maximum(0.25 - (x + apart) ** 2, 0.0)), x))


@cache
def area(shape: Shape) -> Callable[[float], float]:
    s = SX.sym("s")
    function = Function("A", [s], [open_area(shape, s)])
    return lambda value: float(function(value))


@pytest.mark.parametrize("shape", get_args(Shape))
@settings(max_examples=30, deadline=None)
@given(s=st.floats(0.0, 1.0))
@example(s=0.0)
@example(s=0.5)
@example(s=1.0)
@example(s=1e-3)
def test_open_area_is_that_of_the_outline_cut(shape: Shape, s: float) -> None:
    expected = lens(s) if shape == "lens" else cut(outline(shape), 2 * s - 1) / 4
    assert area(shape)(s) == pytest.approx(expected, abs=2e-6)


def test_the_outlines_are_the_report_s() -> None:
    """Apex angles of Table 4 at the tips of the outlines drawn, and the concave arc's tip where trigonometry says."""
    for shape, apex in APEX.items():
        points = outline(shape)
        tip = points[:, 1].argmax()
        last = points[tip - 1]
        assert 2 * np.degrees(np.arctan2(abs(last[0]), points[tip, 1] - last[1])) == pytest.approx(
            apex, abs=0.1
        )
    half, gamma = radians(49.2) / 2, radians(45.0)
    radius = cos(gamma) / (cos(half) - cos(gamma))
    tip_y = (1 + radius) * sin(gamma) - radius * sin(half)
    assert outline("concave tear drop")[:, 1].max() == pytest.approx(tip_y, rel=1e-6)


@pytest.mark.parametrize("width", [0.3, 1.0])
def test_a_square_and_a_round_passage_are_as_the_report_has_them(width: float) -> None:
    """A_o = w x and (pi/8) d^2 + (x - d/2) sqrt((d - x) x) + (d^2/4) asin(2 x/d - 1), below 3.11."""
    d = width
    for s in (0.1, 0.37, 0.5, 0.9):
        x = s * d
        assert d**2 * area("square")(s) == pytest.approx(d * x)
        round_ = pi / 8 * d**2 + (x - d / 2) * sqrt((d - x) * x) + d**2 / 4 * asin(2 * x / d - 1)
        assert d**2 * area("chord")(s) == pytest.approx(round_)


def test_nine_equal_areas_are_0_04_to_0_07_inch_wide() -> None:
    """4.1.2 has "roughly equivalent area" at "approximately 0.04 to 0.07 in": so also with what is assumed."""
    widths = [1 / sqrt(full_area(shape)) for shape in get_args(Shape) if shape in APEX]
    assert 0.065 / 0.045 < max(widths) / min(widths) < 0.075 / 0.035
