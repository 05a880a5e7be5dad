"""A unit that does not exist."""

from __future__ import annotations

from arthur_acausal import Component, UnitError, translate
from tests.circuit import Resistor

ERROR = UnitError
EXPECT = [r"^resistor\.R\b", r"'ohmm'", r"did you mean ohm"]


class Circuit(Component):
    resistor = Resistor(R="3 ohmm")  # culprit


def run() -> object:
    return translate(Circuit())
