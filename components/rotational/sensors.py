"""Ideal sensors of rotational mechanics."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, der, real_output
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


class TorqueSensor(Component):
    """Measures the torque ``tau`` [N m] that passes from flange_a to flange_b."""

    flange_a = Flange()
    flange_b = Flange()
    tau: Real = real_output("N*m")

    def equations(self) -> Equations:
        yield self.flange_a.phi == self.flange_b.phi
        yield self.flange_a.tau + self.flange_b.tau == 0
        yield self.tau == self.flange_a.tau
