"""Logical blocks, named as in the Modelica Standard Library (Blocks.Logical).

A logical signal is 0 or 1 and takes part in connect() like any other; an input counts as true above 0.5.
"""

from __future__ import annotations

import casadi
from casadi import SX

from arthur_acausal import Equations, Real, discrete, if_else, parameter, pre, real_input, real_output, time
from arthur_acausal.components.blocks.signal import Block

NEVER = 1e60
"""A time [s] that does not come."""


def holds(u: SX) -> SX:
    """Return the condition that a logical signal is true."""
    return u > 0.5


def truth(condition: SX) -> SX:
    """Return 1 where the condition holds, else 0; each of its relations makes an event."""
    return if_else(condition, 1, 0)


class Logical(Block):
    """What logical blocks with one input share."""

    u: Real = real_input("1", description="0 or 1")
    y: Real = real_output("1", description="0 or 1")


class Logical2(Block):
    """What logical blocks with two inputs share."""

    u1: Real = real_input("1", description="0 or 1")
    u2: Real = real_input("1", description="0 or 1")
    y: Real = real_output("1", description="0 or 1")


class Not(Logical):
    """y = 1 where u is 0, else 0."""

    def equations(self) -> Equations:
        yield self.y == 1 - self.u


class And(Logical2):
    """y = 1 where both inputs are 1."""

    def equations(self) -> Equations:
        yield self.y == self.u1 * self.u2


class Or(Logical2):
    """y = 1 where at least one input is 1."""

    def equations(self) -> Equations:
        yield self.y == self.u1 + self.u2 - self.u1 * self.u2


class Xor(Logical2):
    """y = 1 where just one input is 1."""

    def equations(self) -> Equations:
        yield self.y == self.u1 + self.u2 - 2 * self.u1 * self.u2


class Pre(Logical):
    """y = u just before: it breaks a loop of logical blocks. ``held`` [0 or 1]: u, at first ``pre_u_start``."""

    pre_u_start: Real = parameter("1", default=0.0)
    held: Real = discrete("1", start=lambda self: self.pre_u_start)
    before: Real = discrete("1", start=lambda self: self.pre_u_start)

    def equations(self) -> Equations:
        yield self.held == truth(holds(self.u))
        yield self.before == pre(self.held)
        yield self.y == self.before


class RSFlipFlop(Block):
    """q becomes 1 where the signal ``set`` is true, 0 where ``reset`` is, and stays otherwise; reset wins."""

    set: Real = real_input("1", description="0 or 1")
    reset: Real = real_input("1", description="0 or 1")
    y: Real = real_output("1", description="0 or 1")
    q_start: Real = parameter("1", default=0.0)
    q: Real = discrete("1", start=lambda self: self.q_start)

    def equations(self) -> Equations:
        kept = casadi.logic_or(holds(self.set), pre(self.q))
        yield self.q == truth(casadi.logic_and(kept, casadi.logic_not(holds(self.reset))))
        yield self.y == self.q


class Comparison(Block):
    """What comparisons of two signals of one unit share."""

    _units = {"u1": "{u}", "u2": "{u}"}
    u1: Real = real_input("1")
    u2: Real = real_input("1")
    y: Real = real_output("1", description="0 or 1")


class Greater(Comparison):
    """y = 1 where u1 > u2; an event."""

    def equations(self) -> Equations:
        yield self.y == truth(self.u1 > self.u2)


class GreaterEqual(Comparison):
    """y = 1 where u1 >= u2; an event."""

    def equations(self) -> Equations:
        yield self.y == truth(self.u1 >= self.u2)


class Less(Comparison):
    """y = 1 where u1 < u2; an event."""

    def equations(self) -> Equations:
        yield self.y == truth(self.u1 < self.u2)


class LessEqual(Comparison):
    """y = 1 where u1 <= u2; an event."""

    def equations(self) -> Equations:
        yield self.y == truth(self.u1 <= self.u2)


