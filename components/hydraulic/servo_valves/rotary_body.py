"""The cylinder of a rotary servo valve: geometry and loads (ARTHuR report, sections 3.1 to 3.5)."""

from __future__ import annotations

from math import pi
from typing import Literal

from casadi import SX, asin, cos, fabs, fmax, fmin, sin, sqrt

from arthur_acausal import Component, Real, parameter, smooth_if_else
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.servo_valves.jets import JetAngle
from arthur_acausal.components.hydraulic.servo_valves.passages import Shape, open_area

PressureLoad = Literal["signed", "printed", "active only", "balanced"]
LineLaw = Literal["laminar", "turbulent"]


class RotaryBody(Component):
    """What a rotary valve's cylinder is and how it is loaded: Tables 1 and 2, 3.1 to 3.31.

    A cylinder of the radius ``r_c`` and height ``h`` [m] in a bore with the radial clearance ``delta_r`` [m]. Its
    passages have the width ``d_p`` [m] at the surface and the shape ``shape``; ``gap`` [rad] is the angle from edge
    to edge of adjacent passages of the body. ``L_A``, ``L_B`` [m]: the lines from the cylinder to the ports A and B.

    Structural options:

    - ``pressure_load``: the radial force of 3.25. "signed", the default: the inactive pair is orthogonal and swaps A
      and B, so F_c2 < 0 and enters as -F_c2 sin; "printed": + F_c2 sin; "active only": 3.23; "balanced": passages
      re-routed so that active and inactive ports oppose each other (end of 3.2.5).
    - ``jet_angle``: 3.7 "printed" or "continuous".
    - ``line``: 3.44 "laminar", or "turbulent" by Darcy and Blasius: at the case study's flow Re is about 1e4.

    C_d, C_v, L_A and L_B are assumed: the report lacks them. ``C_c`` = 1 leaves the contraction out, as 3.29 to 3.31
    are printed. ``phi_error`` [rad] is added to the jet's angle: what a rough passage (4.1.1) may do.

    ``offset`` [1] of the port's width: the inlet of each passage lags and the outlet leads by half of it, so that
    beyond the middle one jet opens (section 4.2's antagonistic spool, in series in each passage). 0: none.
    """

    shape: Shape = "square"
    pressure_load: PressureLoad = "signed"
    jet_angle: JetAngle = "printed"
    line: LineLaw = "laminar"
    fluid: Fluid = Fluid(rho=850.0, nu=22e-6)
    r_c: Real = parameter("m", default=3.81e-3, min=0.0, description="radius of the cylinder")
    h: Real = parameter("m", default=2.54e-3, min=0.0, description="height of the cylinder")
    d_p: Real = parameter("m", default=0.762e-3, min=0.0, description="width of a passage")
    delta_r: Real = parameter("m", default=12.7e-6, min=0.0, description="radial clearance")
    gap: Real = parameter("rad", default=12.5 * pi / 180, min=0.0, description="between adjacent passages")
    L_1: Real = parameter("m", default=1.27e-3, min=0.0, description="radial legs of a passage, each")
    L_2: Real = parameter("m", default=3.5814e-3, min=0.0, description="middle leg of a passage")
    L_A: Real = parameter("m", default=12.7e-3, min=0.0, description="line to A; assumed")
    L_B: Real = parameter("m", default=12.7e-3, min=0.0, description="line to B; assumed")
    rho_c: Real = parameter("kg/m^3", default=2700.0, min=0.0, description="density of the cylinder")
    mu_k: Real = parameter("1", default=0.05, min=0.0, description="friction coefficient, mixed film")
    mu_s: Real = parameter(
        "1", default=0.2, min=0.0, description="static friction, 0.1 to 0.3: of breakaway_torque only"
    )
    C_d: Real = parameter("1", default=0.9, min=0.0, description="discharge coefficient; assumed")
    C_v: Real = parameter("1", default=0.98, min=0.0, description="velocity coefficient; assumed")
    C_c: Real = parameter("1", default=lambda self: self.C_d / self.C_v, min=0.0, description="3.10")
    F_small: Real = parameter("N", default=1e-6, min=0.0, description="keeps the radial force smooth at 0")
    phi_error: Real = parameter("rad", default=0.0, description="deviation of the jet's angle")
    offset: Real = parameter("1", default=0.0, min=0.0, max=1.0, description="over the port's width")

    def build(self) -> None:
        check_choice(self, "shape", Shape)
        check_choice(self, "jet_angle", JetAngle)
        check_choice(self, "pressure_load", PressureLoad)
        check_choice(self, "line", LineLaw)

    # --- geometry

    def area(self, s: SX) -> SX:
        """Return the open area [m^2] of a port at the opening ``s`` [1] of its width."""
        return self.d_p**2 * open_area(self.shape, s)

    def port_angle(self) -> SX:
        """Return the angle [rad] that a passage takes at the surface."""
        return 2 * asin(self.d_p / (2 * self.r_c))

    def overlap(self) -> SX:
        """Return the angle [rad] from the middle to where a port begins to open, 0.51 deg."""
        return (self.gap - self.port_angle()) / 2

    def pitch(self) -> SX:
        """Return theta_pp [rad], the angle between adjacent ports, 23.98 deg."""
        return self.gap + self.port_angle()

    def port(self, past: SX) -> tuple[SX, SX]:
        """Return the opening [1] of a port ``past`` widths beyond alignment; +1 where its jet closes, else -1."""
        return fmin(fmax(1 - fabs(past), 0), 1), smooth_if_else(past > 0, -1, 1)

    # --- flow

    def line_drop(self, q: SX, length: SX) -> SX:
        """Return the drop [Pa] of a line to A or B, 3.44, or of a smooth turbulent one (Blasius 1913)."""
        d = self.d_p
        if self.line == "laminar":
            return 128 * self.fluid.mu * length / (pi * d**4) * q
        reynolds = 4 * q / (pi * d * self.fluid.nu)
        friction = 0.3164 * (reynolds**2 + 1) ** (
            3 / 8
        )  # f Re, regular at q = 0: Blasius' law is for Re above 3e3
        return friction * self.fluid.nu / d * length / d * self.fluid.rho / 2 * 4 * q / (pi * d**2)

    def land_leakage(self, s: SX) -> SX:
        """Return the laminar conductance [m^3/(s Pa)] of a closed port at the travel ``s`` [1] beyond the overlap.

        A slot of the height delta_r, as wide as a pair of passages, two overlaps and the travel long.
        """
        length = self.r_c * 2 * self.overlap() + fmin(s, 1) * self.d_p
        return 2 * self.d_p * self.delta_r**3 / (12 * self.fluid.mu * length)

    # --- loads

    def inertia(self) -> SX:
        """Return I [kg m^2] of the solid cylinder, 3.21."""
        return pi / 2 * self.rho_c * self.r_c**4 * self.h

    def viscous_torque(self, alpha: SX, w: SX) -> SX:
        """Return the torque [N m] that the film in the clearance asks for.

        pi r^3 h (rho delta/2 alpha + 2 mu/delta w): 3.18, where the speed is alpha t_res/2 when the acceleration ends.
        """
        film = self.fluid.rho * self.delta_r / 2
        return pi * self.r_c**3 * self.h * (film * alpha + 2 * self.fluid.mu / self.delta_r * w)

    def radial_force(self, A_1: SX, A_2: SX, dp_SR: SX, dp_AB: SX) -> SX:
        """Return the net radial force [N] of the pressures, 3.23 or 3.25; A_1, A_2 [m^2]: open at S and R, A and B."""
        A_p = self.area(SX(1))
        active_1, active_2 = (A_p - A_1) * dp_SR, (A_p - A_2) * dp_AB
        closed_1, closed_2 = A_p * dp_SR, -A_p * dp_AB  # A and B swap in the inactive pair
        c, s = cos(self.pitch()), sin(self.pitch())
        if self.pressure_load == "active only":
            x, y = active_1, active_2
        elif self.pressure_load == "balanced":
            x, y = active_1 - closed_1, active_2 + closed_2
        else:
            sign = -1 if self.pressure_load == "signed" else 1
            x = active_1 + closed_1 * c + sign * closed_2 * s
            y = active_2 + closed_1 * s + closed_2 * c
        return sqrt(x**2 + y**2 + self.F_small**2)

    def friction_torque(self, force: SX) -> SX:
        """Return mu_k r_c F [N m], 3.24."""
        return self.mu_k * self.r_c * force

    def breakaway_torque(self, dp_SR: SX, dp_AB: SX) -> SX:
        """Return the torque [N m] that friction can hold while all ports are closed, 3.4 and 3.5."""
        return self.mu_s * self.r_c * self.area(SX(1)) * sqrt(dp_SR**2 + dp_AB**2)

    def transient_force(self, q_rate: SX) -> SX:
        """Return the magnitude [N] of 3.12, radial, for the flow's rate of change [m^3/s^2]."""
        return 2 * self.fluid.rho * q_rate * (sqrt(2) * self.L_1 + self.L_2)

    def passage_shear(self, q: SX) -> SX:
        """Return the force [N] of the wall's friction in both passages, radial: 3.15 and 3.16 mended.

        (pi/4) d^2 dp_f (sqrt2 L_1 + L_2)/(2 L_1 + L_2) each, dp_f of the turbulent or laminar law.
        """
        length = 2 * self.L_1 + self.L_2
        drop = self.line_drop(q, length)
        return 2 * pi / 4 * self.d_p**2 * drop * (sqrt(2) * self.L_1 + self.L_2) / length
