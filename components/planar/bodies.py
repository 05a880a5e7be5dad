"""Bodies with mass, and where they stand."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, der, parameter, variable
from arthur_acausal.components.planar.frame import Frame, Gravity


class Fixed(Component):
    """A frame fixed in the world at ``x0``, ``y0`` [m] with the angle ``phi0`` [rad]."""

    frame = Frame()
    x0: Real = parameter("m", default=0.0)
    y0: Real = parameter("m", default=0.0)
    phi0: Real = parameter("rad", default=0.0)

    def equations(self) -> Equations:
        yield self.frame.x == self.x0
        yield self.frame.y == self.y0
        yield self.frame.phi == self.phi0


class Body(Component):
    """A rigid body with its frame at the centre of mass. Newton's and Euler's law in the plane.

    States, where no joint restrains them: ``x``, ``y`` [m], ``phi`` [rad], ``v_x``, ``v_y`` [m/s], ``w`` [rad/s].
    Parameters: ``m`` [kg], ``J`` [kg m^2] about the centre of mass. A height of 0 has no potential energy.
    """

    frame = Frame()
    gravity: Gravity = Gravity()
    m: Real = parameter("kg", min=0.0, description="mass")
    J: Real = parameter("kg*m^2", min=0.0, description="moment of inertia about the centre of mass")
    x: Real = variable("m", start=0.0)
    y: Real = variable("m", start=0.0)
    phi: Real = variable("rad", start=0.0)
    v_x: Real = variable("m/s", start=0.0)
    v_y: Real = variable("m/s", start=0.0)
    w: Real = variable("rad/s", start=0.0)
    E_kinetic: Real = variable("J", description="kinetic energy")
    E_potential: Real = variable("J", description="potential energy in the field of gravity")

    def equations(self) -> Equations:
        m, frame, gravity = self.m, self.frame, self.gravity
        yield self.x == frame.x
        yield self.y == frame.y
        yield self.phi == frame.phi
        yield self.v_x == der(self.x)
        yield self.v_y == der(self.y)
        yield self.w == der(self.phi)
        yield "Newton's law, x", m * der(self.v_x) == frame.fx + m * gravity.g_x
        yield "Newton's law, y", m * der(self.v_y) == frame.fy + m * gravity.g_y
        yield "Euler's law", self.J * der(self.w) == frame.tau
        yield self.E_kinetic == (m * (self.v_x**2 + self.v_y**2) + self.J * self.w**2) / 2
        yield self.E_potential == -m * (gravity.g_x * self.x + gravity.g_y * self.y)


class PointMass(Component):
    """A mass without moment of inertia; the frame turns with what it is attached to.

    ``alone``: nothing is attached that turns it (springs, forces): the frame then keeps the angle 0. States, where
    no joint restrains them: ``x``, ``y`` [m], ``v_x``, ``v_y`` [m/s].
    """

    alone: bool = False
    frame = Frame()
    gravity: Gravity = Gravity()
    m: Real = parameter("kg", min=0.0, description="mass")
    x: Real = variable("m", start=0.0)
    y: Real = variable("m", start=0.0)
    v_x: Real = variable("m/s", start=0.0)
    v_y: Real = variable("m/s", start=0.0)
    E_kinetic: Real = variable("J", description="kinetic energy")
    E_potential: Real = variable("J", description="potential energy in the field of gravity")

    def equations(self) -> Equations:
        m, frame, gravity = self.m, self.frame, self.gravity
        yield self.x == frame.x
        yield self.y == frame.y
        yield self.v_x == der(self.x)
        yield self.v_y == der(self.y)
        yield "Newton's law, x", m * der(self.v_x) == frame.fx + m * gravity.g_x
        yield "Newton's law, y", m * der(self.v_y) == frame.fy + m * gravity.g_y
        if self.alone:
            yield frame.phi == 0
        else:
            yield frame.tau == 0
        yield self.E_kinetic == m * (self.v_x**2 + self.v_y**2) / 2
        yield self.E_potential == -m * (gravity.g_x * self.x + gravity.g_y * self.y)
