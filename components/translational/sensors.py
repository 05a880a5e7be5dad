"""Ideal sensors of translational mechanics."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, der, real_output
from arthur_acausal.components.translational.flange import Flange


class PositionSensor(Component):
    """Measures the position of its flange: ``s`` [m]."""

    flange = Flange()
    s: Real = real_output("m")

    def equations(self) -> Equations:
        yield self.s == self.flange.s
        yield self.flange.f == 0


class SpeedSensor(Component):
    """Measures the velocity of its flange: ``v`` [m/s]."""

    flange = Flange()
    v: Real = real_output("m/s")

    def equations(self) -> Equations:
        yield self.v == der(self.flange.s)
        yield self.flange.f == 0


class ForceSensor(Component):
    """Measures the force ``f`` [N] that passes from flange_a to flange_b, positive in compression."""

    flange_a = Flange()
    flange_b = Flange()
    f: Real = real_output("N")

    def equations(self) -> Equations:
        yield self.flange_a.s == self.flange_b.s
        yield self.flange_a.f + self.flange_b.f == 0
        yield self.f == self.flange_a.f
