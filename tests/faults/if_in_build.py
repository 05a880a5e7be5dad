"""A Python `if` on a parameter while parts are made."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, Real, parameter, translate
from tests.circuit import Resistor

ERROR = DeclarationError
EXPECT = [r"^plant\b", r"Python `if`", r"structural"]


class Plant(Component):
    R: Real = parameter("ohm", default=1.0)

    def build(self) -> None:
        if self.R > 0:  # culprit
            self.load = Resistor(R=self.R)


class Site(Component):
    plant = Plant()


def run() -> object:
    return translate(Site())
