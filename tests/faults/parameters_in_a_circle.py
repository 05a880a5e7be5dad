"""Two parameters that follow from each other."""

from __future__ import annotations

from arthur_acausal import Component, ParameterError, Real, parameter, translate

ERROR = ParameterError
EXPECT = [r"depend on each other", r"radius", r"area", r"give one of them a value"]


class Pipe(Component):
    radius: Real = parameter("m", default=lambda self: self.area**0.5)
    area: Real = parameter("m^2", default=lambda self: self.radius**2)


def run() -> object:
    return translate(Pipe())
