"""A bob that is to start farther away than its rod is long."""

from __future__ import annotations

from arthur_acausal import Component, Equations, InitializationError, Real, der, parameter, simulate, variable

ERROR = InitializationError
EXPECT = [r"rod"]


class Bob(Component):
    L: Real = parameter("m", default=1.0)
    m: Real = parameter("kg", default=1.0)
    g: Real = parameter("m/s^2", default=9.81)
    x: Real = variable("m", start=2.0, fixed=True)
    y: Real = variable("m", start=-0.8)
    u: Real = variable("m/s", start=0.0, fixed=True)
    v: Real = variable("m/s")
    F: Real = variable("N")

    def equations(self) -> Equations:
        yield self.u == der(self.x)
        yield self.v == der(self.y)
        yield self.m * der(self.u) == -self.F * self.x / self.L
        yield self.m * der(self.v) == -self.F * self.y / self.L - self.m * self.g
        yield "rod", self.x**2 + self.y**2 == self.L**2  # culprit


def run() -> object:
    return simulate(Bob(), 1.0)
