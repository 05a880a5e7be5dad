"""A coefficient that was solved for becomes zero."""

from __future__ import annotations

from arthur_acausal import Component, Equations, ParameterError, Real, der, parameter, simulate, variable

ERROR = ParameterError
EXPECT = [r"\"lever\"", r"parameter_makes_singular\.py:\d+", r"coefficient is 0", r"\bf\b", r"remedy"]


class Lever(Component):
    a: Real = parameter("m", default=1.0)
    x: Real = variable("N", start=1.0, fixed=True)
    f: Real = variable("N")
    M: Real = variable("N*m")

    def equations(self) -> Equations:
        yield self.M == self.a * self.x
        yield "lever", self.a * self.f + self.M == 0  # culprit
        yield self.a * der(self.x) == 0


def run() -> object:
    return simulate(Lever(), 1.0, parameters={"a": 0.0})
