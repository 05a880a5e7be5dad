"""Springs and dampers between two points, and given forces."""

from __future__ import annotations

from casadi import sqrt

from arthur_acausal import Component, Equations, Real, der, parameter, real_input, variable
from arthur_acausal.components.planar.frame import Frame


class LineForce(Component):
    """What elements share that pull or push along the line between the origins of two frames.

    ``s`` [m]: their distance, which must not become zero. ``f`` [N]: the force, positive where it pulls them
    together.
    """

    frame_a = Frame()
    frame_b = Frame()
    s: Real = variable("m", start=1.0, description="distance from frame_a to frame_b")
    v: Real = variable("m/s", description="rate of s")
    f: Real = variable("N", description="force, positive in tension")

    def equations(self) -> Equations:
        a, b = self.frame_a, self.frame_b
        d_x, d_y = b.x - a.x, b.y - a.y
        yield self.s == sqrt(d_x**2 + d_y**2)
        yield self.v == (d_x * der(d_x) + d_y * der(d_y)) / self.s
        yield b.fx == self.f * d_x / self.s
        yield b.fy == self.f * d_y / self.s
        yield a.fx + b.fx == 0
        yield a.fy + b.fy == 0
        yield a.tau == 0
        yield b.tau == 0


class Spring(LineForce):
    """A linear spring: f = c (s - s_0). ``c`` [N/m], ``s_0`` [m] unstretched length."""

    c: Real = parameter("N/m", min=0.0)
    s_0: Real = parameter("m", default=0.0)
    E_elastic: Real = variable("J", description="elastic energy")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "Hooke's law", self.f == self.c * (self.s - self.s_0)
        yield self.E_elastic == self.c * (self.s - self.s_0) ** 2 / 2


class Damper(LineForce):
    """A linear damper: f = d v. ``d`` [N s/m]."""

    d: Real = parameter("N*s/m", min=0.0)
    P_loss: Real = variable("W", description="power turned to heat")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "linear damping", self.f == self.d * self.v
        yield self.P_loss == self.d * self.v**2


class SpringDamper(LineForce):
    """A spring and a damper side by side: f = c (s - s_0) + d v."""

    c: Real = parameter("N/m", min=0.0)
    d: Real = parameter("N*s/m", min=0.0)
    s_0: Real = parameter("m", default=0.0)
    E_elastic: Real = variable("J", description="elastic energy")
    P_loss: Real = variable("W", description="power turned to heat")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "spring and damper", self.f == self.c * (self.s - self.s_0) + self.d * self.v
        yield self.E_elastic == self.c * (self.s - self.s_0) ** 2 / 2
        yield self.P_loss == self.d * self.v**2


class WorldForce(Component):
    """A given force ``f_x``, ``f_y`` [N] in world directions and torque ``tau`` [N m] on what is connected."""

    frame = Frame()
    f_x: Real = real_input("N", default=0.0)
    f_y: Real = real_input("N", default=0.0)
    tau: Real = real_input("N*m", default=0.0)

    def equations(self) -> Equations:
        yield self.frame.fx == -self.f_x
        yield self.frame.fy == -self.f_y
        yield self.frame.tau == -self.tau
