"""A keyword argument that the class does not know."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, translate
from tests.circuit import Resistor

ERROR = DeclarationError
EXPECT = [r"Resistor has no 'r'", r"did you mean R\?"]


def run() -> object:
    class Circuit(Component):
        load = Resistor(r=3.0)  # type: ignore[call-arg]  # culprit

    return translate(Circuit())
