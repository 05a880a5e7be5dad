"""A Python `and` between relations."""

from __future__ import annotations

from arthur_acausal import (
    Component,
    DeclarationError,
    Equations,
    Real,
    der,
    if_else,
    parameter,
    translate,
    variable,
)

ERROR = DeclarationError
EXPECT = [r"^Tank\b", r"`and`", r"logic_and"]


class Tank(Component):
    x: Real = variable("m", start=1.0, fixed=True)
    v: Real = parameter("m/s", default=1.0)

    def equations(self) -> Equations:
        yield der(self.x) == if_else(self.x > 0 and self.v > 0, -self.v, 0)  # culprit


def run() -> object:
    return translate(Tank())
