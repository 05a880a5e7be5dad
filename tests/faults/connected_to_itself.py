"""A connector is connected to itself."""

from __future__ import annotations

from arthur_acausal import Component, ConnectError, Equations, connect, translate
from tests.circuit import Resistor

ERROR = ConnectError
EXPECT = [r"load\.p is connected to itself", r"remedy"]


class Plant(Component):
    load = Resistor()

    def equations(self) -> Equations:
        yield connect(self.load.p, self.load.p)  # culprit


def run() -> object:
    return translate(Plant())
