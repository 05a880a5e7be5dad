"""The class is given where an instance is needed."""

from __future__ import annotations

from arthur_acausal import DeclarationError, translate
from tests.errors.decay import Decay

ERROR = DeclarationError
EXPECT = [r"Decay is a class", r"give an instance: Decay\(\)"]


def run() -> object:
    return translate(Decay)  # type: ignore[arg-type]