class Threshold(Block):
    """What comparisons with a constant share."""

    _units = {"u": "{u}", "threshold": "{u}"}
    u: Real = real_input("1")
    y: Real = real_output("1", description="0 or 1")
    threshold: Real = parameter("1", default=0.0)


class GreaterThreshold(Threshold):
    """y = 1 where u > threshold; an event."""

    def equations(self) -> Equations:
        yield self.y == truth(self.u > self.threshold)


class LessThreshold(Threshold):
    """y = 1 where u < threshold; an event."""

    def equations(self) -> Equations:
        yield self.y == truth(self.u < self.threshold)


class Switch(Block):
    """y = u1 where the logical signal u2 is true, else u3."""

    _units = {"u1": "{y}", "u3": "{y}", "y": "{y}"}
    u1: Real = real_input("1")
    u2: Real = real_input("1", description="0 or 1")
    u3: Real = real_input("1")
    y: Real = real_output("1")

    def equations(self) -> Equations:
        yield self.y == if_else(holds(self.u2), self.u1, self.u3)


class Hysteresis(Block):
    """y becomes 1 where u > u_high, 0 where u < u_low, and stays between; at first ``pre_y_start``."""

    _units = {"u": "{u}", "u_low": "{u}", "u_high": "{u}"}
    u: Real = real_input("1")
    y: Real = real_output("1", description="0 or 1")
    u_low: Real = parameter("1", default=0.0)
    u_high: Real = parameter("1", default=1.0)
    pre_y_start: Real = parameter("1", default=0.0)
    on: Real = discrete("1", start=lambda self: self.pre_y_start)

    def equations(self) -> Equations:
        stays = casadi.logic_and(pre(self.on), self.u >= self.u_low)
        yield self.on == truth(casadi.logic_or(self.u > self.u_high, stays))
        yield self.y == self.on


class OnOffController(Block):
    """y becomes 1 where u falls below reference - bandwidth/2, 0 where it rises above reference + bandwidth/2."""

    _units = {"u": "{u}", "reference": "{u}", "bandwidth": "{u}"}
    reference: Real = real_input("1", description="set point")
    u: Real = real_input("1", description="measurement")
    y: Real = real_output("1", description="0 or 1")
    bandwidth: Real = parameter("1", default=0.1, min=0.0)
    pre_y_start: Real = parameter("1", default=0.0)
    on: Real = discrete("1", start=lambda self: self.pre_y_start)

    def equations(self) -> Equations:
        low, high = self.reference - self.bandwidth / 2, self.reference + self.bandwidth / 2
        stays = casadi.logic_and(pre(self.on), self.u < high)
        yield self.on == truth(casadi.logic_or(self.u < low, stays))
        yield self.y == self.on


class Timer(Block):
    """y [s]: how long u has been true; 0 while it is not."""

    u: Real = real_input("1", description="0 or 1")
    y: Real = real_output("s")
    never: Real = parameter("s", default=NEVER)
    since: Real = discrete("s", start=lambda self: self.never, description="when u became true")

    def equations(self) -> Equations:
        yield self.since == if_else(holds(self.u), casadi.fmin(pre(self.since), time()), self.never)
        yield self.y == if_else(holds(self.u), time() - self.since, 0)


class OnDelay(Block):
    """y becomes 1 once u has been true for ``delay`` [s], and 0 with u."""

    u: Real = real_input("1", description="0 or 1")
    y: Real = real_output("1", description="0 or 1")
    delay: Real = parameter("s", min=0.0)
    never: Real = parameter("s", default=NEVER)
    since: Real = discrete("s", start=lambda self: self.never, description="when u became true")

    def equations(self) -> Equations:
        yield self.since == if_else(holds(self.u), casadi.fmin(pre(self.since), time()), self.never)
        yield self.y == truth(casadi.logic_and(holds(self.u), time() >= self.since + self.delay))
