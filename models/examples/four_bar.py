"""A four-bar linkage: a kinematic loop in the plane."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, connect, parameter, start
from arthur_acausal.components.planar import Body, Fixed, FixedTranslation, Frame, LoopRevolute, Revolute


class Link(Component):
    """A uniform bar of length ``L`` [m] and mass ``m`` [kg] from frame_a to frame_b, along their x-axis.

    ``phi_0`` [rad]: about the angle at which it starts, so that a loop is assembled the right way.
    """

    frame_a = Frame()
    frame_b = Frame()
    L: Real = parameter("m", min=0.0)
    m: Real = parameter("kg", min=0.0)
    phi_0: Real = parameter("rad", default=0.0)
    half_a = FixedTranslation(r_x=lambda self: self.L / 2)
    half_b = FixedTranslation(r_x=lambda self: self.L / 2)
    body = Body(
        m=lambda self: self.m, J=lambda self: self.m * self.L**2 / 12, phi=start(lambda self: self.phi_0)
    )

    def equations(self) -> Equations:
        yield connect(self.frame_a, self.half_a.frame_a)
        yield connect(self.half_a.frame_b, self.body.frame)
        yield connect(self.half_a.frame_b, self.half_b.frame_a)
        yield connect(self.half_b.frame_b, self.frame_b)


class FourBar(Component):
    """A crank of 0.5 m turns and, by a coupler of 2 m, swings a rocker of 1.5 m; pivots are 2 m apart.

    ``crank_pin.phi``, ``crank_pin.w`` are the states; no friction: kinetic and potential energy add up to a constant.
    The shortest and the longest bar together are shorter than the others, so the crank goes round (Grashof).
    """

    w_0: Real = parameter("rad/s", default=8.0, description="speed of the crank at the start")
    left = Fixed()
    right = Fixed(x0=2.0)
    crank_pin: Revolute = Revolute(phi=start(0.0, fixed=True), w=start(lambda self: self.w_0, fixed=True))
    coupler_pin: LoopRevolute = LoopRevolute()
    rocker_pin: LoopRevolute = LoopRevolute()
    end_pin: LoopRevolute = LoopRevolute()
    crank: Link = Link(L=0.5, m=1.0)
    coupler: Link = Link(L=2.0, m=2.0, phi_0=0.8)
    rocker: Link = Link(L=1.5, m=1.5, phi_0=1.7)

    def equations(self) -> Equations:
        yield connect(self.left.frame, self.crank_pin.frame_a)
        yield connect(self.crank_pin.frame_b, self.crank.frame_a)
        yield connect(self.crank.frame_b, self.coupler_pin.frame_a)
        yield connect(self.coupler_pin.frame_b, self.coupler.frame_a)
        yield connect(self.right.frame, self.rocker_pin.frame_a)
        yield connect(self.rocker_pin.frame_b, self.rocker.frame_a)
        yield connect(self.coupler.frame_b, self.end_pin.frame_a)
        yield connect(self.end_pin.frame_b, self.rocker.frame_b)
