"""The valves of the ARTHuR report's case studies, opened step by step: loads and work over the opening (3.5, 3.6.3)."""

from __future__ import annotations

from typing import Literal

from casadi import SX, fmax, sqrt

from arthur_acausal import Equations, Real, der, parameter, time, variable
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.hydraulic.servo_valves import RotaryBody, SpoolBody
from arthur_acausal.components.hydraulic.servo_valves.jets import (
    drop_factor,
    equal,
    half_angle,
    jet_angle,
    jet_force,
    von_mises,
)

PSI = 6894.757293168
GPM = 3.785411784e-3 / 60
TINY = 1e-9
"""Share of a port's area that keeps the ratio of two closed ports determined."""

SpoolFlow = Literal["limited", "constant"]


class RotaryStroke(RotaryBody):
    """A rotary valve at every opening ``s`` = xi/d_p, which grows from 0 to 1 in one second of the model's time.

    Each row is a motion of its own, from closed to ``s`` within ``t_res`` [s], half of it accelerating (3.19): so
    alpha = 4 dtheta/t_res^2 and the speed when it is highest is 2 dtheta/t_res, with dtheta the overlap and xi/r_c. The
    load takes two thirds of the supply's pressure (3.45) through a cylinder of the area ratio ``AR`` (3.28). Works
    [J] are the torques integrated over the angle from s = 0.
    """

    p_S: Real = parameter("Pa", default=2900 * PSI, display="bar")
    p_R: Real = parameter("Pa", default=14.5 * PSI, display="bar")
    t_res: Real = parameter("s", default=3e-3, min=0.0, description="response time")
    AR: Real = parameter("1", default=0.25, description="rod area over bore area; assumed")
    duration: Real = parameter("s", default=1.0, min=0.0, description="of the model's time")
    s: Real = variable("1")
    s_1: Real = variable("1", description="opening of the inlets")
    s_2: Real = variable("1", description="opening of the outlets")
    phi_1: Real = variable("rad", start=0.5, description="jet angle of 3.6, inlets")
    phi_2: Real = variable("rad", start=0.5, description="jet angle of 3.6, outlets")
    phi_half: Real = variable("rad", start=1.2, description="where 3.7 begins")
    phi_jet_1: Real = variable("rad", start=0.5, description="jet angle, inlets")
    phi_jet_2: Real = variable("rad", start=0.5, description="jet angle, outlets")
    u_1: Real = variable("m/s", start=100.0, nominal=100.0, description="speed in the inlets, Q_A/A_1")
    u_2: Real = variable("m/s", start=100.0, nominal=100.0, description="speed in the outlets")
    Q_A: Real = variable("m^3/s", nominal=1e-5, display="L/min")
    Q_leak: Real = variable("m^3/s", nominal=1e-6, display="L/min", description="from P to R in the middle")
    F_radial: Real = variable("N", nominal=10.0, description="of the pressures, 3.25")
    F_transient: Real = variable(
        "N", description="3.12, Q_A coming within t_res; radial, not in the friction"
    )
    F_shear: Real = variable(
        "N", description="of the passages' walls, 3.15, 3.16; radial, not in the friction"
    )
    T_breakaway: Real = variable("N*m", nominal=1e-3, description="static friction of the closed valve, 3.5")
    T_friction: Real = variable("N*m", nominal=1e-3)
    T_viscous: Real = variable("N*m", nominal=1e-3)
    T_inertia: Real = variable("N*m", nominal=1e-3)
    T_jet: Real = variable("N*m", nominal=1e-3, description="positive closes")
    W_friction: Real = variable("J", start=0.0, fixed=True, nominal=1e-4)
    W_viscous: Real = variable("J", start=0.0, fixed=True, nominal=1e-4)
    W_inertia: Real = variable("J", start=0.0, fixed=True, nominal=1e-4)
    W_jet: Real = variable("J", start=0.0, fixed=True, nominal=1e-4)
    W_no_jet: Real = variable("J", nominal=1e-4)
    W_with_jet: Real = variable("J", nominal=1e-4)

    def equations(self) -> Equations:
        g = 1 - self.AR
        (s_1, side_1), (s_2, side_2) = (
            self.port(self.s - 1 + lead) for lead in (-self.offset / 2, self.offset / 2)
        )
        A_1, A_2 = self.area(s_1), self.area(s_2)
        yield self.s == time() / self.duration
        yield self.s_1 == s_1
        yield self.s_2 == s_2
        ratio = self.d_p / self.delta_r
        yield "von Mises, inlets", equal(*von_mises(self.phi_1, s_1 * ratio))
        yield "von Mises, outlets", equal(*von_mises(self.phi_2, s_2 * ratio))
        yield from half_angle(self.jet_angle, self.phi_half, ratio)
        yield self.phi_jet_1 == jet_angle(s_1, self.phi_1, self.phi_half) + self.phi_error
        yield self.phi_jet_2 == jet_angle(s_2, self.phi_2, self.phi_half) + self.phi_error
        rho, A_p = self.fluid.rho, self.area(SX(1))
        orifices = (
            drop_factor(s_1, rho, self.C_d) * self.u_1**2 + drop_factor(s_2, rho, self.C_d) * self.u_2**2
        )
        yield self.Q_A == A_1 * self.u_1
        yield "one flow", self.u_2 * (A_2 + TINY * A_p) == self.u_1 * (A_1 + TINY * A_p)
        lines = self.line_drop(self.Q_A, self.L_A) + self.line_drop(g * self.Q_A, self.L_B)
        dp_SR = self.p_S - self.p_R
        yield "two thirds at the load", (1 + g**2) * orifices + lines == dp_SR / 3
        dp_AB = dp_SR - (1 + g**2) * orifices
        dtheta = self.overlap() + self.s * self.d_p / self.r_c
        alpha, w = 4 * dtheta / self.t_res**2, 2 * dtheta / self.t_res
        yield "leakage in the middle", self.Q_leak == self.land_leakage(SX(0)) * dp_SR
        yield self.F_radial == self.radial_force(A_1, A_2, dp_SR, dp_AB)
        yield "friction", self.T_friction == self.friction_torque(self.F_radial)
        yield "transient", self.F_transient == self.transient_force(self.Q_A / self.t_res)
        yield "passages", self.F_shear == self.passage_shear(self.Q_A)
        yield "breakaway", self.T_breakaway == self.breakaway_torque(dp_SR, dp_AB)
        yield "film", self.T_viscous == self.viscous_torque(alpha, w)
        yield "inertia", self.T_inertia == self.inertia() * alpha
        jets = side_1 * jet_force(rho, A_1, self.u_1, self.phi_jet_1, self.C_c)
        jets += side_2 * jet_force(rho, A_2, self.u_2, self.phi_jet_2, self.C_c)
        yield "jets", self.T_jet == self.r_c * (1 + g**2) * jets
        rate = self.d_p / self.r_c / self.duration
        yield der(self.W_friction) == self.T_friction * rate
        yield der(self.W_viscous) == self.T_viscous * rate
        yield der(self.W_inertia) == self.T_inertia * rate
        yield der(self.W_jet) == self.T_jet * rate
        yield self.W_no_jet == self.W_friction + self.W_viscous + self.W_inertia
        yield self.W_with_jet == self.W_no_jet + self.W_jet


