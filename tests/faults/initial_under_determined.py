"""A derivative whose coefficient is zero in this run: its initial value is not determined."""

from __future__ import annotations

from arthur_acausal import Component, Equations, InitializationError, Real, der, parameter, simulate, variable

ERROR = InitializationError
EXPECT = [r"\bder\(x\)", r"at t = 0|initial", r"remedy"]


class Tank(Component):
    A: Real = parameter("m^2", default=1.0)
    q: Real = parameter("m^3/s", default=1.0)
    x: Real = variable("m", start=1.0)
    y: Real = variable("m", start=1.0)

    def equations(self) -> Equations:
        yield "balance", self.A * der(self.x) + self.A * der(self.y) == self.q
        yield "exchange", self.A * der(self.x) - self.A * der(self.y) == 0


def run() -> object:
    return simulate(Tank(), 1.0, parameters={"A": 0.0})
