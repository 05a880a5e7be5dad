"""The spool of a linear servo valve: geometry and loads (ARTHuR report, section 3.6)."""

from __future__ import annotations

from math import pi

from casadi import SX

from arthur_acausal import Component, Real, parameter
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.servo_valves.jets import JetAngle
from arthur_acausal.components.hydraulic.servo_valves.passages import Shape, open_area


class SpoolBody(Component):
    """What a linear valve's spool is and how it is loaded: Table 3, 3.47 to 3.60.

    Heads of the diameter ``d_H`` and the total length ``L_H``, shaft ``d_s``, ports of the width ``d_p``, radial
    clearance ``c_r``, chambers ``L`` long, each land overlapped by ``L_OL`` [m]. The geometry is a proxy, assumed: the
    report leaves the maker's out. ``C_c`` is 1, as 3.47 is printed and Table 3 has no C_v; C_d/C_v = 0.92 keeps the
    contraction.
    """

    shape: Shape = "square"
    jet_angle: JetAngle = "printed"
    fluid: Fluid = Fluid(rho=850.0, nu=22e-6)
    d_H: Real = parameter("m", default=3.175e-3, min=0.0, description="head diameter; assumed")
    d_s: Real = parameter("m", default=1.6e-3, min=0.0, description="shaft diameter; assumed")
    d_p: Real = parameter("m", default=0.762e-3, min=0.0, description="port width; assumed")
    c_r: Real = parameter("m", default=2.54e-6, min=0.0, description="radial clearance")
    L_H: Real = parameter("m", default=12e-3, min=0.0, description="length of all heads; assumed")
    L: Real = parameter("m", default=4e-3, min=0.0, description="between lands; assumed")
    L_OL: Real = parameter("m", default=10e-6, min=0.0, description="overlap of a land; assumed")
    L_spool: Real = parameter("m", default=20e-3, min=0.0, description="length of the spool; assumed")
    rho_c: Real = parameter("kg/m^3", default=2700.0, min=0.0, description="density of the spool")
    C_d: Real = parameter("1", default=0.9, min=0.0, description="discharge coefficient")
    C_c: Real = parameter("1", default=1.0, min=0.0, description="contraction coefficient")
    phi_error: Real = parameter("rad", default=0.0, description="deviation of the jet's angle")

    def build(self) -> None:
        check_choice(self, "shape", Shape)
        check_choice(self, "jet_angle", JetAngle)

    def area(self, s: SX) -> SX:
        """Return the open area [m^2] of a port at the opening ``s`` [1] of its width, 3.50."""
        return self.d_p**2 * open_area(self.shape, s)

    def mass(self) -> SX:
        """Return the spool's mass [kg]."""
        shaft = self.d_s**2 * (self.L_spool - self.L_H)
        return self.rho_c * pi / 4 * (self.d_H**2 * self.L_H + shaft)

    def leak_area(self) -> SX:
        """Return A_L [m^2], 3.51."""
        return pi * self.c_r * self.d_H

    def land_leakage(self, xi: SX) -> SX:
        """Return the laminar conductance [m^3/(s Pa)] of a closed land, 3.56 to 3.58; ``xi`` [m]: travel past L_OL."""
        return pi * self.d_H * self.c_r**3 / (12 * self.fluid.mu * (xi + 2 * self.L_OL))

    def drag(self, v: SX) -> SX:
        """Return the film's friction [N] on the heads at the speed ``v`` [m/s]: 3.59, first term."""
        return pi * self.d_H * self.fluid.mu * v / self.c_r * self.L_H

    def land_shear(self, dp: SX) -> SX:
        """Return the force [N] of a leakage flow on a land it passes, along the flow.

        3.59, second term, with the length that it lacks: pi d_H c_r dp/2, whatever the land's length.
        """
        return pi * self.d_H * self.c_r * dp / 2

    def transient_force(self, q_rate: SX) -> SX:
        """Return 3.49 [N] for the rate [m^3/s^2] of Q_S - Q_R."""
        return self.fluid.rho * self.L * q_rate
