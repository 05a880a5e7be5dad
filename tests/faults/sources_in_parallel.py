"""Two ideal voltage sources side by side: each class is right, the circuit is not."""

from __future__ import annotations

from arthur_acausal import Component, Equations, StructureError, connect, translate
from tests.circuit import Ground, Resistor, Voltage

ERROR = StructureError
EXPECT = [r"first \"source voltage\"", r"second \"source voltage\"", r"(first|second)\.\S*i\b", r"remove"]


class Parallel(Component):
    first = Voltage(V=1.0)
    second = Voltage(V=1.0)
    load = Resistor()
    ground = Ground()

    def equations(self) -> Equations:
        for part in (self.second, self.load):
            yield connect(self.first.p, part.p)
            yield connect(self.first.n, part.n)
        yield connect(self.ground.p, self.first.n)


def run() -> object:
    return translate(Parallel())
