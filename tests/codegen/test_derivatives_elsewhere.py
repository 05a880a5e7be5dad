"""Derivatives that stand outside of the dynamic equations: in initial equations and in relations."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal import (
    Component,
    Equations,
    Real,
    StructureError,
    der,
    discrete,
    parameter,
    pre,
    real_input,
    translate,
    variable,
    when,
)


class Pair(Component):
    """d = b - a^2 is no state; its derivative is -2 b + a + 2 a^2 over tau."""

    tau: Real = parameter("s", default=1.0)
    a: Real = variable("1", start=1.0)
    b: Real = variable("1", start=3.0, fixed=True)
    d: Real = variable("1")
    n: Real = discrete()

    def equations(self) -> Equations:
        yield self.tau * der(self.a) == -self.a
        yield self.tau * der(self.b) == -2 * self.b + self.a
        yield self.d == self.b - self.a**2
        yield when(self.tau * der(self.d) < -0.3, self.n == pre(self.n) + 1)

    def initial_equations(self) -> Equations:
        yield self.tau * der(self.d) == 0


def test_an_initial_equation_may_hold_a_derivative_of_its_own() -> None:
    solution = translate(Pair()).simulate(1.0, tolerance=1e-9)
    assert solution.initial("a") == pytest.approx(1.5, rel=1e-12)  # 2 a^2 + a - 6 = 0
    assert solution.final("n") == 1.0  # a relation may, too: d' = 1.5 (e^-2t - e^-t)
    crossing = solution.events[0].time
    assert np.exp(-2 * crossing) - np.exp(-crossing) == pytest.approx(-0.2, rel=1e-7)


class Following(Component):
    u: Real = real_input("1", default=1.0)
    y: Real = variable("1")
    x: Real = variable("1", start=0.0)
    T: Real = parameter("s", default=1.0)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == self.u - self.x
        yield self.y == 2 * self.u - self.x

    def initial_equations(self) -> Equations:
        yield self.T * der(self.y) == 0


def test_a_derivative_that_cannot_be_known_is_named() -> None:
    with pytest.raises(StructureError, match=r"der\(y\) stands in no equation of the dynamics"):
        translate(Following())
