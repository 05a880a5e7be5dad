"""Ideal sensors of translational mechanics: they take no force."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, der, real_output, variable
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


class AccelerationSensor(Component):
    """Measures the acceleration of its flange: ``a`` [m/s^2]."""

    flange = Flange()
    v: Real = variable("m/s", description="velocity")
    a: Real = real_output("m/s^2")

    def equations(self) -> Equations:
        yield self.v == der(self.flange.s)
        yield self.a == der(self.v)
        yield self.flange.f == 0


class PowerSensor(Component):
    """Measures the power ``P`` [W] that passes from flange_a to flange_b."""

    flange_a = Flange()
    flange_b = Flange()
    P: Real = real_output("W")

    def equations(self) -> Equations:
        yield self.flange_a.s == self.flange_b.s
        yield self.flange_a.f + self.flange_b.f == 0
        yield self.P == self.flange_a.f * der(self.flange_a.s)


class RelativePositionSensor(Component):
    """Measures the distance from flange_a to flange_b: ``s_rel`` [m]."""

    flange_a = Flange()
    flange_b = Flange()
    s_rel: Real = real_output("m")

    def equations(self) -> Equations:
        yield self.s_rel == self.flange_b.s - self.flange_a.s
        yield self.flange_a.f == 0
        yield self.flange_b.f == 0


class RelativeSpeedSensor(Component):
    """Measures the velocity of flange_b relative to flange_a: ``v_rel`` [m/s]."""

    flange_a = Flange()
    flange_b = Flange()
    v_rel: Real = real_output("m/s")

    def equations(self) -> Equations:
        yield self.v_rel == der(self.flange_b.s - self.flange_a.s)
        yield self.flange_a.f == 0
        yield self.flange_b.f == 0
