"""Homogeneity of equations, relations, assignments and values: each operator, and random expressions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca
import pytest

from arthur_acausal import (
    Component,
    Equations,
    Real,
    UnitError,
    der,
    discrete,
    if_else,
    parameter,
    reinit,
    smooth_if_else,
    start,
    time,
    translate,
    variable,
    when,
)
from arthur_acausal.flatten.flatten import flatten

Law = Callable[[Any], Any]


class Things(Component):
    """Quantities to make expressions of: lengths, a time, a mass, plain numbers."""

    a: Real = parameter("m", default=2.0)
    b: Real = parameter("m", default=3.0)
    T: Real = parameter("s", default=5.0)
    m: Real = parameter("kg", default=7.0)
    r: Real = parameter("1", default=0.5)
    phi: Real = parameter("rad", default=0.5)
    x: Real = variable("m", start=1.0)


def equation(unit: str, law: Law) -> Component:
    """A component whose variable y [unit] equals what the law gives."""

    class Checked(Things):
        y: Real = variable(unit)

        def equations(self) -> Equations:
            yield der(self.x) == self.a / self.T
            yield self.y == law(self)

    return Checked()


def holds(unit: str, law: Law) -> bool:
    """Whether y [unit] == law passes the check."""
    try:
        flatten(equation(unit, law))
    except UnitError:
        return False
    return True


# law, its unit by hand
RIGHT: list[tuple[str, Law]] = [
    ("m", lambda s: s.a + s.b - s.x),
    ("m^2", lambda s: s.a * s.b),
    ("1", lambda s: s.a / s.b),
    ("1/m", lambda s: 1 / s.a),
    ("m^2", lambda s: s.a**2 + s.b * s.b),
    ("m^3", lambda s: s.a**3),
    ("m^(1/2)", lambda s: ca.sqrt(s.a)),
    ("m^(3/2)", lambda s: s.a**1.5),
    ("m^(1/3)", lambda s: s.a ** (1 / 3)),
    ("m", lambda s: ca.fabs(-s.a)),
    ("m", lambda s: ca.fmin(s.a, s.b)),
    ("m", lambda s: ca.fmax(s.a, 0)),
    ("m", lambda s: ca.fmin(s.a, float("inf"))),
    ("m", lambda s: ca.fmod(s.a, s.b)),
    ("m", lambda s: ca.copysign(s.a, s.T)),
    ("m", lambda s: ca.floor(s.a / s.b) * s.b),
    ("1", lambda s: ca.sign(s.a)),
    ("m", lambda s: ca.hypot(s.a, s.b)),
    ("1", lambda s: ca.atan2(s.a, s.b)),
    ("1", lambda s: ca.sin(s.phi) + ca.exp(s.r) + ca.log(s.a / s.b)),
    ("1", lambda s: ca.tanh(s.T * der(s.x) / s.a)),
    ("1", lambda s: s.r**s.r),
    ("m/s", lambda s: der(s.x)),
    ("m/s", lambda s: s.a / time()),
    ("m", lambda s: smooth_if_else(s.a < s.b, s.a, s.b)),
    ("m", lambda s: if_else(ca.logic_and(s.a < s.b, s.T > 0), s.a, 0)),
    ("m", lambda s: s.a * ca.logic_or(s.a < s.b, s.r > 0)),
    ("N", lambda s: s.m * s.a / s.T**2),
    ("kg*m^2/s^3", lambda s: s.m * s.a**2 / s.T**3),
    ("rad/s", lambda s: s.phi / s.T),
    ("m", lambda s: 0 * s.a + s.x),
]

WRONG: list[tuple[str, Law]] = [
    ("m", lambda s: s.a + s.T),
    ("m", lambda s: s.a + 1),
    ("m", lambda s: s.a * s.b),
    ("m", lambda s: ca.sqrt(s.a)),
    ("m", lambda s: ca.fmin(s.a, s.T)),
    ("m", lambda s: ca.fmax(s.a, 1.0)),
    ("m", lambda s: ca.hypot(s.a, s.T)),
    ("1", lambda s: ca.sin(s.a)),
    ("1", lambda s: ca.exp(s.a / s.T)),
    ("1", lambda s: ca.atan2(s.a, s.T)),
    ("m", lambda s: s.a**s.r),
    ("1", lambda s: s.r**s.a),
    ("m", lambda s: smooth_if_else(s.a < s.T, s.a, s.b)),
    ("m", lambda s: smooth_if_else(s.a < s.b, s.a, s.T)),
    ("m", lambda s: if_else(s.a < s.T, s.a, s.b)),
    ("m", lambda s: if_else(s.a < 1, s.a, s.b)),
    ("m", lambda s: der(s.x)),
    ("m", lambda s: s.a * time()),
    ("m", lambda s: float("nan") * s.a),
    ("m", lambda s: ca.fmod(s.a, s.T)),
]


@pytest.mark.parametrize(("unit", "law"), RIGHT, ids=[f"{k}-{u}" for k, (u, _) in enumerate(RIGHT)])
def test_homogeneous(unit: str, law: Law) -> None:
    flatten(equation(unit, law))
    assert not holds(f"{unit}*A", law), "the check finds that y has another dimension"


@pytest.mark.parametrize(("unit", "law"), WRONG, ids=[f"{k}-{u}" for k, (u, _) in enumerate(WRONG)])
def test_not_homogeneous(unit: str, law: Law) -> None:
    with pytest.raises(UnitError) as caught:
        flatten(equation(unit, law))
    assert caught.value.where.startswith("test_dimensions.py:")
    assert caught.value.path == "Checked"
    translate(equation(unit, law), check_units=False, compile="never")  # and the check can be left out


class Assigned(Component):
    """Events whose new values are given by the test."""

    what: str = "right"
    v_0: Real = parameter("m/s", default=1.0)
    x: Real = variable("m", start=1.0, fixed=True)
    v: Real = variable("m/s", start=0.0, fixed=True)
    g: Real = parameter("m/s^2", default=9.81)
    last: Real = discrete("m/s")

    def equations(self) -> Equations:
        yield der(self.x) == self.v
        yield der(self.v) == -self.g
        if self.what == "reinit":
            yield when(self.x < 0, reinit(self.v, self.x))
        elif self.what == "discrete":
            yield when(self.x < 0, self.last == self.x)
        elif self.what == "discrete equation":
            yield self.last == self.x
        elif self.what == "condition":
            yield when(self.x < self.v, reinit(self.v, 0))
        else:
            yield when(self.x < 0, reinit(self.v, -self.v), self.last == self.v + self.v_0)

    def initial_equations(self) -> Equations:
        if self.what == "initial equation":
            yield self.v == self.x


@pytest.mark.parametrize("what", ["reinit", "discrete", "discrete equation", "condition", "initial equation"])
def test_events_and_initial_equations_are_checked(what: str) -> None:
    flatten(Assigned())
    with pytest.raises(UnitError, match="velocity, m/s"):
        flatten(Assigned(what=what))


def test_values_that_are_expressions_are_checked() -> None:
    class Square(Component):
        L: Real = parameter("m", default=2.0)
        A: Real = parameter("m^2", default=lambda self: self.L**2)
        x: Real = variable("m", start=lambda self: self.A / self.L)

        def equations(self) -> Equations:
            yield self.x == self.L

    flatten(Square())
    for name, value in [("A", lambda self: self.L), ("x", start(lambda self: self.A))]:

        class Plant(Component):
            L: Real = parameter("m", default=1.0)
            A: Real = parameter("m^2", default=1.0)
            part = Square(**dict[str, Any]({name: value}))

        with pytest.raises(UnitError, match=rf"^part\.{name} \(test_dimensions\.py"):
            flatten(Plant())
