"""A parameter that follows from a variable."""

from __future__ import annotations

from arthur_acausal import Component, Equations, ParameterError, Real, der, parameter, translate, variable

ERROR = ParameterError
EXPECT = [r"^rate\b", r"\bx\b", r"no parameter", r"remedy"]


class Tank(Component):
    T: Real = parameter("s", default=1.0)
    x: Real = variable("m", start=1.0, fixed=True)
    rate: Real = parameter("m/s", default=lambda self: self.x / self.T)

    def equations(self) -> Equations:
        yield der(self.x) == -self.rate


def run() -> object:
    return translate(Tank())
