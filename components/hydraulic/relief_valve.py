"""Relief valve."""

from __future__ import annotations

from math import pi
from typing import Literal

from casadi import SX, cos, fmax, sin, sqrt

from arthur_acausal import Equations, Real, parameter, smooth_if_else, variable
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.hydraulic.laws import clamp, turbulent_root
from arthur_acausal.components.hydraulic.two_port import TwoPort

ReliefLaw = Literal["orifice", "listing"]


class ReliefValve(TwoPort):
    """A spring-loaded conical poppet, without mass: ARTHuR report, section 5.4.

    port_a is the pressure side, port_b the return. The poppet's lift x = A_p (p_a - p_c)/k, from 0 to x_max
    (5.25, 5.27, 5.28: the preload as printed holds the return pressure too, so it cracks at the absolute
    pressure p_c); the open area of a cone (5.23), at most the bore's A_max (5.24); the flow of an orifice
    (5.22).

    ``law`` (structural): "orifice", the default; "listing" is the report's code (6.3.5): sqrt(2 p_a/rho) in
    place of the pressure drop, and no limit on the lift. In either the flow is continuous and makes no
    event.

    Parameters (Table 9): spring ``k`` [N/m], poppet diameter ``d_p`` [m], cone angle ``alpha`` [rad],
    ``C_d`` [1]; ``p_c`` [Pa] the cracking pressure, 3000 psi (assumed); ``A_leak`` [m^2]; ``dp_small`` [Pa]
    of the laminar transition.
    """

    law: ReliefLaw = "orifice"
    p_c: Real = parameter("Pa", default=20.68e6, display="bar", description="cracking pressure; assumed")
    k: Real = parameter("N/m", default=5.16e4, min=0.0, description="spring stiffness")
    d_p: Real = parameter("m", default=6.35e-3, min=0.0, description="poppet diameter")
    alpha: Real = parameter("rad", default=2 * pi / 3, description="cone angle")
    C_d: Real = parameter("1", default=0.78, min=0.0, description="discharge coefficient")
    A_leak: Real = parameter("m^2", default=0.0, min=0.0, description="leakage area when seated")
    dp_small: Real = parameter("Pa", default=1e4, min=0.0, description="laminar below about this drop")
    x: Real = variable("m", nominal=1e-5, description="lift of the poppet")
    A_o: Real = variable("m^2", nominal=1e-7, description="open area")

    def build(self) -> None:
        check_choice(self, "law", ReliefLaw)

    def lift(self, p: SX) -> SX:
        """Return the lift [m] that balances the pressure ``p`` [Pa], without limits: eq. 5.27."""
        return pi * self.d_p**2 / 4 * (p - self.p_c) / self.k

    def equations(self) -> Equations:
        yield from super().equations()
        half = self.alpha / 2
        x, C_d, rho = self.x, self.C_d, self.fluid.rho
        cone = pi * (self.d_p + x * sin(half) * cos(half)) * x * sin(half)
        yield "open area", self.A_o == cone + self.A_leak
        if self.law == "listing":
            p = fmax(self.port_a.p, self.p_c)
            yield "lift", self.x == self.lift(p)
            flow = self.A_o * C_d * sqrt(2 * p / rho)
            yield "orifice law", self.q == smooth_if_else(self.port_a.p > self.p_c, flow, 0)
        else:
            x_max = self.d_p / sin(self.alpha) * (sqrt(1 + cos(half)) - 1)
            yield "lift", self.x == clamp(self.lift(self.port_a.p), 0, x_max)
            yield (
                "orifice law",
                self.q == self.A_o * C_d * sqrt(2 / rho) * turbulent_root(self.dp, self.dp_small),
            )
