"""A division by a start value of zero, in an equation that is substituted into another; one beside it is harmless."""

from __future__ import annotations

from arthur_acausal import Component, Equations, InitializationError, Real, der, parameter, simulate, variable

ERROR = InitializationError
EXPECT = [r"at t = 0 s these have no finite value: \"attraction\" \([^;]*$", r"\br = 0", r"remedy"]


class Orbit(Component):
    k: Real = parameter("m^3/s^2", default=1.0)
    r: Real = variable("m", start=0.0, fixed=True)
    v: Real = variable("m/s", start=0.0, fixed=True)
    a: Real = variable("m/s^2")
    curvature: Real = variable("1/m")

    def equations(self) -> Equations:
        yield der(self.r) == self.v
        yield "shown only", self.curvature == 1 / self.r
        yield "acceleration", der(self.v) == 2 * self.a
        yield "attraction", self.a == -self.k / self.r**2  # culprit


def run() -> object:
    return simulate(Orbit(), 1.0)
