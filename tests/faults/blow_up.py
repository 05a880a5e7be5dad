"""A solution that ends at t = 1 s: x' = x^2."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, SimulationError, der, parameter, simulate, variable

ERROR = SimulationError
EXPECT = [r"failed at t = (0\.99|1)", r"\bx\b", r"remedy"]


class Growth(Component):
    k: Real = parameter("1/(m*s)", default=1.0)
    x: Real = variable("m", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield "growth", der(self.x) == self.k * self.x**2


def run() -> object:
    return simulate(Growth(), 2.0)