class SpoolStroke(SpoolBody):
    """A spool valve at every opening ``s`` = xi/d_p, which grows from 0 to 1 in one second of the model's time.

    Each row is a motion from the middle to ``s`` within ``t_res`` [s], half of it accelerating; the stroke is the
    overlap and xi. ``flow``: "limited", the default, is Q_S = min(Q_set, what the supply's pressure, less the load's
    share of it, drives through both orifices); "constant" (3.6.3) needs more than that below about 0.34 of the
    opening, and begins at ``s_start``. Q_R = (1 - AR) Q_S. The work [J] is that of steady force, film and inertia over
    the stroke from s = 0.
    """

    flow: SpoolFlow = "limited"
    p_S: Real = parameter("Pa", default=2900 * PSI, display="bar")
    p_R: Real = parameter("Pa", default=14.5 * PSI, display="bar")
    t_res: Real = parameter("s", default=3e-3, min=0.0, description="response time")
    AR: Real = parameter("1", default=0.25, description="rod area over bore area; assumed")
    Q_set: Real = parameter("m^3/s", default=0.5 * GPM, min=0.0, display="L/min")
    load_share: Real = parameter(
        "1", default=0.0, min=0.0, max=0.99, description="of the pressure, at the load"
    )
    duration: Real = parameter("s", default=1.0, min=0.0, description="of the model's time")
    s_start: Real = parameter("1", default=0.01, min=0.0, description="where a constant flow begins")
    s: Real = variable("1")
    phi: Real = variable("rad", start=0.5, description="jet angle of 3.6")
    phi_half: Real = variable("rad", start=1.2, description="where 3.7 begins")
    phi_jet: Real = variable("rad", start=0.5, description="jet angle")
    u: Real = variable("m/s", start=100.0, nominal=100.0, description="Q_S/A_o")
    Q_S: Real = variable("m^3/s", nominal=1e-5, display="L/min")
    Q_leak: Real = variable("m^3/s", nominal=1e-6, display="L/min", description="from P to R in the middle")
    p_needed: Real = variable("Pa", nominal=1e7, display="bar", description="of both orifices")
    F_steady: Real = variable("N", description="3.48")
    F_friction: Real = variable("N", description="3.59, first term")
    F_shear: Real = variable("N", description="3.59, second term, on both closed lands; not in the work")
    F_inertia: Real = variable("N", description="mass times 4 stroke/t_res^2")
    W_steady: Real = variable("J", start=0.0, fixed=True, nominal=1e-4)
    W_friction: Real = variable("J", start=0.0, fixed=True, nominal=1e-4)
    W_inertia: Real = variable("J", start=0.0, fixed=True, nominal=1e-4)
    W: Real = variable("J", nominal=1e-4)

    def build(self) -> None:
        super().build()
        check_choice(self, "flow", SpoolFlow)

    def speed(self, A: SX, g: SX, kappa: SX) -> SX:
        """Return the jets' speed [m/s]."""
        if self.flow == "constant":
            return self.Q_set / A
        # 1/u^2 of the two limits; neither is zero where the other one is.
        return 1 / sqrt(
            fmax((1 + g**2) * kappa / ((1 - self.load_share) * (self.p_S - self.p_R)), (A / self.Q_set) ** 2)
        )

    def equations(self) -> Equations:
        rho, g, xi = self.fluid.rho, 1 - self.AR, self.s * self.d_p
        begin = self.s_start if self.flow == "constant" else 0
        yield self.s == begin + (1 - begin) * time() / self.duration
        ratio = self.d_p / self.c_r
        yield "von Mises", equal(*von_mises(self.phi, self.s * ratio))
        yield from half_angle(self.jet_angle, self.phi_half, ratio)
        yield self.phi_jet == jet_angle(self.s, self.phi, self.phi_half) + self.phi_error
        A, kappa = self.area(self.s), drop_factor(self.s, rho, self.C_d)
        yield self.u == self.speed(A, g, kappa)
        yield self.Q_S == A * self.u
        yield self.p_needed == (1 + g**2) * kappa * self.u**2
        stroke = self.L_OL + xi
        p_1, p_2 = self.p_S - kappa * self.u**2, self.p_R + kappa * (g * self.u) ** 2
        leak = self.land_leakage(xi)
        # The film that the spool drags along carries leakage too (Couette, 3.56, 3.57).
        dragged = self.leak_area() / 2 * 2 * stroke / self.t_res
        leaks = (leak * (p_1 - self.p_R) + dragged) ** 2 + (-leak * (self.p_S - p_2) + dragged) ** 2
        jets = (1 + g**2) * jet_force(rho, A, self.u, self.phi_jet, self.C_c)
        yield "steady force", self.F_steady == jets + rho / self.leak_area() * leaks
        yield "leakage in the middle", self.Q_leak == self.land_leakage(SX(0)) * (self.p_S - self.p_R)
        yield "film", self.F_friction == self.drag(2 * stroke / self.t_res)
        yield "leakage's shear", self.F_shear == self.land_shear((p_1 - self.p_R) - (self.p_S - p_2))
        yield "inertia", self.F_inertia == self.mass() * 4 * stroke / self.t_res**2
        rate = self.d_p * (1 - begin) / self.duration
        yield der(self.W_steady) == self.F_steady * rate
        yield der(self.W_friction) == self.F_friction * rate
        yield der(self.W_inertia) == self.F_inertia * rate
        yield self.W == self.W_steady + self.W_friction + self.W_inertia
