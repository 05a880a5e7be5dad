"""A part's resistance is given by an expression in farad."""

from __future__ import annotations

from arthur_acausal import Component, Real, UnitError, parameter, translate
from tests.circuit import Resistor

ERROR = UnitError
EXPECT = [r"^resistor\.R\b", r"capacitance", r"resistance", r"remedy"]


class Circuit(Component):
    C: Real = parameter("F", default=1.0)

    def build(self) -> None:
        self.resistor = Resistor(R=2 * self.C)  # culprit


def run() -> object:
    return translate(Circuit())
