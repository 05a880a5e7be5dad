"""Voltage and current sources, named as in the Modelica Standard Library (Electrical.Analog.Sources).

A voltage source holds pin_p above pin_n. A current source drives its current from pin_p through itself to pin_n,
so that the circuit gets it from pin_n.
"""

from __future__ import annotations

from math import pi

from casadi import SX

from arthur_acausal import Equations, Real, discrete, parameter, pre, real_input, time, when
from arthur_acausal.components.blocks.waveforms import (
    after,
    exp_sine,
    piecewise_linear,
    pulse,
    ramp,
    sine,
    trapezoid,
)
from arthur_acausal.components.electrical.pin import TwoPin


class VoltageSource(TwoPin):
    """What voltage sources share: v = level."""

    def level(self) -> SX:
        """Return the voltage [V]."""
        raise NotImplementedError

    def equations(self) -> Equations:
        yield from super().equations()
        yield "source voltage", self.v == self.level()


class CurrentSource(TwoPin):
    """What current sources share: i = level."""

    def level(self) -> SX:
        """Return the current [A]."""
        raise NotImplementedError

    def equations(self) -> Equations:
        yield from super().equations()
        yield "source current", self.i == self.level()


class SignalVoltage(VoltageSource):
    """v = the signal ``V`` [V]."""

    V: Real = real_input("V", default=0.0)

    def level(self) -> SX:
        return self.V


class SignalCurrent(CurrentSource):
    """i = the signal ``I`` [A]."""

    I: Real = real_input("A", default=0.0)

    def level(self) -> SX:
        return self.I


class ConstantVoltage(VoltageSource):
    """v = V."""

    V: Real = parameter("V")

    def level(self) -> SX:
        return self.V


class StepVoltage(VoltageSource):
    """v = offset, and offset + V from ``start_time`` [s] on: an event."""

    V: Real = parameter("V", default=1.0)
    start_time: Real = parameter("s", default=0.0)
    offset: Real = parameter("V", default=0.0)

    def level(self) -> SX:
        return self.offset + after(self.start_time, self.V)


class RampVoltage(VoltageSource):
    """v = offset until ``start_time`` [s], then linearly to offset + V within ``duration`` [s]. Events."""

    V: Real = parameter("V", default=1.0)
    duration: Real = parameter("s", default=1.0, min=0.0)
    start_time: Real = parameter("s", default=0.0)
    offset: Real = parameter("V", default=0.0)

    def level(self) -> SX:
        return self.offset + self.V * ramp(self.start_time, self.duration)


class SineVoltage(VoltageSource):
    """v = offset + V sin(2 pi f (t - start_time) + phase) from ``start_time`` [s] on, offset before."""

    V: Real = parameter("V", default=1.0)
    f: Real = parameter("Hz")
    phase: Real = parameter("rad", default=0.0)
    start_time: Real = parameter("s", default=0.0)
    offset: Real = parameter("V", default=0.0)

    def level(self) -> SX:
        return self.offset + self.V * sine(self.start_time, self.f, self.phase)


class ExpSineVoltage(VoltageSource):
    """A decaying sine: v = offset + V exp(-damping t') sin(2 pi f t' + phase), t' = t - start_time."""

    V: Real = parameter("V", default=1.0)
    f: Real = parameter("Hz")
    phase: Real = parameter("rad", default=0.0)
    damping: Real = parameter("1/s", default=1.0)
    start_time: Real = parameter("s", default=0.0)
    offset: Real = parameter("V", default=0.0)

    def level(self) -> SX:
        return self.offset + self.V * exp_sine(self.start_time, self.f, self.phase, self.damping)


class CosineVoltage(VoltageSource):
    """v = offset + V cos(2 pi f (t - start_time) + phase) from ``start_time`` [s] on, offset before."""

    V: Real = parameter("V", default=1.0)
    f: Real = parameter("Hz")
    phase: Real = parameter("rad", default=0.0)
    start_time: Real = parameter("s", default=0.0)
    offset: Real = parameter("V", default=0.0)

    def level(self) -> SX:
        return self.offset + self.V * sine(self.start_time, self.f, self.phase + pi / 2)


class PulseVoltage(VoltageSource):
    """v = offset + V for the part ``duty`` [1] of each ``period`` [s] from ``start_time`` on, else offset. Events.

    ``T_0`` [s]: the start of the current period.
    """

    V: Real = parameter("V", default=1.0)
    duty: Real = parameter("1", default=0.5, min=0.0, max=1.0)
    period: Real = parameter("s", default=1.0, min=0.0)
    start_time: Real = parameter("s", default=0.0)
    offset: Real = parameter("V", default=0.0)
    T_0: Real = discrete("s", start=lambda self: self.start_time)

    def level(self) -> SX:
        return self.offset + self.V * pulse(self.start_time, self.T_0, self.duty * self.period)

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(time() >= self.T_0 + self.period, self.T_0 == pre(self.T_0) + self.period)


