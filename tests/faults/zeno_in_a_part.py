"""A ball that bounces ever faster, as a part: the message names it by its path."""

from __future__ import annotations

from arthur_acausal import (
    Component,
    Equations,
    Real,
    SimulationError,
    der,
    parameter,
    pre,
    reinit,
    simulate,
    variable,
    when,
)

ERROR = SimulationError
EXPECT = [r"Zeno", r"\bleft\b.*h < 0", r"terminate"]


class Ball(Component):
    g: Real = parameter("m/s^2", default=9.81)
    e: Real = parameter("1", default=0.5)
    h: Real = variable("m", start=1.0, fixed=True)
    v: Real = variable("m/s", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield self.v == der(self.h)
        yield der(self.v) == -self.g
        yield when(self.h < 0, reinit(self.v, -self.e * pre(self.v)))


class Court(Component):
    left = Ball()


def run() -> object:
    return simulate(Court(), 3.0)
