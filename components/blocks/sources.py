"""Signal sources, named as in the Modelica Standard Library (Blocks.Sources)."""

from __future__ import annotations

import csv
from os import PathLike
from pathlib import Path
from typing import Self

import casadi
from casadi import SX

from arthur_acausal import Equations, Real, discrete, if_else, parameter, pre, real_output, time, when
from arthur_acausal.components.blocks.signal import Source
from arthur_acausal.components.blocks.waveforms import (
    after,
    exp_sine,
    piecewise_linear,
    pulse,
    ramp,
    sine,
    trapezoid,
)


class Constant(Source):
    """y = k."""

    _units = {"y": "{y}", "k": "{y}"}
    k: Real = parameter("1", default=1.0)

    def equations(self) -> Equations:
        yield self.y == self.k


class Clock(Source):
    """y = time - start_time [s] once that is past, 0 before; an event at start_time."""

    _units = {}
    y: Real = real_output("s")
    start_time: Real = parameter("s", default=0.0)

    def equations(self) -> Equations:
        yield self.y == if_else(time() < self.start_time, 0, time() - self.start_time)


class Step(Source):
    """y = offset, and offset + height from ``start_time`` [s] on: an event."""

    _units = {"y": "{y}", "height": "{y}", "offset": "{y}"}
    height: Real = parameter("1", default=1.0)
    offset: Real = parameter("1", default=0.0)
    start_time: Real = parameter("s", default=0.0)

    def equations(self) -> Equations:
        yield self.y == self.offset + self.height * after(self.start_time, 1)


class Ramp(Source):
    """From offset at ``start_time`` [s] to offset + height, linearly within ``duration`` [s]: two events."""

    _units = {"y": "{y}", "height": "{y}", "offset": "{y}"}
    height: Real = parameter("1", default=1.0)
    offset: Real = parameter("1", default=0.0)
    start_time: Real = parameter("s", default=0.0)
    duration: Real = parameter("s", default=1.0, min=0.0)

    def equations(self) -> Equations:
        yield self.y == self.offset + self.height * ramp(self.start_time, self.duration)


class Sine(Source):
    """y = offset + amplitude sin(2 pi f (t - start_time) + phase) from ``start_time`` [s] on, offset before.

    ``f`` [Hz], ``phase`` [rad]. ``start_time`` is an event.
    """

    _units = {"y": "{y}", "amplitude": "{y}", "offset": "{y}"}
    amplitude: Real = parameter("1", default=1.0)
    f: Real = parameter("Hz")
    phase: Real = parameter("rad", default=0.0)
    offset: Real = parameter("1", default=0.0)
    start_time: Real = parameter("s", default=0.0)

    def equations(self) -> Equations:
        wave = sine(self.start_time, self.f, self.phase)
        yield self.y == self.offset + self.amplitude * wave


class Cosine(Sine):
    """y = offset + amplitude cos(2 pi f (t - start_time) + phase) from ``start_time`` [s] on, offset before."""

    def equations(self) -> Equations:
        wave = sine(self.start_time, self.f, self.phase + casadi.pi / 2)
        yield self.y == self.offset + self.amplitude * wave


class ExpSine(Sine):
    """A decaying sine: offset + amplitude exp(-damping (t - start_time)) sin(2 pi f (t - start_time) + phase).

    ``damping`` [1/s], ``f`` [Hz], ``phase`` [rad]; offset before ``start_time`` [s].
    """

    damping: Real = parameter("1/s", default=1.0)

    def equations(self) -> Equations:
        wave = exp_sine(self.start_time, self.f, self.phase, self.damping)
        yield self.y == self.offset + self.amplitude * wave


class Periodic(Source):
    """What sources share that repeat each ``period`` [s]: ``T_0`` [s], the start of the current period."""

    _units = {"y": "{y}", "amplitude": "{y}", "offset": "{y}"}
    amplitude: Real = parameter("1", default=1.0)
    period: Real = parameter("s", default=1.0, min=0.0)
    offset: Real = parameter("1", default=0.0)
    start_time: Real = parameter("s", default=0.0)
    T_0: Real = discrete("s", start=lambda self: self.start_time)

    def equations(self) -> Equations:
        yield when(time() >= self.T_0 + self.period, self.T_0 == pre(self.T_0) + self.period)
        yield self.y == self.offset + self.amplitude * after(self.start_time, self.shape())

    def shape(self) -> SX:
        """Return the shape over one period [1]."""
        raise NotImplementedError


