"""A slider crank: turning becomes sliding."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, connect, parameter, start
from arthur_acausal.components.planar import Body, Fixed, LoopPrismatic, LoopRevolute, Revolute
from arthur_acausal.components.rotational import Inertia
from arthur_acausal.components.translational import Damper
from arthur_acausal.components.translational import Fixed as Housing
from arthur_acausal.models.examples.four_bar import Link


class SliderCrank(Component):
    """A flywheel of ``J`` [kg m^2] drives a crank of 0.1 m, a rod of 0.3 m and a piston of 0.5 kg along x.

    ``crank_pin.phi``, ``crank_pin.w`` are the states. The piston works against a damper of ``d`` [N s/m].
    """

    J: Real = parameter("kg*m^2", default=0.05, min=0.0)
    d: Real = parameter("N*s/m", default=0.0, min=0.0)
    w_0: Real = parameter("rad/s", default=20.0, description="speed of the crank at the start")
    ground = Fixed()
    housing = Housing()
    flywheel: Inertia = Inertia(J=lambda self: self.J)
    crank_pin: Revolute = Revolute(
        use_flange=True, phi=start(0.0, fixed=True), w=start(lambda self: self.w_0, fixed=True)
    )
    crank: Link = Link(L=0.1, m=0.2)
    rod_pin: LoopRevolute = LoopRevolute()
    rod: Link = Link(L=0.3, m=0.3)
    piston_pin: LoopRevolute = LoopRevolute()
    piston: Body = Body(m=0.5, J=1e-3)
    slide: LoopPrismatic = LoopPrismatic(use_flange=True, s=start(0.4))
    damper: Damper = Damper(d=lambda self: self.d)

    def equations(self) -> Equations:
        yield connect(self.ground.frame, self.crank_pin.frame_a)
        yield connect(self.flywheel.flange_a, self.crank_pin.flange)
        yield connect(self.crank_pin.frame_b, self.crank.frame_a)
        yield connect(self.crank.frame_b, self.rod_pin.frame_a)
        yield connect(self.rod_pin.frame_b, self.rod.frame_a)
        yield connect(self.rod.frame_b, self.piston_pin.frame_a)
        yield connect(self.piston_pin.frame_b, self.piston.frame)
        yield connect(self.piston.frame, self.slide.frame_b)
        yield connect(self.slide.frame_a, self.ground.frame)
        yield connect(self.housing.flange, self.damper.flange_a)
        yield connect(self.damper.flange_b, self.slide.flange)
