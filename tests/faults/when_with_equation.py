"""An equation for a continuous variable inside when."""

from __future__ import annotations

from arthur_acausal import (
    Component,
    DeclarationError,
    Equations,
    Real,
    der,
    parameter,
    translate,
    variable,
    when,
)

ERROR = DeclarationError
EXPECT = [r"^Tank\b", r"inside when\(\)", r"discrete"]


class Tank(Component):
    x: Real = variable("m", start=1.0, fixed=True)
    v: Real = parameter("m/s", default=1.0)

    def equations(self) -> Equations:
        yield der(self.x) == -self.v
        yield when(self.x < 0, self.x == 1)  # culprit


def run() -> object:
    return translate(Tank())