class Pulse(Periodic):
    """offset + amplitude for the part ``duty`` [1] of each ``period`` [s], offset for the rest. Events."""

    duty: Real = parameter("1", default=0.5, min=0.0, max=1.0)

    def shape(self) -> SX:
        return pulse(self.start_time, self.T_0, self.duty * self.period)


class SawTooth(Periodic):
    """In each ``period`` [s] linearly from offset to offset + amplitude. Events."""

    def shape(self) -> SX:
        return (time() - self.T_0) / self.period


class Trapezoid(Source):
    """A periodic trapezoid: each ``period`` [s] it rises, stays at offset + amplitude for ``width``, falls.

    ``rising``, ``width``, ``falling`` [s]; their sum is less than the period. Every corner is an event.
    ``T_0`` [s] is the start of the current period.
    """

    _units = {"y": "{y}", "amplitude": "{y}", "offset": "{y}"}
    amplitude: Real = parameter("1", default=1.0)
    rising: Real = parameter("s", default=0.0, min=0.0)
    width: Real = parameter("s", default=0.5, min=0.0)
    falling: Real = parameter("s", default=0.0, min=0.0)
    period: Real = parameter("s", default=1.0, min=0.0)
    offset: Real = parameter("1", default=0.0)
    start_time: Real = parameter("s", default=0.0)
    T_0: Real = discrete("s", start=lambda self: self.start_time)

    def equations(self) -> Equations:
        yield when(time() >= self.T_0 + self.period, self.T_0 == pre(self.T_0) + self.period)
        shape = trapezoid(self.start_time, self.T_0, self.rising, self.width, self.falling)
        yield self.y == self.offset + self.amplitude * shape


class KinematicPTP(Source):
    """The acceleration of the fastest motion over ``distance``, at most ``speed_max``, ``acceleration_max``.

    y is +-acceleration_max or 0: speeding up, constant speed (if it is reached), braking, from ``start_time`` [s]
    on. Integrated twice it gives the motion. Units: that of y, times s, times s^2. Events.
    """

    _units = {"y": "{y}", "distance": "({y})*s^2", "speed_max": "({y})*s", "acceleration_max": "{y}"}
    distance: Real = parameter("s^2", default=1.0)
    speed_max: Real = parameter("s", default=1.0, min=0.0)
    acceleration_max: Real = parameter("1", default=1.0, min=0.0)
    start_time: Real = parameter("s", default=0.0)

    def equations(self) -> Equations:
        way, speed, acceleration = casadi.fabs(self.distance), self.speed_max, self.acceleration_max
        triangular = casadi.sqrt(way / acceleration)  # without a phase of constant speed
        T_a = casadi.fmin(triangular, speed / acceleration)
        T_v = casadi.fmax(triangular, way / speed)
        t, t_0 = time(), self.start_time
        braking = if_else(t < t_0 + T_v + T_a, -1, 0)
        shape = if_else(t < t_0 + T_a, 1, if_else(t < t_0 + T_v, 0, braking))
        yield self.y == casadi.sign(self.distance) * acceleration * after(t_0, shape)


class TimeTable(Source):
    """Linear interpolation of ``values`` (in the unit of y) over ``times`` [s]; constant outside.

    Both are structural: tuples of equal length, times increasing; a time that stands twice is a jump, which needs
    ``events``: whether each corner is an
    event; without, the integrator's error control finds the corners. For long tables give an external input
    instead.
    """

    times: tuple[float, ...]
    values: tuple[float, ...]
    events: bool = False
    _units = {"y": "{y}", "unit": "{y}"}
    unit: Real = parameter("1", default=1.0, description="what a value of 1 means")
    second: Real = parameter("s", default=1.0, description="what a time of 1 means")

    @classmethod
    def from_csv(cls, file: str | PathLike[str], time: str = "time", value: str = "value") -> Self:
        """Return the table of two columns of a CSV file with a header line."""
        with Path(file).open(newline="", encoding="utf-8") as lines:
            rows = list(csv.DictReader(lines))
        return cls(times=tuple(float(r[time]) for r in rows), values=tuple(float(r[value]) for r in rows))

    def equations(self) -> Equations:
        t = time() / self.second
        yield self.y == self.unit * piecewise_linear(t, self.times, self.values, self.events)
