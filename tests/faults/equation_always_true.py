"""Both sides of an equation are the same."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, Equations, Real, der, parameter, translate, variable

ERROR = DeclarationError
EXPECT = [r"^Tank\b", r"always true", r"both sides"]


class Tank(Component):
    x: Real = variable("m", start=1.0, fixed=True)
    v: Real = parameter("m/s", default=1.0)

    def equations(self) -> Equations:
        yield der(self.x) == -self.v
        yield self.x == self.x  # culprit


def run() -> object:
    return translate(Tank())
