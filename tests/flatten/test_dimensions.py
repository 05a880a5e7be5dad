"""Homogeneity of equations, relations, assignments and values: each operator, and random expressions."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any, NamedTuple

import casadi as ca
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

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


class Term(NamedTuple):
    """An expression of a `Things` and the exponents of m, s and kg that it should have."""

    law: Law
    dimension: tuple[Fraction, Fraction, Fraction]


def power_of_units(s: Any, dimension: tuple[Fraction, ...]) -> Any:
    return s.a ** float(dimension[0]) * s.T ** float(dimension[1]) * s.m ** float(dimension[2])


def added(left: Term, right: Term) -> Term:
    """The sum of a term and another one that is brought to its dimension."""
    gap = tuple(x - y for x, y in zip(left.dimension, right.dimension, strict=True))
    return Term(lambda s: left.law(s) + right.law(s) * power_of_units(s, gap), left.dimension)


def multiplied(left: Term, right: Term) -> Term:
    x, y = left.dimension, right.dimension
    return Term(lambda s: left.law(s) * right.law(s), (x[0] + y[0], x[1] + y[1], x[2] + y[2]))


def divided(left: Term, right: Term) -> Term:
    x, y = left.dimension, right.dimension
    return Term(lambda s: left.law(s) / right.law(s), (x[0] - y[0], x[1] - y[1], x[2] - y[2]))


def squared(term: Term) -> Term:
    x = term.dimension
    return Term(lambda s: term.law(s) ** 2, (2 * x[0], 2 * x[1], 2 * x[2]))


def rooted(term: Term) -> Term:
    x = term.dimension
    return Term(lambda s: ca.sqrt(ca.fabs(term.law(s))), (x[0] / 2, x[1] / 2, x[2] / 2))


def clamped(term: Term) -> Term:
    return Term(
        lambda s: ca.fmax(ca.fmin(term.law(s), 3 * power_of_units(s, term.dimension)), 0), term.dimension
    )


def bent(term: Term) -> Term:
    """The hyperbolic tangent of the term made plain."""
    return Term(lambda s: ca.tanh(term.law(s) / power_of_units(s, term.dimension)), (Fraction(0),) * 3)


def base(name: str, *dimension: int) -> Term:
    x, y, z = (Fraction(d) for d in dimension)
    return Term(lambda s: getattr(s, name), (x, y, z))


leaves = st.sampled_from(
    [base("a", 1, 0, 0), base("x", 1, 0, 0), base("T", 0, 1, 0), base("m", 0, 0, 1), base("r", 0, 0, 0)]
)
terms = st.recursive(
    leaves,
    lambda inner: st.one_of(
        st.builds(added, inner, inner),
        st.builds(multiplied, inner, inner),
        st.builds(divided, inner, inner),
        st.builds(squared, inner),
        st.builds(rooted, inner),
        st.builds(clamped, inner),
        st.builds(bent, inner),
    ),
    max_leaves=8,
)


def unit_text(dimension: tuple[Fraction, ...]) -> str:
    pairs = zip(("m", "s", "kg"), dimension, strict=True)
    return "*".join(f"{unit}^({d.numerator}/{d.denominator})" for unit, d in pairs if d) or "1"


@settings(max_examples=60)
@given(terms, st.integers(0, 2))
def test_random_expressions_have_their_dimension_and_no_other(term: Term, wrong: int) -> None:
    assume(all(abs(d) <= 12 and d.denominator <= 8 for d in term.dimension))
    folded: list[bool] = []

    def law(s: Any) -> Any:
        value = term.law(s)
        folded.append(value.is_constant())
        return value

    flatten(equation(unit_text(term.dimension), law))
    other = list(term.dimension)
    other[wrong] += 1
    if not folded[0]:  # x - x is zero for CasADi, which fits everywhere
        assert not holds(unit_text(tuple(other)), law)


@settings(max_examples=40)
@given(terms, terms)
def test_random_sums_of_different_dimensions_are_refused(left: Term, right: Term) -> None:
    assume(left.dimension != right.dimension)
    assume(all(abs(d) <= 12 and d.denominator <= 8 for d in left.dimension + right.dimension))
    parts: list[bool] = []

    def law(s: Any) -> Any:
        a, b = left.law(s), right.law(s)
        parts.append(a.is_constant() or b.is_constant())
        return a + b

    accepted = holds(unit_text(left.dimension), law)
    assume(not parts[0])
    assert not accepted


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
