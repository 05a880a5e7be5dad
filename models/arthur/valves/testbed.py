"""The testbed of section 4.2: an oversized rotary spool at 500 psi, and the torque that it would measure."""

from __future__ import annotations

from typing import Literal

from casadi import SX

from arthur_acausal import Equations, Real, parameter, time, variable
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.hydraulic.servo_valves import RotaryBody
from arthur_acausal.components.hydraulic.servo_valves.jets import (
    drop_factor,
    equal,
    half_angle,
    jet_angle,
    jet_force,
    von_mises,
)
from arthur_acausal.models.arthur.valves.strokes import PSI, TINY

Spool = Literal["single", "double", "antagonistic"]


class Testbed(RotaryBody):
    """A one-sided spool, one passage from the supply to port A, turned slowly past its port and out again.

    ``z`` [1], the position over the port's width, goes from -1.2 over 0, aligned, to 1.2 in one second of the model's
    time. ``spool``: "single", one narrow port, the other one wide, without a jet; "double", two narrow ports in line;
    "antagonistic", two that are closer together than the housing's by ``offset`` [1] of the width, so that the one is
    past its port before the other one reaches it. A is open to the return, so the whole pressure drives the flow.

    ``T_jet`` [N m] is positive against positive motion. The transducer sees ``T_forward`` turning forward and
    ``T_back`` turning back: their mean is the jets' torque, half of their difference is friction, so that both can be
    told apart. Friction is that of one pair of ports; the seal's is left out, and the thrust bearing's is small.
    The spool is oversized: three times the case study's, assumed. The house is the shape that 4.1.2 chose.
    """

    spool: Spool = "double"
    p_S: Real = parameter("Pa", default=500 * PSI, display="bar")
    p_R: Real = parameter("Pa", default=14.5 * PSI, display="bar")
    scale: Real = parameter("1", default=3.0, min=0.0, description="over the case study's; assumed")
    offset: Real = parameter("1", default=0.5, min=0.0, max=1.0, description="assumed")
    duration: Real = parameter("s", default=1.0, min=0.0, description="of the model's time")
    z: Real = variable("1")
    phi_1: Real = variable("rad", start=0.5, description="3.6, first port")
    phi_2: Real = variable("rad", start=0.5, description="3.6, second port")
    phi_half: Real = variable("rad", start=1.2, description="where 3.7 begins")
    u_1: Real = variable("m/s", start=100.0, nominal=100.0)
    u_2: Real = variable("m/s", start=100.0, nominal=100.0)
    Q: Real = variable("m^3/s", nominal=1e-5, display="L/min")
    T_jet: Real = variable("N*m", nominal=1e-3, description="positive against positive motion")
    T_friction: Real = variable("N*m", nominal=1e-3, description="against any motion")
    T_forward: Real = variable("N*m", nominal=1e-3, description="at the transducer, turning forward")
    T_back: Real = variable("N*m", nominal=1e-3, description="at the transducer, turning back")

    __test__ = False  # pytest takes the name for a test

    def build(self) -> None:
        super().build()
        check_choice(self, "spool", Spool)

    def equations(self) -> Equations:
        lead = self.offset / 2 if self.spool == "antagonistic" else 0
        (s_1, side_1), (s_2, side_2) = self.port(self.z - lead), self.port(self.z + lead)
        rho, size = self.fluid.rho, self.scale**2
        A_1, A_2 = size * self.area(s_1), size * self.area(s_2)
        A_p, ratio = size * self.area(SX(1)), self.d_p / self.delta_r
        yield self.z == 1.2 * (2 * time() / self.duration - 1)
        yield "von Mises, first port", equal(*von_mises(self.phi_1, s_1 * ratio * self.scale))
        yield "von Mises, second port", equal(*von_mises(self.phi_2, s_2 * ratio * self.scale))
        yield from half_angle(self.jet_angle, self.phi_half, ratio * self.scale)
        dp = self.p_S - self.p_R
        first = drop_factor(s_1, rho, self.C_d) * self.u_1**2
        # The bed's fittings keep the speed finite where a port is wide open.
        second = (
            rho / 2 * self.u_2**2
            if self.spool == "single"
            else (drop_factor(s_2, rho, self.C_d) * self.u_2**2)
        )
        yield "all of the pressure", first + second + self.fittings(A_1, A_p) == dp
        wide = A_p if self.spool == "single" else A_2
        yield "one flow", self.u_2 * (wide + TINY * A_p) == self.u_1 * (A_1 + TINY * A_p)
        yield self.Q == A_1 * self.u_1
        angle_1 = jet_angle(s_1, self.phi_1, self.phi_half)
        angle_2 = jet_angle(s_2, self.phi_2, self.phi_half)
        jets = side_1 * jet_force(rho, A_1, self.u_1, angle_1, self.C_c)
        if self.spool != "single":
            jets += side_2 * jet_force(rho, A_2, self.u_2, angle_2, self.C_c)
        yield "jets", self.T_jet == self.scale * self.r_c * jets
        yield "friction", self.T_friction == self.mu_k * self.scale * self.r_c * (A_p - A_1) * dp
        yield self.T_forward == self.T_jet + self.T_friction
        yield self.T_back == self.T_jet - self.T_friction

    def fittings(self, A_1: SX, A_p: SX) -> SX:
        """Return the drop [Pa] of the housing's way, one velocity head in the whole passage."""
        return self.fluid.rho / 2 * (A_1 / A_p * self.u_1) ** 2
