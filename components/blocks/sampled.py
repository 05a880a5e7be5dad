"""Sampled blocks, named as in the Modelica Standard Library (Blocks.Discrete).

They take their first sample at ``start_time`` [s], then one each ``period`` [s]; the output is held between. All
blocks that sample at one instant read what their inputs were just before it, so that a chain of them delays by
one period a block.
"""

from __future__ import annotations

from arthur_acausal import Equations, Real, discrete, parameter, pre, real_input, time, when
from arthur_acausal.components.blocks.signal import SISO


class Sampled(SISO):
    """What blocks share that act each ``period`` [s] from ``start_time`` [s] on; ``k`` counts the samples."""

    period: Real = parameter("s", min=0.0)
    start_time: Real = parameter("s", default=0.0)
    k: Real = discrete("1", description="samples taken")


class Sampler(Sampled):
    """y = u at the last sample; before the first, ``y_start``. ``period``, ``start_time`` [s]."""

    _units = {"u": "{y}", "y": "{y}", "held": "{y}", "y_start": "{y}"}
    y_start: Real = parameter("1", default=0.0)
    held: Real = discrete("1", start=lambda self: self.y_start)

    def equations(self) -> Equations:
        due = time() > self.start_time + self.k * self.period
        yield "sample", when(due, self.held == self.u, self.k == pre(self.k) + 1)
        yield self.y == self.held


class ZeroOrderHold(Sampler):
    """y = u at the last sample: a sampler with its hold. ``period``, ``start_time`` [s]."""


class UnitDelay(Sampler):
    """y = u at the sample before the last. ``period``, ``start_time`` [s]."""

    _units = {**Sampler._units, "last": "{y}"}
    last: Real = discrete("1", start=lambda self: self.y_start)

    def equations(self) -> Equations:
        due = time() > self.start_time + self.k * self.period
        yield "sample", when(due, self.held == pre(self.last), self.last == self.u, self.k == pre(self.k) + 1)
        yield self.y == self.held


class TriggeredSampler(SISO):
    """y = u at the moment when the logical signal ``trigger`` last became true; before, ``y_start``."""

    _units = {"u": "{y}", "y": "{y}", "held": "{y}", "y_start": "{y}"}
    trigger: Real = real_input("1", description="0 or 1")
    y_start: Real = parameter("1", default=0.0)
    held: Real = discrete("1", start=lambda self: self.y_start)

    def equations(self) -> Equations:
        yield "sample", when(self.trigger > 0.5, self.held == self.u)
        yield self.y == self.held
