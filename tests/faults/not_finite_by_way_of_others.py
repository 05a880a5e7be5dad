"""The root of a level below zero, in an equation that is solved for its own unknown and substituted into others."""

from __future__ import annotations

from casadi import sqrt

from arthur_acausal import Component, Equations, Real, SimulationError, der, parameter, simulate, variable

ERROR = SimulationError
EXPECT = [r"failed at t = (0\.9|1)", r"no finite value at t = [\d.]+ s: \"outflow\" \([^;]*\); ", r"\bx = -"]


class Tank(Component):
    v: Real = parameter("m/s", default=1.0)
    g: Real = parameter("m/s^2", default=1.0)
    half: Real = parameter("1", default=0.5)
    T: Real = parameter("s", default=1.0)
    x: Real = variable("m", start=1.0, fixed=True)
    w: Real = variable("m/s")
    loss: Real = variable("m/s")
    y: Real = variable("m", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield "level", der(self.x) == -self.v
        yield "collected", self.T * der(self.y) == self.T * self.loss - self.y
        yield "loss", self.loss == self.half * self.w
        yield "outflow", self.w == sqrt(self.x * self.g)  # culprit


def run() -> object:
    return simulate(Tank(), 2.0)
