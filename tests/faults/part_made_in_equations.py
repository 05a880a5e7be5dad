"""A part is made while the equations are written."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, Equations, connect, translate
from tests.circuit import Ground, Resistor

ERROR = DeclarationError
EXPECT = [r"^Plant\b", r"\bload\b", r"in the class body or in build\(\)"]


class Plant(Component):
    ground = Ground()

    def equations(self) -> Equations:
        self.load = Resistor()  # culprit
        yield connect(self.load.p, self.ground.p)


def run() -> object:
    return translate(Plant())
