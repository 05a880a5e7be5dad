"""A circuit whose own variable nobody determines."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, StructureError, connect, translate, variable
from tests.circuit import Ground, Resistor, Voltage

ERROR = StructureError
EXPECT = [r"\bCircuit\b", r"not determined: power\b", r"add an equation"]


class Circuit(Component):
    source = Voltage()
    load = Resistor()
    ground = Ground()
    power: Real = variable("W")

    def equations(self) -> Equations:  # culprit
        yield connect(self.source.p, self.load.p)
        yield connect(self.source.n, self.load.n)
        yield connect(self.source.n, self.ground.p)


def run() -> object:
    return translate(Circuit())
