"""Two short circuits side by side: the current through each is not determined."""

from __future__ import annotations

from arthur_acausal import Component, Equations, StructureError, connect, translate
from tests.circuit import Ground, Resistor, TwoPin, Voltage

ERROR = StructureError
EXPECT = [r"second", r"not determined: .*first\.i, second\.i", r"remove"]


class Wire(TwoPin):
    def equations(self) -> Equations:
        yield from super().equations()
        yield "no resistance", self.p.v == self.n.v


class Loop(Component):
    source = Voltage(V=1.0)
    first = Wire()
    second = Wire()
    load = Resistor()
    ground = Ground()

    def equations(self) -> Equations:
        for wire in (self.first, self.second):
            yield connect(self.source.p, wire.p)
            yield connect(wire.n, self.load.p)
        yield connect(self.load.n, self.source.n)
        yield connect(self.ground.p, self.source.n)


def run() -> object:
    return translate(Loop())
