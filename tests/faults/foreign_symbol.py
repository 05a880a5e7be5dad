"""An equation uses a variable of a component that is no part."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, Equations, Real, der, translate, variable
from tests.circuit import Resistor

ERROR = DeclarationError
EXPECT = [
    r"^Tank\b",
    r"Resistor\.v has no symbol",
    r"foreign_symbol\.py:\d+ is not part of the model",
    r"remedy",
]

other = Resistor()


class Tank(Component):
    x: Real = variable("V", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) * 0 == other.v  # culprit


def run() -> object:
    return translate(Tank())
