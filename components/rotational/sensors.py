"""Ideal sensors of rotational mechanics: they take no torque."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, der, real_output, variable
from arthur_acausal.components.rotational.flange import Flange


class AngleSensor(Component):
    """Measures the angle of its flange: ``phi`` [rad]."""

    flange = Flange()
    phi: Real = real_output("rad")

    def equations(self) -> Equations:
        yield self.phi == self.flange.phi
        yield self.flange.tau == 0


class SpeedSensor(Component):
    """Measures the speed of its flange: ``w`` [rad/s]."""

    flange = Flange()
    w: Real = real_output("rad/s")

    def equations(self) -> Equations:
        yield self.w == der(self.flange.phi)
        yield self.flange.tau == 0


class AccelerationSensor(Component):
    """Measures the acceleration of its flange: ``a`` [rad/s^2]."""

    flange = Flange()
    w: Real = variable("rad/s", description="speed")
    a: Real = real_output("rad/s^2")

    def equations(self) -> Equations:
        yield self.w == der(self.flange.phi)
        yield self.a == der(self.w)
        yield self.flange.tau == 0


class TorqueSensor(Component):
    """Measures the torque ``tau`` [N m] that passes from flange_a to flange_b."""

    flange_a = Flange()
    flange_b = Flange()
    tau: Real = real_output("N*m")

    def equations(self) -> Equations:
        yield self.flange_a.phi == self.flange_b.phi
        yield self.flange_a.tau + self.flange_b.tau == 0
        yield self.tau == self.flange_a.tau


class PowerSensor(Component):
    """Measures the power ``P`` [W] that passes from flange_a to flange_b."""

    flange_a = Flange()
    flange_b = Flange()
    P: Real = real_output("W")

    def equations(self) -> Equations:
        yield self.flange_a.phi == self.flange_b.phi
        yield self.flange_a.tau + self.flange_b.tau == 0
        yield self.P == self.flange_a.tau * der(self.flange_a.phi)


class RelativeAngleSensor(Component):
    """Measures the angle of flange_b relative to flange_a: ``phi_rel`` [rad]."""

    flange_a = Flange()
    flange_b = Flange()
    phi_rel: Real = real_output("rad")

    def equations(self) -> Equations:
        yield self.phi_rel == self.flange_b.phi - self.flange_a.phi
        yield self.flange_a.tau == 0
        yield self.flange_b.tau == 0


class RelativeSpeedSensor(Component):
    """Measures the speed of flange_b relative to flange_a: ``w_rel`` [rad/s]."""

    flange_a = Flange()
    flange_b = Flange()
    w_rel: Real = real_output("rad/s")

    def equations(self) -> Equations:
        yield self.w_rel == der(self.flange_b.phi - self.flange_a.phi)
        yield self.flange_a.tau == 0
        yield self.flange_b.tau == 0
