"""A Python `if` on a variable."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, Equations, Real, der, parameter, translate, variable

ERROR = DeclarationError
EXPECT = [r"^Tank\b", r"Python `if`", r"if_else\("]


class Tank(Component):
    x: Real = variable("m", start=1.0, fixed=True)
    v: Real = parameter("m/s", default=1.0)

    def equations(self) -> Equations:
        if self.x > 0:  # culprit
            yield der(self.x) == -self.v
        else:
            yield der(self.x) == 0


def run() -> object:
    return translate(Tank())
