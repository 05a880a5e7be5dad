"""A law without a root: neither Newton's method nor the homotopy gets there."""

from __future__ import annotations

from arthur_acausal import (
    Component,
    Equations,
    InitializationError,
    Real,
    der,
    homotopy,
    parameter,
    simulate,
    variable,
)

ERROR = InitializationError
EXPECT = [r'"no root" \(homotopy_without_end\.py:\d+\)', r"homotopy: stopped at 0\.333 of the way", r"remedy"]


class NoRoot(Component):
    k: Real = parameter("1/s", default=1.0)
    x: Real = variable("1", start=1.0)
    s: Real = variable("1", start=0.5, fixed=True)

    def equations(self) -> Equations:
        yield "no root", homotopy(self.x**2 + 1, self.x) == 0  # culprit
        yield der(self.s) == self.k * (self.x - self.s)


def run() -> object:
    return simulate(NoRoot(), 1.0)
