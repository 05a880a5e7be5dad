"""A sound model that the faults misuse."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, der, parameter, real_input, variable


class Decay(Component):
    """T x' = u - x: a tank that empties."""

    T: Real = parameter("s", default=1.0, min=0.0, description="time constant, positive")
    u: Real = real_input("m", default=0.0)
    x: Real = variable("m", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield "balance", self.T * der(self.x) == self.u - self.x
