"""A capacitance is given for a resistance, as a pint quantity."""

from __future__ import annotations

import pint

from arthur_acausal import Component, UnitError, translate
from tests.circuit import Resistor

ERROR = UnitError
EXPECT = [r"^resistor\.R\b", r"5 microfarad", r"capacitance", r"resistance", r"give a value in ohm"]


class Circuit(Component):
    resistor = Resistor(R=pint.Quantity(5, "microfarad"))  # culprit


def run() -> object:
    return translate(Circuit())
