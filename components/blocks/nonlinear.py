"""Nonlinear blocks, named as in the Modelica Standard Library (Blocks.Nonlinear)."""

from __future__ import annotations

from casadi import fmax, fmin

from arthur_acausal import Equations, Real, der, parameter, real_input, variable
from arthur_acausal.components.blocks.signal import SISO


class VariableLimiter(SISO):
    """y = u limited to the signals limit_low..limit_high. Continuous: no event."""

    _units = {"u": "{y}", "y": "{y}", "limit_low": "{y}", "limit_high": "{y}"}
    limit_low: Real = real_input("1")
    limit_high: Real = real_input("1")

    def equations(self) -> Equations:
        yield self.y == fmin(fmax(self.u, self.limit_low), self.limit_high)


class DeadZone(SISO):
    """y = 0 for u within u_min..u_max, beyond it u less the limit. Continuous: no event."""

    _units = {"u": "{y}", "y": "{y}", "u_min": "{y}", "u_max": "{y}"}
    u_max: Real = parameter("1")
    u_min: Real = parameter("1", default=lambda self: -self.u_max)

    def equations(self) -> Equations:
        yield self.y == self.u - fmin(fmax(self.u, self.u_min), self.u_max)


class SlewRateLimiter(SISO):
    """y follows u no faster than ``rising`` and no faster down than ``falling`` (negative), each per second.

    der(y) = (u - y)/T_d within these limits; ``T_d`` [s] is the lag while u is slow. State ``x``, at first u.
    """

    _units = {"u": "{y}", "y": "{y}", "x": "{y}", "rising": "({y})/s", "falling": "({y})/s"}
    rising: Real = parameter("1/s", default=1.0, min=0.0)
    falling: Real = parameter("1/s", default=lambda self: -self.rising, max=0.0)
    T_d: Real = parameter("s", default=1e-3, min=0.0)
    x: Real = variable("1")

    def equations(self) -> Equations:
        yield der(self.x) == fmax(fmin((self.u - self.x) / self.T_d, self.rising), self.falling)
        yield self.y == self.x

    def initial_equations(self) -> Equations:
        yield self.x == self.u


class Backlash(SISO):
    """Play: y stays while u moves within the gap ``b`` about it, and is pushed along at either end of it.

    The play operator (Krasnosel'skii and Pokrovskii 1989) with the lag ``T`` [s] of the pushed side:
    T der(y) = what u has passed the end by. Continuous: no event. State ``x``, at first ``y_start``.
    """

    _units = {"u": "{y}", "y": "{y}", "x": "{y}", "b": "{y}", "y_start": "{y}"}
    b: Real = parameter("1", min=0.0, description="full width of the gap")
    T: Real = parameter("s", default=1e-3, min=0.0)
    y_start: Real = parameter("1", default=0.0)
    x: Real = variable("1", start=lambda self: self.y_start, fixed=True)

    def equations(self) -> Equations:
        ahead = self.u - self.x
        yield self.T * der(self.x) == fmax(ahead - self.b / 2, 0) + fmin(ahead + self.b / 2, 0)
        yield self.y == self.x
