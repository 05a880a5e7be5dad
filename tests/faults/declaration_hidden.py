"""A subclass hides a parameter by a plain number."""

from __future__ import annotations

from arthur_acausal import DeclarationError, translate
from tests.circuit import Resistor

ERROR = DeclarationError
EXPECT = [r"Fixed\.R hides a declared quantity", r"parameter\(\"ohm\", default=3.0\)|remedy"]


def run() -> object:
    class Fixed(Resistor):
        R = 3.0  # type: ignore[assignment]

    return translate(Fixed())
