"""An initial equation that sets a length to a speed."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, UnitError, der, parameter, translate, variable

ERROR = UnitError
EXPECT = [r"begins", r"m/s"]


class Decay(Component):
    x: Real = variable("m", start=1.0)
    T: Real = parameter("s", default=1.0)
    v: Real = parameter("m/s", default=1.0)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == -self.x

    def initial_equations(self) -> Equations:
        yield "begins", self.x == self.v  # culprit


def run() -> object:
    return translate(Decay())
