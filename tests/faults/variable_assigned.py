"""A variable is assigned as if it were a Python attribute."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, Equations, Real, der, parameter, translate, variable

ERROR = DeclarationError
EXPECT = [r"^Tank\b", r"x cannot be assigned", r"yield x == "]


class Tank(Component):
    x: Real = variable("m", start=1.0, fixed=True)
    v: Real = parameter("m/s", default=1.0)

    def equations(self) -> Equations:
        self.x = self.v  # culprit
        yield der(self.x) == -self.v


def run() -> object:
    return translate(Tank())
