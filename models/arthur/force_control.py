"""Force control of a cylinder: its valve's current from the force that is asked for."""

from __future__ import annotations

from casadi import SX, fmax, fmin, sqrt

from arthur_acausal import (
    Component,
    Equations,
    Real,
    der,
    parameter,
    real_input,
    real_output,
    smooth_if_else,
    variable,
)
from arthur_acausal.components.hydraulic import Fluid

LAG = 2e-4
"""Lag that a lead leaves [s]; a lead of the same length is none."""


class ForceController(Component):
    """What the controllers of a cylinder's force share: what they measure, and the current ``I`` that they give.

    Inputs: ``F_d`` [N] the force asked for, ``F`` [N] the force of the rod (a load cell), ``v`` [m/s] the piston's
    velocity, positive extends, and the pressures ``p_s``, ``p_t``, ``p_A``, ``p_B`` [Pa] of supply, return and
    chambers. ``e`` [N] is the error, ``I`` [A] positive extends; what is beyond the valve's ``I_rated`` is ``excess``.
    ``q_supply`` [m^3/s] is the flow that the piston takes from the supply: A_A v or -A_B v.
    """

    F_d: Real = real_input("N", default=0.0, nominal=100.0, description="force asked for")
    F: Real = real_input("N", nominal=100.0, description="force of the rod")
    v: Real = real_input("m/s", nominal=0.1, description="velocity of the piston")
    p_s: Real = real_input("Pa", nominal=1e7, description="supply pressure")
    p_t: Real = real_input("Pa", nominal=1e5, description="return pressure")
    p_A: Real = real_input("Pa", nominal=1e7, description="pressure in chamber A")
    p_B: Real = real_input("Pa", nominal=1e7, description="pressure in chamber B")
    I: Real = real_output("A", nominal=0.1, description="current of the valve")
    I_rated: Real = parameter("A", default=1.0, min=0.0, description="of the valve")
    A_A: Real = parameter("m^2", default=7.13e-5, min=0.0, description="piston area, side A")
    A_B: Real = parameter("m^2", default=5.35e-5, min=0.0, description="annular area, side B")
    v_small: Real = parameter("m/s", default=5e-3, min=0.0, description="rounds the flow asked for")
    e: Real = variable("N", nominal=10.0, description="error of the force")
    q_supply: Real = real_output(
        "m^3/s", nominal=1e-5, display="L/min", description="flow asked of the supply"
    )
    excess: Real = variable("A", nominal=0.1, description="current asked for beyond the rated one")

    def equations(self) -> Equations:
        yield self.e == self.F_d - self.F
        yield self.excess == self.I - clamp(self.I, self.I_rated)
        # A_A v where it extends, -A_B v where it retracts
        speed = sqrt(self.v**2 + self.v_small**2) - self.v_small
        half = (self.A_A - self.A_B) / 2 * self.v + (self.A_A + self.A_B) / 2 * speed
        yield "flow of the supply", self.q_supply == half


