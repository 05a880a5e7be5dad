"""A fixed start value of a current that is always zero."""

from __future__ import annotations

from arthur_acausal import Component, Equations, InitializationError, connect, start, translate
from tests.circuit import Capacitor, Ground, Inductor

ERROR = InitializationError
EXPECT = [r"^coil\.i\b", r"always zero", r"remove fixed=True"]


class Plant(Component):
    coil = Inductor(i=start(1.0, fixed=True))
    store = Capacitor(v=start(0.0, fixed=True))
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.coil.n, self.ground.p)
        yield connect(self.store.n, self.ground.p)


def run() -> object:
    return translate(Plant())
