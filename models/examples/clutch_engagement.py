"""A clutch brings a load up to speed: dry friction that ends in sticking."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, connect, parameter, start
from arthur_acausal.components.blocks import Step
from arthur_acausal.components.rotational import Clutch, Inertia


class ClutchEngagement(Component):
    """A wheel at 100 rad/s meets one at rest through a clutch that closes at 0.1 s.

    The clutch slides with its full torque until both turn alike, then sticks. The momentum stays; the loss is
    J_a J_b / (J_a + J_b) w_0^2 / 2, whatever the torque. ``clutch.mode`` goes from 2 (free) to -1 and 0 (stuck).
    """

    J_a: Real = parameter("kg*m^2", default=0.2, min=0.0)
    J_b: Real = parameter("kg*m^2", default=0.3, min=0.0)
    w_0: Real = parameter("rad/s", default=100.0)
    driving: Inertia = Inertia(
        J=lambda self: self.J_a, phi=start(0.0, fixed=True), w=start(lambda self: self.w_0, fixed=True)
    )
    driven: Inertia = Inertia(J=lambda self: self.J_b, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    clutch: Clutch = Clutch(f_n_max=1000.0, c_geo=0.1, mu_pos=((0.0, 0.4),))
    press: Step = Step(start_time=0.1)

    def equations(self) -> Equations:
        yield connect(self.driving.flange_b, self.clutch.flange_a)
        yield connect(self.clutch.flange_b, self.driven.flange_a)
        yield connect(self.press.y, self.clutch.f_normalized)
