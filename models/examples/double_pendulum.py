"""A double pendulum from planar bodies and joints."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, connect, parameter, start
from arthur_acausal.components.planar import Body, Fixed, FixedTranslation, Revolute


class DoublePendulum(Component):
    """Two rods of length ``L`` [m] and mass ``m`` [kg] hang on one another; chaotic from large angles.

    ``upper.phi`` is the first rod's angle from the x-axis, ``lower.phi`` [rad] that of the second over the first.
    It starts at rest, the first rod level, the second upright on its end.
    """

    m: Real = parameter("kg", default=1.0, min=0.0)
    L: Real = parameter("m", default=1.0, min=0.0)
    ground = Fixed()
    upper: Revolute = Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    lower: Revolute = Revolute(phi=start(1.5707963267948966, fixed=True), w=start(0.0, fixed=True))

    def build(self) -> None:
        halves = [FixedTranslation(r_x=self.L / 2) for _ in range(4)]
        self.halves = halves
        self.rods = [Body(m=self.m, J=self.m * self.L**2 / 12) for _ in range(2)]

    def equations(self) -> Equations:
        first, second, third, fourth = self.halves
        yield connect(self.ground.frame, self.upper.frame_a)
        yield connect(self.upper.frame_b, first.frame_a)
        yield connect(first.frame_b, self.rods[0].frame)
        yield connect(first.frame_b, second.frame_a)
        yield connect(second.frame_b, self.lower.frame_a)
        yield connect(self.lower.frame_b, third.frame_a)
        yield connect(third.frame_b, self.rods[1].frame)
        yield connect(third.frame_b, fourth.frame_a)
