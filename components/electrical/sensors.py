"""Ideal meters."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, real_output
from arthur_acausal.components.electrical.pin import FourPin, Pin


class PotentialSensor(Component):
    """Measures the potential of its pin: ``phi`` [V]."""

    pin = Pin()
    phi: Real = real_output("V")

    def equations(self) -> Equations:
        yield self.phi == self.pin.v
        yield self.pin.i == 0


class VoltageSensor(Component):
    """Measures the voltage from pin_p to pin_n: ``v`` [V]; takes no current."""

    pin_p = Pin()
    pin_n = Pin()
    v: Real = real_output("V")

    def equations(self) -> Equations:
        yield self.v == self.pin_p.v - self.pin_n.v
        yield self.pin_p.i == 0
        yield self.pin_n.i == 0


class CurrentSensor(Component):
    """Measures the current from pin_p to pin_n: ``i`` [A]; no voltage."""

    pin_p = Pin()
    pin_n = Pin()
    i: Real = real_output("A")

    def equations(self) -> Equations:
        yield self.pin_p.v == self.pin_n.v
        yield self.pin_p.i == self.i
        yield self.pin_n.i == -self.i


class PowerSensor(FourPin):
    """Measures the power ``P`` [W] = i1 v2: the current through port 1 times the voltage at port 2."""

    P: Real = real_output("W")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v1 == 0
        yield self.i2 == 0
        yield self.P == self.i1 * self.v2
