"""A chain that is not told its length."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, translate
from tests.circuit import Resistor

ERROR = DeclarationError
EXPECT = [r"^line\b", r"Chain needs n\b", r"Chain\(n=\.\.\.\)"]


class Chain(Component):
    n: int

    def build(self) -> None:
        self.cells = [Resistor() for _ in range(self.n)]


class Plant(Component):
    line = Chain()  # type: ignore[call-arg]  # culprit


def run() -> object:
    return translate(Plant())
