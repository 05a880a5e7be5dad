"""A length added to a time, deep inside an expression."""

from __future__ import annotations

from casadi import sqrt

from arthur_acausal import Component, Equations, Real, UnitError, parameter, translate, variable

ERROR = UnitError
EXPECT = [r"^Odd ", r"\ba\b.* m\^2 \(area", r"\bb\b.* s \(time", r"remedy"]


class Odd(Component):
    a: Real = parameter("m", default=1.0)
    b: Real = parameter("s", default=1.0)
    x: Real = variable("m")

    def equations(self) -> Equations:
        yield self.x == sqrt(self.a**2 + self.b)  # culprit


def run() -> object:
    return translate(Odd())
