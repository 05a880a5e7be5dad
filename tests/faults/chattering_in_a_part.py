"""A relay without hysteresis, deep in a model: it is named by its path."""

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
EXPECT = [r"chattering at t = 0.25 s", r"left\.relay: 0 < x", r"hysteresis"]


class Relay(Component):
    v: Real = parameter("m/s", default=1.0)
    x: Real = variable("m", start=0.5, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == if_else(self.x > 0, -self.v, self.v)


class Side(Component):
    relay = Relay(v=2.0)


class Machine(Component):
    left = Side()


def run() -> object:
    return simulate(Machine(), 1.0)
