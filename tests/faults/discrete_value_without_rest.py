"""Two flags that contradict each other at every pass of an event."""

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
EXPECT = [r"chattering", r"t = 0.5"]


class Flags(Component):
    x: Real = variable("1", start=0.0, fixed=True)
    T: Real = parameter("s", default=1.0)
    y: Real = variable("1")

    def equations(self) -> Equations:
        yield self.T * der(self.x) == 1.0
        yield self.y == if_else(self.x + self.y > 0.5, -1.0, 0.0)


def run() -> object:
    return simulate(Flags(), 1.0)
