"""Sources of rotational mechanics."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, der, real_input, variable
from arthur_acausal.components.rotational.flange import Flange


class TorqueSource(Component):
    """An external torque ``tau`` [N m] that turns the connected component towards positive phi."""

    flange = Flange()
    tau: Real = real_input("N*m", default=0.0)

    def equations(self) -> Equations:
        yield self.flange.tau == -self.tau


class SpeedSource(Component):
    """Turns its flange with the speed ``w`` [rad/s]. State: ``phi`` [rad].

    ``P`` [W]: the power that it gives to the connected component.
    """

    flange = Flange()
    w: Real = real_input("rad/s", default=0.0)
    phi: Real = variable("rad", start=0.0, fixed=True, state_select="prefer")
    P: Real = variable("W", description="power given to the shaft")

    def equations(self) -> Equations:
        yield self.flange.phi == self.phi
        yield der(self.phi) == self.w
        yield self.P == -self.flange.tau * self.w
