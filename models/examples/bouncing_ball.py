"""A ball that bounces ever faster: state events and reinit."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, der, discrete, parameter, pre, reinit, variable, when


class BouncingBall(Component):
    """A ball falls from ``h_0`` [m] and loses a part of its speed at each bounce.

    States: ``h`` [m], ``v`` [m/s]. ``e`` [1]: coefficient of restitution. The bounces follow at intervals of
    2 e^k sqrt(2 h_0/g), so they pile up at t = sqrt(2 h_0/g) (1 + e)/(1 - e): stop before that.
    """

    g: Real = parameter("m/s^2", default=9.81)
    e: Real = parameter("1", default=0.7, min=0.0, max=1.0)
    h_0: Real = parameter("m", default=1.0)
    h: Real = variable("m", start=lambda self: self.h_0, fixed=True)
    v: Real = variable("m/s", start=0.0, fixed=True)
    bounces: Real = discrete("1")

    def equations(self) -> Equations:
        yield der(self.h) == self.v
        yield der(self.v) == -self.g
        yield when(self.h < 0, reinit(self.v, -self.e * pre(self.v)), self.bounces == pre(self.bounces) + 1)
