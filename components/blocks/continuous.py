"""Continuous blocks, named as in the Modelica Standard Library (Blocks.Continuous)."""

from __future__ import annotations

from casadi import fmax, fmin

from arthur_acausal import Equations, Real, der, parameter, real_input, real_output, variable
from arthur_acausal.components.blocks.signal import SISO, Block


class Integrator(SISO):
    """der(y) = k u. ``k`` [unit of y over (unit of u times s)]. State: ``y``, at first ``y_start``."""

    _units = {"u": "{u}", "y": "{y}", "k": "({y})/({u})/s", "x": "{y}", "y_start": "{y}"}
    k: Real = parameter("1/s", default=1.0)
    y_start: Real = parameter("1", default=0.0)
    x: Real = variable("1", start=lambda self: self.y_start, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.k * self.u
        yield self.y == self.x


class FirstOrder(SISO):
    """T der(y) + y = k u. ``T`` [s]. State: ``y``, at first ``y_start``."""

    _units = {"u": "{u}", "y": "{y}", "k": "({y})/({u})", "x": "{y}", "y_start": "{y}"}
    k: Real = parameter("1", default=1.0)
    T: Real = parameter("s", min=0.0)
    y_start: Real = parameter("1", default=0.0)
    x: Real = variable("1", start=lambda self: self.y_start, fixed=True)

    def equations(self) -> Equations:
        yield self.T * der(self.x) + self.x == self.k * self.u
        yield self.y == self.x


class SecondOrder(SISO):
    """der(der(y))/w^2 + 2 D/w der(y) + y = k u.

    ``w`` [rad/s], damping ratio ``D`` [1]. States: ``y`` and its rate ``v``.
    """

    _units = {"u": "{u}", "y": "{y}", "k": "({y})/({u})", "x": "{y}", "v": "({y})/s", "y_start": "{y}"}
    k: Real = parameter("1", default=1.0)
    w: Real = parameter("rad/s", min=0.0)
    D: Real = parameter("1", default=0.7, min=0.0)
    y_start: Real = parameter("1", default=0.0)
    x: Real = variable("1", start=lambda self: self.y_start, fixed=True)
    v: Real = variable("1/s", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield self.v == der(self.x)
        yield der(self.v) == self.w**2 * (self.k * self.u - self.x) - 2 * self.D * self.w * self.v
        yield self.y == self.x


class PID(Block):
    """y = k (e + 1/T_i integral(e) + T_d der(e filtered)), e = u_s - u_m, limited to y_min..y_max.

    The derivative is filtered by T_d/N_d; the integrator is held back by the limits through the tracking
    time ``T_t`` (Astrom and Hagglund, PID Controllers, 1995, sec. 3.5). ``T_i``, ``T_d``, ``T_t`` [s].
    States: ``I`` (in the unit of u), ``x`` (filtered error).
    """

    _units = {
        "u_s": "{u}",
        "u_m": "{u}",
        "y": "{y}",
        "k": "({y})/({u})",
        "y_min": "{y}",
        "y_max": "{y}",
        "I": "{u}",
        "x": "{u}",
        "raw": "{y}",
    }
    u_s: Real = real_input("1", description="set point")
    u_m: Real = real_input("1", description="measurement")
    y: Real = real_output("1")
    k: Real = parameter("1", default=1.0)
    T_i: Real = parameter("s", default=1.0, min=0.0)
    T_d: Real = parameter("s", default=0.1, min=0.0)
    N_d: Real = parameter("1", default=10.0, min=0.0)
    T_t: Real = parameter("s", default=lambda self: self.T_i)
    y_max: Real = parameter("1", default=1e30)
    y_min: Real = parameter("1", default=-1e30)
    I: Real = variable("1", start=0.0, fixed=True)
    x: Real = variable("1", start=0.0, fixed=True)
    raw: Real = variable("1", description="output without limits")

    def equations(self) -> Equations:
        e = self.u_s - self.u_m
        filtered = (e - self.x) / (self.T_d / self.N_d)
        yield der(self.x) == filtered
        yield self.raw == self.k * (e + self.I + self.T_d * filtered)
        yield self.y == fmin(fmax(self.raw, self.y_min), self.y_max)
        yield der(self.I) == e / self.T_i + (self.y - self.raw) / (self.k * self.T_t)
