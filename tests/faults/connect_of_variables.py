"""Inner variables are connected."""

from __future__ import annotations

from arthur_acausal import Component, ConnectError, Equations, connect, translate
from tests.circuit import Resistor

ERROR = ConnectError
EXPECT = [r"load\.v\b", r"not both signals", r"write =="]


class Plant(Component):
    load = Resistor()
    other = Resistor()

    def equations(self) -> Equations:
        yield connect(self.load.v, self.other.v)  # culprit


def run() -> object:
    return translate(Plant())
