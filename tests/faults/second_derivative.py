"""A second derivative without a variable for the first."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, Equations, Real, der, parameter, translate, variable

ERROR = DeclarationError
EXPECT = [r"^Tank\b", r"second derivative of x", r"der\(v\)"]


class Tank(Component):
    x: Real = variable("m", start=1.0, fixed=True)
    v: Real = parameter("m/s", default=1.0)

    def equations(self) -> Equations:
        yield der(der(self.x)) == 0  # culprit


def run() -> object:
    return translate(Tank())
