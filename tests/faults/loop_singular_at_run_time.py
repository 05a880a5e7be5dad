"""A loop whose solution folds back: from there on it has none nearby."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, SimulationError, der, parameter, simulate, variable

ERROR = SimulationError
EXPECT = [r"integration failed at t = 0\.64", r"the error of (a|b) dominates"]


class Loop(Component):
    T: Real = parameter("s", default=1.0)
    k: Real = variable("1", start=0.0, fixed=True)
    a: Real = variable("1", start=1.0)
    b: Real = variable("1", start=1.0)

    def equations(self) -> Equations:
        yield self.T * der(self.k) == 1.0
        yield "first", self.a + self.k * self.b == 1.0 + 0.1 * self.a**3
        yield "second", self.k * self.a + self.b == 3.0 + 0.1 * self.a**3


def run() -> object:
    return simulate(Loop(), 2.0)
