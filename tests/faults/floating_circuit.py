"""A circuit without ground: its potentials are not determined."""

from __future__ import annotations

from arthur_acausal import Component, Equations, StructureError, connect, simulate
from tests.circuit import Resistor, Voltage

ERROR = StructureError
EXPECT = [r"singular|not determined", r"(source|load)\.[pn]\.v\b", r"remedy"]


class Floating(Component):
    source = Voltage(V=1.0)
    load = Resistor()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.load.p)
        yield connect(self.source.n, self.load.n)


def run() -> object:
    return simulate(Floating(), 1.0)
