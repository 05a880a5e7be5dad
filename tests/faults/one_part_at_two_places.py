"""The same resistor object stands in a list twice."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, translate
from tests.circuit import Resistor

ERROR = DeclarationError
EXPECT = [r"Resistor is used at two places", r"cells\[0\]", r"cells\[1\]", r"one component for each place"]


class Chain(Component):
    def build(self) -> None:
        self.cells = [Resistor()] * 2  # culprit


def run() -> object:
    return translate(Chain())
