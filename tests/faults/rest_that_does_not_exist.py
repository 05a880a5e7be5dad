"""An initial equation asks for a rest that a constant inflow forbids."""

from __future__ import annotations

from arthur_acausal import Component, Equations, InitializationError, Real, der, parameter, simulate, variable

ERROR = InitializationError
EXPECT = [
    r"contradict each other",
    r'"at rest" \(rest_that_does_not_exist\.py:\d+\); "inflow" \(rest_that_does_not_exist\.py:\d+\)\n',
    r"remedy",
]


class Filling(Component):
    q: Real = parameter("m^3/s", default=1.0)
    V: Real = variable("m^3", start=0.0)

    def equations(self) -> Equations:
        yield "inflow", der(self.V) == self.q

    def initial_equations(self) -> Equations:
        yield "at rest", der(self.V) == 0  # culprit


def run() -> object:
    return simulate(Filling(), 1.0)
