"""A pin meets a port of another kind."""

from __future__ import annotations

from arthur_acausal import (
    Component,
    ConnectError,
    Connector,
    Equations,
    Real,
    connect,
    flow,
    potential,
    translate,
)
from tests.circuit import Resistor

ERROR = ConnectError
EXPECT = [
    r"\bresistor\.p\b",
    r"\bwall\.port\b",
    r"Pin: v \[V\], i \[A\]",
    r"HeatPort: T \[K\]",
    r"same potentials and flows",
]


class HeatPort(Connector):
    T: Real = potential("K")
    Q_flow: Real = flow("W")


class Wall(Component):
    port = HeatPort()

    def equations(self) -> Equations:
        yield self.port.T == self.port.T * 0


class Mixed(Component):
    resistor = Resistor()
    wall = Wall()

    def equations(self) -> Equations:
        yield connect(self.resistor.p, self.wall.port)  # culprit


def run() -> object:
    return translate(Mixed())
