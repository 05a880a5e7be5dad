"""A resistor without its law."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, StructureError, parameter, translate, variable
from tests.circuit import Pin

ERROR = StructureError
EXPECT = [
    r"\bLeak\b",
    r"does not balance by itself: 4 equations for 5 unknowns",
    r"not determined: v\b",
    r"add an equation",
]


class Leak(Component):
    p = Pin()
    n = Pin()
    R: Real = parameter("ohm", default=1.0)
    v: Real = variable("V")

    def equations(self) -> Equations:  # culprit
        yield self.p.i + self.n.i == 0
        yield self.p.v == self.R * self.p.i + self.n.v


def run() -> object:
    return translate(Leak())
