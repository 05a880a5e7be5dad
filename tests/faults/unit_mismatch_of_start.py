"""A start value in kilograms for a length."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, UnitError, der, parameter, simulate, variable

ERROR = UnitError
EXPECT = [r"\bx\b", r"mass", r"length"]


class Decay(Component):
    x: Real = variable("m", start=1.0, fixed=True)
    T: Real = parameter("s", default=1.0)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == -self.x


def run() -> object:
    return simulate(Decay(), 1.0, start={"x": "5 kg"})
