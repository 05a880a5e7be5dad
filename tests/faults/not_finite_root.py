"""The root of a level that falls below zero at t = 1 s."""

from __future__ import annotations

from casadi import sqrt

from arthur_acausal import Component, Equations, Real, SimulationError, der, parameter, simulate, variable

ERROR = SimulationError
EXPECT = [r"failed at t = (0\.9|1)", r"\"outflow\"", r"no finite value", r"\bx\b", r"remedy"]


class Tank(Component):
    v: Real = parameter("m/s", default=1.0)
    g: Real = parameter("m/s^2", default=1.0)
    x: Real = variable("m", start=1.0, fixed=True)
    w: Real = variable("m/s", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield "level", der(self.x) == -self.v
        yield "outflow", der(self.w) == self.g * sqrt(self.x * self.g) / self.v  # culprit


def run() -> object:
    return simulate(Tank(), 2.0)
