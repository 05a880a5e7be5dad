"""math.sqrt of a symbol."""

from __future__ import annotations

import math

from arthur_acausal import Component, Equations, Real, UnitError, der, parameter, translate, variable

ERROR = UnitError
EXPECT = [r"^Tank\b", r"not a number \(NaN\)", r"casadi\'s functions: math\.sqrt"]


class Tank(Component):
    x: Real = variable("m", start=1.0, fixed=True)
    v: Real = parameter("m/s", default=1.0)
    T: Real = parameter("s", default=1.0)

    def equations(self) -> Equations:
        yield der(self.x) == -self.v * math.sqrt(self.x / (self.v * self.T))  # culprit


def run() -> object:
    return translate(Tank())
