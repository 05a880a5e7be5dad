"""The connector of planar mechanics, and the gravity that acts in the plane."""

from __future__ import annotations

from casadi import SX

from arthur_acausal import Connector, Real, Record, der, flow, parameter, potential


class Frame(Connector):
    """A frame fixed on a rigid body that moves in the x-y plane.

    ``x``, ``y`` [m]: its origin in the world. ``phi`` [rad]: its angle, counterclockwise. ``fx``, ``fy`` [N]: the
    force, in world directions, and ``tau`` [N m] the torque that act on the component at this frame.
    """

    x: Real = potential("m")
    y: Real = potential("m")
    phi: Real = potential("rad")
    fx: Real = flow("N")
    fy: Real = flow("N")
    tau: Real = flow("N*m")

    def power(self) -> SX:
        """Return the power of the force and of the torque [W]."""
        return self.fx * der(self.x) + self.fy * der(self.y) + self.tau * der(self.phi)


class Gravity(Record):
    """The field of gravity in the plane; in ``build`` give one to all bodies: ``Body(gravity=self.gravity)``."""

    g_x: Real = parameter("m/s^2", default=0.0)
    g_y: Real = parameter("m/s^2", default=-9.81)
