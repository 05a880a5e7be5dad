"""A force that equals a mass times a speed."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, UnitError, der, parameter, translate, variable

ERROR = UnitError
EXPECT = [
    r"^Mass \"Newton\'s second law\"",
    r"left side is kg m s\^-1\b",
    r"right side is kg m s\^-2 \(force, N\)",
    r"remedy",
]


class Mass(Component):
    m: Real = parameter("kg", default=1.0)
    s: Real = variable("m", start=0.0, fixed=True)
    v: Real = variable("m/s")
    f: Real = variable("N")

    def equations(self) -> Equations:
        yield der(self.s) == self.v
        yield "Newton's second law", self.m * self.v == self.f  # culprit
        yield self.f == 0


def run() -> object:
    return translate(Mass())
