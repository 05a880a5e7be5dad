"""The exponential of a length."""

from __future__ import annotations

from casadi import exp

from arthur_acausal import Component, Equations, Real, UnitError, der, parameter, translate, variable

ERROR = UnitError
EXPECT = [r"exp", r"\bm\b"]


class Growth(Component):
    x: Real = variable("m", start=1.0, fixed=True)
    v: Real = parameter("m/s", default=1.0)

    def equations(self) -> Equations:
        yield "growth", der(self.x) == self.v * exp(self.x)  # culprit


def run() -> object:
    return translate(Growth())
