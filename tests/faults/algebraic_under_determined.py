"""An algebraic unknown stands in no equation, another one in two."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, StructureError, translate, variable

ERROR = StructureError
EXPECT = [
    r"not determined: y\b",
    r"\"first\" \(algebraic_under_determined\.py:\d+\)",
    r"\"second\"",
    r"remedy",
]


class Curve(Component):
    x: Real = variable("1", start=1.0)
    y: Real = variable("1", start=1.0)

    def equations(self) -> Equations:
        yield "first", self.x**2 == 2
        yield "second", self.x**3 == 3


def run() -> object:
    return translate(Curve())
