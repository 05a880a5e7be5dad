"""A connection reaches past a part's own connectors."""

from __future__ import annotations

from arthur_acausal import Component, ConnectError, Equations, connect, translate
from tests.circuit import Ground, Resistor

ERROR = ConnectError
EXPECT = [
    r"pack\.cell\.p",
    r"neither a connector of this component nor of one of its parts",
    r"through the connectors",
]


class Pack(Component):
    cell = Resistor()


class Plant(Component):
    pack = Pack()
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.pack.cell.p, self.ground.p)  # culprit


def run() -> object:
    return translate(Plant())
