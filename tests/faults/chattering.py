"""A relay that switches back as soon as it has switched."""

from __future__ import annotations

from arthur_acausal import (
    Component,
    Equations,
    Real,
    SimulationError,
    der,
    if_else,
    parameter,
    simulate,
    variable,
)

ERROR = SimulationError
EXPECT = [r"chattering at t = ", r"\bx\b", r"hysteresis"]


class Relay(Component):
    v: Real = parameter("m/s", default=1.0)
    x: Real = variable("m", start=0.5, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == if_else(self.x > 0, -self.v, self.v)


def run() -> object:
    return simulate(Relay(), 1.0)
