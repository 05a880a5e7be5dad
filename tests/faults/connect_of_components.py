"""Components are connected in place of their connectors."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, Equations, connect, translate
from tests.circuit import Ground, Resistor

ERROR = DeclarationError
EXPECT = [r"^Plant\b", r"connect\(\) takes connectors or signals", r"load", r"its connectors are p, n|p, n"]


class Plant(Component):
    load = Resistor()
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.load, self.ground)  # culprit


def run() -> object:
    return translate(Plant())
