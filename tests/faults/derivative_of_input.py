"""A constraint fixes a state to an input, which cannot be differentiated."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, StructureError, der, real_input, translate, variable

ERROR = StructureError
EXPECT = [r"der\(s\) == v", r"derivative_of_input\.py:\d+", r"external input", r"\bu\b", r"filter"]


class Rail(Component):
    u: Real = real_input("m", default=0.0)
    s: Real = variable("m")
    v: Real = variable("m/s")
    a: Real = variable("m/s^2")

    def equations(self) -> Equations:
        yield "rail", self.s == self.u
        yield der(self.s) == self.v  # culprit
        yield der(self.v) == self.a


def run() -> object:
    return translate(Rail())
