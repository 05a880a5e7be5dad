"""Continuous blocks, named as in the Modelica Standard Library (Blocks.Continuous)."""

from __future__ import annotations

from casadi import SX, fmax, fmin, logic_and, logic_or

from arthur_acausal import (
    Equations,
    Real,
    der,
    if_else,
    parameter,
    real_input,
    real_output,
    reinit,
    variable,
    when,
)
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


class ResetIntegrator(Integrator):
    """An integrator whose state becomes ``y_reset`` at the moment when the logical signal ``reset`` becomes true."""

    _units = {**Integrator._units, "y_reset": "{y}"}
    reset: Real = real_input("1", description="0 or 1")
    y_reset: Real = real_input("1", default=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield "reset", when(self.reset > 0.5, reinit(self.x, self.y_reset))


class LimIntegrator(SISO):
    """der(y) = k u while y stays within y_min..y_max; at a limit y waits until k u leads back. Events."""

    _units = {**Integrator._units, "y_max": "{y}", "y_min": "{y}"}
    k: Real = parameter("1/s", default=1.0)
    y_max: Real = parameter("1")
    y_min: Real = parameter("1", default=lambda self: -self.y_max)
    y_start: Real = parameter("1", default=0.0)
    x: Real = variable("1", start=lambda self: self.y_start, fixed=True)

    def equations(self) -> Equations:
        rate = self.k * self.u
        above = logic_and(self.x >= self.y_max, rate > 0)
        below = logic_and(self.x <= self.y_min, rate < 0)
        yield "integral", der(self.x) == if_else(logic_or(above, below), 0, rate)
        yield self.y == self.x


class Derivative(SISO):
    """y = k der(u filtered): T der(x) = u - x, y = k (u - x)/T. ``k`` [unit of y over u, times s], ``T`` [s].

    State: ``x``, at first u, so that y is 0.
    """

    _units = {"u": "{u}", "y": "{y}", "k": "({y})/({u})*s", "x": "{u}"}
    k: Real = parameter("s", default=1.0)
    T: Real = parameter("s", default=0.01, min=0.0)
    x: Real = variable("1")

    def equations(self) -> Equations:
        yield self.T * der(self.x) == self.u - self.x
        yield self.y == self.k * (self.u - self.x) / self.T

    def initial_equations(self) -> Equations:
        yield self.x == self.u


class Der(SISO):
    """y = k der(u): what u follows must be differentiable. ``k`` [unit of y over u, times s]."""

    _units = {"u": "{u}", "y": "{y}", "k": "({y})/({u})*s"}
    k: Real = parameter("s", default=1.0)

    def equations(self) -> Equations:
        yield self.y == self.k * der(self.u)


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


class PI(SISO):
    """y = k (u + integral(u)/T). ``T`` [s]. State: ``x`` = integral(u)/T, 0 at the start."""

    _units = {"u": "{u}", "y": "{y}", "k": "({y})/({u})", "x": "{u}"}
    k: Real = parameter("1", default=1.0)
    T: Real = parameter("s", min=0.0)
    x: Real = variable("1", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.u / self.T
        yield self.y == self.k * (self.x + self.u)


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


class LimPID(Block):
    """A P, PI, PD or PID controller with limited output, set-point weights and anti-windup.

    y = limit(k (wp u_s - u_m + I + D) + k_ff u_ff); der(I) = (u_s - u_m + (y - unlimited)/(k Ni))/T_i;
    D = T_d der(wd u_s - u_m) filtered by T_d/Nd. Astrom and Hagglund, PID Controllers (1995), ch. 3; the parameters
    are those of the Modelica Standard Library 4.1, Blocks.Continuous.LimPID.

    ``controller``: "P", "PI", "PD" or "PID". ``T_i``, ``T_d`` [s]. States: ``I`` (unit of u), 0 at the start, and
    ``x``, the filtered input of the derivative, so that D is 0 at the start. For a steady start give
    ``I=start(0.0, fixed=False)`` and the initial equation der(I) == 0.
    """

    controller: str = "PID"
    _units = {
        "u_s": "{u}",
        "u_m": "{u}",
        "u_ff": "{y}",
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
    u_ff: Real = real_input("1", default=0.0, description="feed-forward")
    y: Real = real_output("1")
    k: Real = parameter("1", default=1.0)
    T_i: Real = parameter("s", default=0.5, min=0.0)
    T_d: Real = parameter("s", default=0.1, min=0.0)
    y_max: Real = parameter("1")
    y_min: Real = parameter("1", default=lambda self: -self.y_max)
    wp: Real = parameter("1", default=1.0, min=0.0, description="set-point weight of the proportional part")
    wd: Real = parameter("1", default=0.0, min=0.0, description="set-point weight of the derivative part")
    Ni: Real = parameter("1", default=0.9, min=0.0, description="Ni T_i is the time constant of anti-windup")
    Nd: Real = parameter("1", default=10.0, min=0.0, description="T_d/Nd is that of the derivative's filter")
    k_ff: Real = parameter("1", default=1.0)
    I: Real = variable("1", start=0.0, fixed=True, description="integral part over k")
    x: Real = variable("1", description="filtered input of the derivative")
    raw: Real = variable("1", description="output without limits")

    def equations(self) -> Equations:
        u_d, integral = self.wd * self.u_s - self.u_m, "I" in self.controller
        held = (self.y - self.raw) / (self.k * self.Ni)
        yield "integral", der(self.I) == ((self.u_s - self.u_m + held) / self.T_i if integral else 0)
        yield "filter", self.T_d / self.Nd * der(self.x) == (u_d - self.x if "D" in self.controller else 0)
        D = self.Nd * (u_d - self.x) if "D" in self.controller else SX(0.0)
        inside = self.wp * self.u_s - self.u_m + self.I + D
        yield self.raw == self.k * inside + self.k_ff * self.u_ff
        yield "limit", self.y == fmin(fmax(self.raw, self.y_min), self.y_max)

    def initial_equations(self) -> Equations:
        yield self.x == self.wd * self.u_s - self.u_m