class FeedForwardControl(ForceController):
    """PI control of the force with feed-forward of the piston's velocity through the inverse laws of valve and spool.

    The velocity that the flows shall give, u = k_v v + k_p (e + x), x' = e/T_i, becomes a current by the
    inverse of eq. 5.36 and 5.37 of the ARTHuR report: with u = v the current keeps the force, F' = 0, in a cylinder
    whose chambers have the same ratio of volume and area,

        I = (A_A + A_B) u_lead / (K_V sqrt(2/rho) (sqrt(dp_in) + sqrt(dp_out))),

    where dp_in and dp_out are the drops of the two open lands. The roots are limited below at ``dp_min``, smoothly,
    so that a chamber at supply pressure does not ask for an infinite current. u_lead is u ahead by the spool's lag,
    (1 + T_lead s)/(1 + T_lag s) u, with T_lead = 2 zeta/omega of the spool: an impact at the foot changes v at once,
    and each millisecond that the flow comes late costs 600 N for 0.1 m/s. States: ``x`` [N], drawn back by ``k_aw``
    times the current that the valve cannot follow, and ``u_lag`` [m/s].

    What the chambers' stiffness k makes of a velocity is F' = k (u - v), so the loop's crossing frequency is about
    k k_p. Parameters: assumed, as the report gives none. With the chambers of ARTHuR's cylinders at mid-stroke k is
    6e6 N/m; the loop then crosses at 200 Hz with a phase margin of 44 degrees: a spool of 250 Hz takes 72, the lead
    gives 34, the integral takes 8. Without the lead (T_lead = T_lag) the margin is 20 degrees.
    """

    fluid: Fluid = Fluid()
    K_V: Real = parameter("m^2/A", min=0.0, description="valve gain of eq. 5.35")
    k_v: Real = parameter("1", default=0.95, min=0.0, description="share of the velocity that is fed forward")
    k_p: Real = parameter("m/(s*N)", default=1.8e-4, min=0.0, description="proportional gain")
    T_lead: Real = parameter("s", default=8.9e-4, min=0.0, description="lag of the spool that is made good")
    T_lag: Real = parameter("s", default=LAG, min=0.0, description="lag that is left")
    T_i: Real = parameter("s", default=0.006, min=0.0, description="integral time")
    k_aw: Real = parameter("N/A", default=1e3, min=0.0, description="anti-windup")
    dp_min: Real = parameter("Pa", default=5e5, min=0.0, description="least pressure drop of the inverse law")
    u: Real = variable("m/s", nominal=0.1, description="velocity that the flows shall give")
    u_lag: Real = variable("m/s", start=0.0, nominal=0.1, description="u behind T_lag")
    u_lead: Real = variable("m/s", nominal=0.1, description="u ahead by the spool's lag")
    x: Real = variable("N", start=0.0, nominal=10.0, description="integral of the error over T_i")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.u == self.k_v * self.v + self.k_p * (self.e + self.x)
        yield "lag", self.T_lag * der(self.u_lag) == self.u - self.u_lag
        yield "lead", self.u_lead == self.u_lag + self.T_lead / self.T_lag * (self.u - self.u_lag)
        yield "integral", self.T_i * der(self.x) == self.e - self.k_aw * self.excess
        extend = self.root(self.p_s - self.p_A) + self.root(self.p_B - self.p_t)
        retract = self.root(self.p_A - self.p_t) + self.root(self.p_s - self.p_B)
        roots = smooth_if_else(self.u_lead > 0, extend, retract)
        gain = self.K_V * sqrt(2 / self.fluid.rho)
        yield "inverse valve law", self.I == (self.A_A + self.A_B) * self.u_lead / (gain * roots)

    def initial_equations(self) -> Equations:
        yield der(self.u_lag) == 0

    def root(self, dp: SX) -> SX:
        """Return the root [Pa^0.5] of ``dp``, limited smoothly to no less than ``dp_min``."""
        above = dp - self.dp_min
        return sqrt(self.dp_min + (above + sqrt(above**2 + self.dp_min**2)) / 2)


class BareControl(ForceController):
    """PID control of the force alone, as the report has it (section 8.1): I = k_p e + x + k_d e'.

    The derivative is that of the error behind a lag ``T_d``. States: ``x`` [A] with x' = k_i e, ``e_lag`` [N]. It does
    not follow the demand while the piston moves: the chambers' stiffness times its velocity is a disturbance of up to
    a MN/s. The report gives no gains: assumed, the fastest that stay well damped with a 250 Hz spool.
    """

    k_p: Real = parameter("A/N", default=5e-4, min=0.0, description="proportional gain")
    k_i: Real = parameter("A/(N*s)", default=1e-2, min=0.0, description="integral gain")
    k_d: Real = parameter("A*s/N", default=0.0, min=0.0, description="derivative gain")
    T_d: Real = parameter("s", default=1e-3, min=0.0, description="lag of the derivative")
    k_aw: Real = parameter("1/s", default=1e2, min=0.0, description="anti-windup")
    x: Real = variable("A", start=0.0, nominal=0.1, description="integral of k_i e")
    e_lag: Real = variable("N", start=0.0, nominal=10.0, description="error behind the lag")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "integral", der(self.x) == self.k_i * self.e - self.k_aw * self.excess
        yield "lag", self.T_d * der(self.e_lag) == self.e - self.e_lag
        yield "PID", self.I == self.k_p * self.e + self.x + self.k_d * der(self.e_lag)


def clamp(x: SX, limit: SX) -> SX:
    """Return ``x`` limited to +-``limit``."""
    return fmin(fmax(x, -limit), limit)
