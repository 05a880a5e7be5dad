"""A part is given that the class does not let its callers choose."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, translate
from tests.circuit import Capacitor, Resistor

ERROR = DeclarationError
EXPECT = [r"Plant\.load is a fixed part", r"annotate it: load:"]


class Plant(Component):
    load = Resistor()


def run() -> object:
    return translate(Plant(load=Capacitor()))  # pyright: ignore[reportCallIssue]  # culprit
