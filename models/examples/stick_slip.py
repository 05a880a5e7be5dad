"""A block on a moving belt, held by a spring: stick-slip oscillation."""

from __future__ import annotations

from arthur_acausal import Component, Equations, connect, start
from arthur_acausal.components.translational import ConstantSpeed, Fixed, MassWithFriction, Spring


class StickSlip(Component):
    """The belt carries the block along until the spring tears it off; it springs back and sticks again.

    The friction falls from 15 N at rest towards 10 N, so the oscillation goes on for ever. ``block.mode`` [1] is 0
    while the block rides on the belt, -1 while it falls behind.
    """

    belt: ConstantSpeed = ConstantSpeed(v_constant=0.1)
    block: MassWithFriction = MassWithFriction(
        use_support=True,
        m=1.0,
        F_C=10.0,
        F_St=5.0,
        f_exp=3.0,
        s=start(0.0, fixed=True),
        v=start(0.0, fixed=True),
    )
    spring: Spring = Spring(c=100.0)
    wall = Fixed()

    def equations(self) -> Equations:
        yield connect(self.belt.flange, self.block.support)
        yield connect(self.wall.flange, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.block.flange)
