"""A resistor with one law too many."""

from __future__ import annotations

from arthur_acausal import Equations, StructureError, translate
from tests.circuit import Resistor

ERROR = StructureError
EXPECT = [
    r"\bTwice\b",
    r"does not balance by itself: 7 equations for 6 unknowns",
    r"1 equation too many",
    r"surplus: \"power\"",
    r"remove",
]


class Twice(Resistor):
    def equations(self) -> Equations:
        yield from super().equations()
        yield "power", self.v * self.i == self.R * self.i**2  # culprit


def run() -> object:
    return translate(Twice())
