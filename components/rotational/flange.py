"""The connector of rotational mechanics."""

from __future__ import annotations

from casadi import SX

from arthur_acausal import Connector, Real, der, flow, potential


class Flange(Connector):
    """The end of a shaft.

    ``phi`` [rad]: its angle. ``tau`` [N m]: the torque that acts on the component at this flange, positive
    in the direction of positive ``phi``.
    """

    phi: Real = potential("rad")
    tau: Real = flow("N*m")

    def power(self) -> SX:
        """Return the torque times the speed [W]."""
        return self.tau * der(self.phi)
