"""A circuit that says what its parts say already."""

from __future__ import annotations

from arthur_acausal import Component, Equations, StructureError, connect, translate
from tests.circuit import Ground, Resistor, Voltage

ERROR = StructureError
EXPECT = [r"\bCircuit\b", r"1 equation too many", r"surplus: .*balance of currents", r"remove"]


class Circuit(Component):
    source = Voltage()
    load = Resistor()
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.load.p)
        yield connect(self.source.n, self.load.n)
        yield connect(self.source.n, self.ground.p)
        yield "balance of currents", self.source.i == -self.load.i  # culprit


def run() -> object:
    return translate(Circuit())
