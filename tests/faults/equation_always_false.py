"""An equation between two numbers."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, Equations, Real, der, parameter, translate, variable

ERROR = DeclarationError
EXPECT = [r"^Tank \"numbers\"|^Tank\b", r"always false", r"remedy"]


class Tank(Component):
    x: Real = variable("m", start=1.0, fixed=True)
    v: Real = parameter("m/s", default=1.0)

    def equations(self) -> Equations:
        yield der(self.x) == -self.v
        yield "numbers", 1.0 == 2.0  # culprit


def run() -> object:
    return translate(Tank())
