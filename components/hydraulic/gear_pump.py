"""Gear pump."""

from __future__ import annotations

from math import pi

from arthur_acausal import Component, Equations, Real, der, parameter, real_output, smooth_if_else, variable
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.ports import HydraulicPort
from arthur_acausal.components.rotational import Flange


class GearPump(Component):
    """A gear pump with the leakage of the ARTHuR report, section 5.2.

    port_a is the suction side, port_b the discharge. A turn displaces D of fluid at the density of the side
    that it comes from; what leaks back is n/RR_G + dp/R_G (5.13, 5.14, n in turns a second). The shaft's
    torque is c_L dp + b_p w (5.6, 5.19) beside the inertia's. State: ``w`` [rad/s]. ``q`` [m^3/s]: flow out
    of port_b.

    Losses: friction b_p w^2; leakage rho q_leak (h_b - h_a); compression, as fluid at suction density is
    let into the discharge: c_L w dp less what reaches the displaced fluid.

    Parameters: ``D`` [m^3 a turn], ``J`` [kg m^2] (see ``pump_scaling``), ``c_L`` [m^3] = D/(2 pi), Tables
    7 and 8. Valid for w >= 0 and dp >= 0: the leakage n/RR_G is not passive for dp < 0. Suction without
    cavitation.
    """

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    flange = Flange()
    fluid: Fluid = Fluid()
    D: Real = parameter("m^3", min=0.0, description="displacement a turn")
    c_L: Real = parameter(
        "m^3", default=lambda self: self.D / (2 * pi), description="torque constant, eq. 5.19"
    )
    R_G: Real = parameter("Pa*s/m^3", default=1e12, min=0.0, description="gear resistance")
    RR_G: Real = parameter("1/m^3", default=1e8, min=0.0, description="gear reluctance")
    b_p: Real = parameter("N*m*s/rad", default=1e-3, min=0.0, description="friction")
    J: Real = parameter("kg*m^2", default=1.182e-6, min=0.0, description="moment of inertia of both gears")
    q: Real = real_output("m^3/s", nominal=1e-4, display="L/min", description="flow delivered")
    w: Real = variable("rad/s", nominal=500.0, display="rpm", description="speed")
    dp: Real = variable("Pa", nominal=1e7, display="bar", description="pressure rise")
    q_displaced: Real = variable("m^3/s", nominal=1e-4, display="L/min", description="flow without leakage")
    q_leak: Real = variable("m^3/s", nominal=1e-5, display="L/min", description="leakage")
    P_friction: Real = real_output("W", description="power turned to heat by friction")
    P_leakage: Real = real_output("W", description="power turned to heat by leakage")
    P_compression: Real = real_output("W", description="power turned to heat as fluid enters the discharge")
    E_stored: Real = variable("J", description="kinetic energy")

    def equations(self) -> Equations:
        a, b, fluid = self.port_a, self.port_b, self.fluid
        turns = self.w / (2 * pi)
        yield self.w == der(self.flange.phi)
        yield self.dp == b.p - a.p
        intake = smooth_if_else(self.w >= 0, fluid.relative_volume(a.p), fluid.relative_volume(b.p))
        yield "displacement", self.q_displaced == self.D * turns / intake
        yield "leakage", self.q_leak == turns / self.RR_G + self.dp / self.R_G
        yield self.q == self.q_displaced - self.q_leak
        yield b.q == -self.q
        yield "mass balance", a.q + b.q == 0
        torque = self.b_p * self.w + self.c_L * self.dp
        yield "Newton's second law", self.J * der(self.w) == self.flange.tau - torque
        yield self.P_friction == self.b_p * self.w**2
        yield self.P_leakage == fluid.throttling_loss(self.q_leak, b.p, a.p)
        displaced = fluid.throttling_loss(self.q_displaced, b.p, a.p)
        yield "compression", self.P_compression == self.c_L * self.w * self.dp - displaced
        yield self.E_stored == self.J * self.w**2 / 2
