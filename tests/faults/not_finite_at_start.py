"""A division by a start value of zero."""

from __future__ import annotations

from arthur_acausal import Component, Equations, InitializationError, Real, der, parameter, simulate, variable

ERROR = InitializationError
EXPECT = [r"at t = 0 s", r"no finite value", r"\"attraction\"", r"\br = 0", r"remedy"]


class Orbit(Component):
    k: Real = parameter("m^3/s^2", default=1.0)
    r: Real = variable("m", start=0.0, fixed=True)
    v: Real = variable("m/s", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.r) == self.v
        yield "attraction", der(self.v) == -self.k / self.r**2  # culprit


def run() -> object:
    return simulate(Orbit(), 1.0)
