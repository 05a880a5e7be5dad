"""A negative resistance in the model itself."""

from __future__ import annotations

from arthur_acausal import Component, ParameterError, translate
from tests.circuit import Resistor

ERROR = ParameterError
EXPECT = [r"^load\.R\b", r"-3 ohm", r"outside of \[0, inf\]", r"remedy"]


class Circuit(Component):
    load = Resistor(R=-3.0)  # culprit


def run() -> object:
    return translate(Circuit())
