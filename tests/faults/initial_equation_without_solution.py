"""An initial equation that no real number fulfils."""

from __future__ import annotations

from arthur_acausal import Component, Equations, InitializationError, Real, der, parameter, simulate, variable

ERROR = InitializationError
EXPECT = [r"squared", r"x"]


class Decay(Component):
    x: Real = variable("m", start=1.0)
    T: Real = parameter("s", default=1.0)
    A: Real = parameter("m^2", default=1.0)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == -self.x

    def initial_equations(self) -> Equations:
        yield "squared", self.x**2 == -self.A  # culprit


def run() -> object:
    return simulate(Decay(), 1.0)
