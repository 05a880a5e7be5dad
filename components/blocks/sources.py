"""Signal sources, named as in the Modelica Standard Library (Blocks.Sources)."""

from __future__ import annotations

from itertools import pairwise
from math import pi

from casadi import SX, sin

from arthur_acausal import (
    Equations,
    Real,
    discrete,
    if_else,
    parameter,
    pre,
    real_output,
    smooth_if_else,
    time,
    when,
)
from arthur_acausal.components.blocks.signal import Source


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
        yield self.y == self.offset + if_else(time() < self.start_time, 0, self.height)


class Ramp(Source):
    """From offset at ``start_time`` [s] to offset + height, linearly within ``duration`` [s]: two events."""

    _units = {"y": "{y}", "height": "{y}", "offset": "{y}"}
    height: Real = parameter("1", default=1.0)
    offset: Real = parameter("1", default=0.0)
    start_time: Real = parameter("s", default=0.0)
    duration: Real = parameter("s", default=1.0, min=0.0)

    def equations(self) -> Equations:
        t = time() - self.start_time
        rising = if_else(time() < self.start_time + self.duration, t / self.duration, 1)
        yield self.y == self.offset + self.height * if_else(time() < self.start_time, 0, rising)


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
        wave = self.amplitude * sin(2 * pi * self.f * (time() - self.start_time) + self.phase)
        yield self.y == self.offset + if_else(time() < self.start_time, 0, wave)


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
        t, T_0 = time(), self.T_0
        yield when(t >= T_0 + self.period, T_0 == pre(T_0) + self.period)
        end_rise = T_0 + self.rising
        end_width = end_rise + self.width
        end_fall = end_width + self.falling
        falling = if_else(t < end_fall, (end_fall - t) / self.falling, 0)
        level = if_else(t < end_width, 1, falling)
        shape = if_else(t < end_rise, (t - T_0) / self.rising, level)
        yield self.y == self.offset + self.amplitude * if_else(t < self.start_time, 0, shape)


class TimeTable(Source):
    """Linear interpolation of ``values`` (in the unit of y) over ``times`` [s]; constant outside.

    Both are structural: tuples of equal length, times increasing. ``events``: whether each corner is an
    event; without, the integrator's error control finds the corners. For long tables give an external input
    instead.
    """

    times: tuple[float, ...]
    values: tuple[float, ...]
    events: bool = False
    _units = {"y": "{y}", "unit": "{y}"}
    unit: Real = parameter("1", default=1.0, description="what a value of 1 means")
    second: Real = parameter("s", default=1.0, description="what a time of 1 means")

    def equations(self) -> Equations:
        pairs = list(zip(self.times, self.values, strict=True))
        t = time() / self.second
        shape = SX(pairs[-1][1])
        choose = if_else if self.events else smooth_if_else
        for (t0, y0), (t1, y1) in reversed(list(pairwise(pairs))):
            shape = choose(t < t1, y0 + (y1 - y0) * (t - t0) / (t1 - t0), shape)
        shape = choose(t < pairs[0][0], pairs[0][1], shape)
        yield self.y == self.unit * shape
