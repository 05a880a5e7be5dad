"""An event changes a variable that is no state."""

from __future__ import annotations

from arthur_acausal import (
    Component,
    Equations,
    Real,
    StructureError,
    der,
    parameter,
    reinit,
    translate,
    variable,
    when,
)

ERROR = StructureError
EXPECT = [r"reinit\(y\)", r"no state", r"reinit_of_algebraic\.py:\d+", r"remedy"]


class Tank(Component):
    v: Real = parameter("m/s", default=1.0)
    x: Real = variable("m", start=1.0, fixed=True)
    y: Real = variable("m")

    def equations(self) -> Equations:
        yield der(self.x) == -self.v
        yield self.y == 2 * self.x
        yield when(self.x < 0, reinit(self.y, 2 * self.y))  # culprit


def run() -> object:
    return translate(Tank())
