"""A variable that is called otherwise is asked for."""

from __future__ import annotations

from arthur_acausal import Component, Equations, ResultError, connect, simulate, start
from tests.circuit import Capacitor, Ground

ERROR = ResultError
EXPECT = [r"no variable 'capaciter\.v'", r"did you mean .*capacitor\.v"]


class Circuit(Component):
    capacitor = Capacitor(v=start(1.0, fixed=True))
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.capacitor.n, self.ground.p)


def run() -> object:
    return simulate(Circuit(), 1.0)["capaciter.v"]
