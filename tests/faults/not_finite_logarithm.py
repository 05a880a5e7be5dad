"""The logarithm of an amount that is used up."""

from __future__ import annotations

from casadi import log

from arthur_acausal import Component, Equations, Real, SimulationError, der, parameter, simulate, variable

ERROR = SimulationError
EXPECT = [r"failed at t = 1 s", r"\bmu\b", r"remedy"]


class Cell(Component):
    rate: Real = parameter("mol/s", default=1.0)
    n_0: Real = parameter("mol", default=1.0)
    n: Real = variable("mol", start=1.0, fixed=True)
    mu: Real = variable("1", start=0.0)

    def equations(self) -> Equations:
        yield der(self.n) == -self.rate
        yield "potential", self.mu + 0.1 * self.mu**3 == log(self.n / self.n_0)


def run() -> object:
    return simulate(Cell(), 2.0)
