"""A lever that shortens to nothing: its equation determines the force no longer."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, SimulationError, der, parameter, simulate, variable

ERROR = SimulationError
EXPECT = [r"t = 1 s", r"singular: F not determined by \"torque\""]


class Lever(Component):
    v: Real = parameter("m/s", default=1.0)
    tau: Real = parameter("N*m", default=1.0)
    L: Real = variable("m", start=1.0, fixed=True)
    F: Real = variable("N", start=1.0)

    def equations(self) -> Equations:
        yield der(self.L) == -self.v
        yield "torque", self.L * self.F == self.tau  # culprit


def run() -> object:
    return simulate(Lever(), 2.0)
