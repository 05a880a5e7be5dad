"""A default whose function names a parameter that does not exist."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, Real, parameter, translate

ERROR = DeclarationError
EXPECT = [r"^area\b", r"no attribute 'radios'|has no 'radios'", r"did you mean.* radius"]


class Pipe(Component):
    radius: Real = parameter("m", default=1.0)
    area: Real = parameter("m^2", default=lambda self: self.radios**2)  # culprit


def run() -> object:
    return translate(Pipe())
