"""A number is given for a part."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, translate
from tests.circuit import Resistor, TwoPin

ERROR = DeclarationError
EXPECT = [r"Plant\.load must be a component", r"not 3.0", r"remedy"]


class Plant(Component):
    load: TwoPin = Resistor()


def run() -> object:
    return translate(Plant(load=3.0))  # type: ignore[arg-type]  # culprit
