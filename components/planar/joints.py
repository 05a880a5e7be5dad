"""Joints of one degree of freedom, free or driven by a one-dimensional flange."""

from __future__ import annotations

from casadi import SX, cos, sin

from arthur_acausal import Component, Equations, Real, der, parameter, variable
from arthur_acausal.components.planar.frame import Frame
from arthur_acausal.components.rotational.flange import Flange as TurningFlange
from arthur_acausal.components.translational.flange import Flange as SlidingFlange


class Revolute(Component):
    """A pin: frame_b turns against frame_a by ``phi`` [rad]; no friction.

    ``use_flange``: the flange ``flange`` (rotational) turns with the joint; its torque turns frame_b against
    frame_a. ``phi``, ``w`` [rad/s] are preferred as states.
    """

    use_flange: bool = False
    frame_a = Frame()
    frame_b = Frame()
    phi: Real = variable("rad", start=0.0, state_select="prefer", description="angle of frame_b over frame_a")
    w: Real = variable("rad/s", start=0.0, state_select="prefer", description="its speed")
    a: Real = variable("rad/s^2", description="its acceleration")

    def build(self) -> None:
        if self.use_flange:
            self.flange = TurningFlange()

    def equations(self) -> Equations:
        a, b = self.frame_a, self.frame_b
        yield a.x == b.x
        yield a.y == b.y
        yield self.phi == b.phi - a.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield a.fx + b.fx == 0
        yield a.fy + b.fy == 0
        yield a.tau + b.tau == 0
        if self.use_flange:
            yield self.flange.phi == self.phi
        yield b.tau == (-self.flange.tau if self.use_flange else SX(0.0))


class LoopRevolute(Revolute):
    """A pin in a kinematic loop whose angle follows from other joints: it is not preferred as a state.

    Take it for all pins of a loop but the one that drives. Start values of the bodies' angles say which way the loop
    is assembled.
    """

    phi: Real = variable("rad", start=0.0, description="angle of frame_b over frame_a")
    w: Real = variable("rad/s", start=0.0, description="its speed")


class Prismatic(Component):
    """A slide: frame_b moves from frame_a by ``s`` [m] along the axis at ``alpha`` [rad] in frame_a; no friction.

    ``use_flange``: the flange ``flange`` (translational) moves with the joint; its force pushes frame_b away from
    frame_a along the axis. ``s``, ``v`` [m/s] are preferred as states.
    """

    use_flange: bool = False
    frame_a = Frame()
    frame_b = Frame()
    alpha: Real = parameter(
        "rad", default=0.0, description="direction of the axis in frame_a; 0: along its x"
    )
    s: Real = variable("m", start=0.0, state_select="prefer", description="distance along the axis")
    v: Real = variable("m/s", start=0.0, state_select="prefer", description="its speed")
    a: Real = variable("m/s^2", description="its acceleration")

    def build(self) -> None:
        if self.use_flange:
            self.flange = SlidingFlange()

    def equations(self) -> Equations:
        a, b = self.frame_a, self.frame_b
        e_x, e_y = cos(a.phi + self.alpha), sin(a.phi + self.alpha)
        yield b.x == a.x + e_x * self.s
        yield b.y == a.y + e_y * self.s
        yield b.phi == a.phi
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield "force balance, x", a.fx + b.fx == 0
        yield "force balance, y", a.fy + b.fy == 0
        yield "torque balance about frame_a", a.tau + b.tau + self.s * (e_x * b.fy - e_y * b.fx) == 0
        if self.use_flange:
            yield self.flange.s == self.s
        yield "along the axis", e_x * b.fx + e_y * b.fy == (-self.flange.f if self.use_flange else SX(0.0))


class LoopPrismatic(Prismatic):
    """A slide in a kinematic loop whose position follows from other joints: it is not preferred as a state."""

    s: Real = variable("m", start=0.0, description="distance along the axis")
    v: Real = variable("m/s", start=0.0, description="its speed")
