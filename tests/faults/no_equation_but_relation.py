"""A relation is yielded for an equation."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, Equations, Real, der, parameter, translate, variable

ERROR = DeclarationError
EXPECT = [r"^Tank\b", r"is no equation", r"lhs == rhs"]


class Tank(Component):
    x: Real = variable("m", start=1.0, fixed=True)
    v: Real = parameter("m/s", default=1.0)

    def equations(self) -> Equations:
        yield der(self.x) <= -self.v  # culprit


def run() -> object:
    return translate(Tank())