class TrapezoidVoltage(VoltageSource):
    """v = offset, and from ``start_time`` [s] on each ``period`` a trapezoid up to offset + V. Events.

    ``rising``, ``width``, ``falling`` [s]: up, at the top, down. ``T_0`` [s]: the start of the current period.
    """

    V: Real = parameter("V", default=1.0)
    rising: Real = parameter("s", default=0.0, min=0.0)
    width: Real = parameter("s", default=0.5, min=0.0)
    falling: Real = parameter("s", default=0.0, min=0.0)
    period: Real = parameter("s", default=1.0, min=0.0)
    start_time: Real = parameter("s", default=0.0)
    offset: Real = parameter("V", default=0.0)
    T_0: Real = discrete("s", start=lambda self: self.start_time)

    def level(self) -> SX:
        shape = trapezoid(self.start_time, self.T_0, self.rising, self.width, self.falling)
        return self.offset + self.V * shape

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(time() >= self.T_0 + self.period, self.T_0 == pre(self.T_0) + self.period)


class TableVoltage(VoltageSource):
    """v from a table: linear over ``times`` [s], ``values`` [V], tuples of numbers; constant outside. Events."""

    times: tuple[float, ...]
    values: tuple[float, ...]
    second: Real = parameter("s", default=1.0, description="what a time of 1 means")
    unit: Real = parameter("V", default=1.0, description="what a value of 1 means")

    def level(self) -> SX:
        return self.unit * piecewise_linear(time() / self.second, self.times, self.values, events=True)


class ConstantCurrent(CurrentSource):
    """i = I."""

    I: Real = parameter("A")

    def level(self) -> SX:
        return self.I


class StepCurrent(CurrentSource):
    """i = offset, and offset + I from ``start_time`` [s] on: an event."""

    I: Real = parameter("A", default=1.0)
    start_time: Real = parameter("s", default=0.0)
    offset: Real = parameter("A", default=0.0)

    def level(self) -> SX:
        return self.offset + after(self.start_time, self.I)


class RampCurrent(CurrentSource):
    """i = offset until ``start_time`` [s], then linearly to offset + I within ``duration`` [s]. Events."""

    I: Real = parameter("A", default=1.0)
    duration: Real = parameter("s", default=1.0, min=0.0)
    start_time: Real = parameter("s", default=0.0)
    offset: Real = parameter("A", default=0.0)

    def level(self) -> SX:
        return self.offset + self.I * ramp(self.start_time, self.duration)


class SineCurrent(CurrentSource):
    """i = offset + I sin(2 pi f (t - start_time) + phase) from ``start_time`` [s] on, offset before."""

    I: Real = parameter("A", default=1.0)
    f: Real = parameter("Hz")
    phase: Real = parameter("rad", default=0.0)
    start_time: Real = parameter("s", default=0.0)
    offset: Real = parameter("A", default=0.0)

    def level(self) -> SX:
        return self.offset + self.I * sine(self.start_time, self.f, self.phase)


class ExpSineCurrent(CurrentSource):
    """A decaying sine: i = offset + I exp(-damping t') sin(2 pi f t' + phase), t' = t - start_time."""

    I: Real = parameter("A", default=1.0)
    f: Real = parameter("Hz")
    phase: Real = parameter("rad", default=0.0)
    damping: Real = parameter("1/s", default=1.0)
    start_time: Real = parameter("s", default=0.0)
    offset: Real = parameter("A", default=0.0)

    def level(self) -> SX:
        return self.offset + self.I * exp_sine(self.start_time, self.f, self.phase, self.damping)


class CosineCurrent(CurrentSource):
    """i = offset + I cos(2 pi f (t - start_time) + phase) from ``start_time`` [s] on, offset before."""

    I: Real = parameter("A", default=1.0)
    f: Real = parameter("Hz")
    phase: Real = parameter("rad", default=0.0)
    start_time: Real = parameter("s", default=0.0)
    offset: Real = parameter("A", default=0.0)

    def level(self) -> SX:
        return self.offset + self.I * sine(self.start_time, self.f, self.phase + pi / 2)


class PulseCurrent(CurrentSource):
    """i = offset + I for the part ``duty`` [1] of each ``period`` [s] from ``start_time`` on, else offset. Events.

    ``T_0`` [s]: the start of the current period.
    """

    I: Real = parameter("A", default=1.0)
    duty: Real = parameter("1", default=0.5, min=0.0, max=1.0)
    period: Real = parameter("s", default=1.0, min=0.0)
    start_time: Real = parameter("s", default=0.0)
    offset: Real = parameter("A", default=0.0)
    T_0: Real = discrete("s", start=lambda self: self.start_time)

    def level(self) -> SX:
        return self.offset + self.I * pulse(self.start_time, self.T_0, self.duty * self.period)

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(time() >= self.T_0 + self.period, self.T_0 == pre(self.T_0) + self.period)


class TableCurrent(CurrentSource):
    """i from a table: linear over ``times`` [s], ``values`` [A], tuples of numbers; constant outside. Events."""

    times: tuple[float, ...]
    values: tuple[float, ...]
    second: Real = parameter("s", default=1.0, description="what a time of 1 means")
    unit: Real = parameter("A", default=1.0, description="what a value of 1 means")

    def level(self) -> SX:
        return self.unit * piecewise_linear(time() / self.second, self.times, self.values, events=True)
