"""Shapes over time that signal sources of all domains share: plain numbers, 0 before their start."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import pi

import casadi
from casadi import SX

from arthur_acausal import if_else, smooth_if_else, time


def after(start: SX, shape: SX | float) -> SX:
    """Return 0 until ``start`` [s], then ``shape``; an event."""
    return if_else(time() < start, 0, shape)


def ramp(start: SX, duration: SX) -> SX:
    """Return 0 until ``start`` [s], then linearly to 1 within ``duration`` [s]; two events."""
    end = start + duration
    return after(start, if_else(time() < end, (time() - start) / duration, 1))


def sine(start: SX, f: SX, phase: SX) -> SX:
    """Return sin(2 pi f (t - start) + phase) from ``start`` [s] on; ``f`` [Hz], ``phase`` [rad]."""
    return after(start, casadi.sin(2 * pi * f * (time() - start) + phase))


def exp_sine(start: SX, f: SX, phase: SX, damping: SX) -> SX:
    """Return exp(-damping (t - start)) sin(2 pi f (t - start) + phase); ``damping`` [1/s]."""
    t = time() - start
    return after(start, casadi.exp(-damping * t) * casadi.sin(2 * pi * f * t + phase))


def pulse(start: SX, begun: SX, width: SX) -> SX:
    """Return 1 for ``width`` [s] from ``begun`` [s], the start of the current period, then 0."""
    return after(start, if_else(time() < begun + width, 1, 0))


def piecewise_linear(x: SX, xs: Sequence[float], ys: Sequence[float], events: bool = False) -> SX:
    """Return the linear interpolation of ``ys`` over ``xs`` at ``x``, constant outside; each corner may be an event.

    A place that stands twice is a jump.
    """
    choose = if_else if events else smooth_if_else
    shape = SX(ys[-1])
    points = list(zip(xs, ys, strict=True))
    for (x0, y0), (x1, y1) in reversed(list(pairwise(points))):
        if x1 > x0:
            shape = choose(x < x1, y0 + (y1 - y0) * (x - x0) / (x1 - x0), shape)
    return choose(x < xs[0], ys[0], shape)


def trapezoid(start: SX, begun: SX, rising: SX, width: SX, falling: SX) -> SX:
    """Return a trapezoid from 0 to 1 and back, that began at ``begun`` [s]; every corner is an event."""
    t, end_rise = time(), begun + rising
    end_width = end_rise + width
    end_fall = end_width + falling
    fall = if_else(t < end_fall, (end_fall - t) / falling, 0)
    level = if_else(t < end_width, 1, fall)
    return after(start, if_else(t < end_rise, (t - begun) / rising, level))
