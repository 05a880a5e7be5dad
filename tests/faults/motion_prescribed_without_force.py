"""A slider whose motion is prescribed, with no force that could bring it about."""

from __future__ import annotations

from arthur_acausal import (
    Component,
    Equations,
    Real,
    StructureError,
    der,
    parameter,
    time,
    translate,
    variable,
)

ERROR = StructureError
EXPECT = [r"singular", r"prescribed", r"which hold only s", r"not determined: F"]


class Slider(Component):
    m: Real = parameter("kg", default=1.0)
    a: Real = parameter("m/s^2", default=1.0)
    s: Real = variable("m")
    v: Real = variable("m/s")
    F: Real = variable("N")

    def equations(self) -> Equations:
        yield self.v == der(self.s)
        yield "prescribed", self.s == self.a * time() ** 2 / 2  # culprit
        yield "Newton's second law", self.m * der(self.v) == self.m * self.a  # culprit


def run() -> object:
    return translate(Slider())
