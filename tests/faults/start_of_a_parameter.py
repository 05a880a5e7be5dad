"""start() is given for a parameter."""

from __future__ import annotations

from arthur_acausal import Component, ParameterError, start, translate
from tests.circuit import Resistor

ERROR = ParameterError
EXPECT = [r"^load\.R\b", r"takes a value, not start", r"remedy"]


class Plant(Component):
    load = Resistor(R=start(1.0))  # culprit


def run() -> object:
    return translate(Plant())
