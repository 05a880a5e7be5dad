"""A when on an expression that is no relation."""

from __future__ import annotations

from arthur_acausal import (
    Component,
    DeclarationError,
    Equations,
    Real,
    der,
    parameter,
    reinit,
    translate,
    variable,
    when,
)

ERROR = DeclarationError
EXPECT = [r"^Tank\b", r"no condition", r"<, <=, >, >="]


class Tank(Component):
    x: Real = variable("m", start=1.0, fixed=True)
    v: Real = parameter("m/s", default=1.0)

    def equations(self) -> Equations:
        yield der(self.x) == -self.v
        yield when(self.x + 1, reinit(self.x, 1))  # culprit


def run() -> object:
    return translate(Tank())
