"""A parameter declared in bar."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, Real, parameter, translate

ERROR = DeclarationError
EXPECT = [r"'bar'", r"not coherent SI", r"display='bar'"]


def run() -> object:
    class Vessel(Component):
        p: Real = parameter("bar", default=1.0)  # culprit

    return translate(Vessel())
