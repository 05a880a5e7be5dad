"""Two capacitors side by side that begin at different voltages."""

from __future__ import annotations

from arthur_acausal import Component, Equations, InitializationError, connect, simulate, start
from tests.circuit import Capacitor, Ground

ERROR = InitializationError
EXPECT = [r"contradict each other", r"fixed start of first\.v", r"fixed start of second\.v", r"remedy"]


class Circuit(Component):
    first = Capacitor(v=start(1.0, fixed=True))
    second = Capacitor(v=start(2.0, fixed=True))
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.first.p, self.second.p)
        yield connect(self.first.n, self.second.n)
        yield connect(self.first.n, self.ground.p)


def run() -> object:
    return simulate(Circuit(), 1.0)
