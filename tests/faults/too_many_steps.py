"""An oscillation that is far faster than the steps allow."""

from __future__ import annotations

from arthur_acausal import (
    Component,
    Equations,
    Real,
    SimulationError,
    SolverOptions,
    der,
    parameter,
    simulate,
    variable,
)

ERROR = SimulationError
EXPECT = [r"more than 200 steps", r"\b(x|v)\b", r"max_steps"]


class Oscillator(Component):
    omega: Real = parameter("1/s", default=1e4)
    x: Real = variable("m", start=1.0, fixed=True)
    v: Real = variable("m/s", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.v
        yield der(self.v) == -(self.omega**2) * self.x


def run() -> object:
    return simulate(Oscillator(), 1.0, options=SolverOptions(max_steps=200))
