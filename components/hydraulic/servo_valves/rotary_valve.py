"""Rotary servo valve with a mechanical flange."""

from __future__ import annotations

from typing import NamedTuple

from casadi import SX, fabs, fmax, sqrt

from arthur_acausal import Equations, Real, der, parameter, smooth_if_else, variable
from arthur_acausal.components.hydraulic.servo_valves.jets import (
    drop_factor,
    equal,
    jet_angle,
    jet_force,
    von_mises,
    with_sign,
)
from arthur_acausal.components.hydraulic.servo_valves.rotary_body import RotaryBody
from arthur_acausal.components.hydraulic.servo_valves.ways import Ways
from arthur_acausal.components.rotational import Flange

NARROW = 1e-3
"""Share of a port's area that rounds the ratio of two closed ports; a port so narrow passes next to nothing."""


class Passage(NamedTuple):
    """Both ends of the passages of one state: openings [1], and +1 where their jets close the valve, else -1."""

    inlet: SX
    inlet_side: SX
    outlet: SX
    outlet_side: SX


class RotaryValve(RotaryBody, Ways):
    """A four-way rotary valve that a shaft turns: ARTHuR report, section 3; geometry and options as `RotaryBody`.

    The angle of ``flange`` beyond the overlap opens P to A and B to T where positive (state 1), P to B and A to T
    where negative; each way through the cylinder has two orifices and a line: dp = 2 K_Q Q^2 + K_L Q (3.33 to 3.44),
    in either direction, made linear below the jet speed ``u_small`` [m/s]. With an ``offset`` the two orifices are
    not equal, and past its alignment a port closes again. Speeds are those in the inlets. Closed ports leak (a laminar
    slot over the overlap; ``leakage``: share of it, 1 or 0).

    ``tau`` [N m], positive against opening where it is a jet's: ``tau_jet`` closes (3.31, each orifice by its own
    flow), ``tau_viscous`` (3.18), ``tau_friction`` (3.24, 3.25; against the motion, sliding below ``w_small``
    [rad/s]), ``tau_inertia`` (3.20). They sum to the shaft's. Transient and shear forces in the passages are radial
    and small: not in the friction. Valid between the stops, which are not part of the valve: |angle| up to the
    overlap and one port.
    """

    flange = Flange()
    w_small: Real = parameter("rad/s", default=1e-3, min=0.0, description="slower is creeping, not friction")
    s_out: Real = variable("1", nominal=0.1, description="opening of the outlets; s: of the inlets")
    phi_out: Real = variable("rad", start=0.5, description="jet angle of 3.6, outlets")
    phi_jet_out: Real = variable("rad", start=0.5, description="jet angle, outlets")
    theta: Real = variable("rad", start=0.0, nominal=0.1, description="angle of the cylinder")
    w: Real = variable("rad/s", start=0.0, nominal=10.0, description="its speed")
    tau_jet: Real = variable("N*m", nominal=1e-3, description="of the jets, 3.31")
    tau_viscous: Real = variable("N*m", nominal=1e-3, description="of the film, 3.18")
    tau_friction: Real = variable("N*m", nominal=1e-3, description="of the radial force, 3.24")
    tau_inertia: Real = variable("N*m", nominal=1e-3, description="3.20")

    def passage(self, theta: SX) -> Passage:
        """Return how the passages are open that open with positive ``theta`` [rad]."""
        past = (theta - self.overlap()) * self.r_c / self.d_p - 1
        return Passage(*self.port(past - self.offset / 2), *self.port(past + self.offset / 2))

    def ratio(self, passage: Passage) -> SX:
        """Return the speed in the outlet over that in the inlet [1]: one flow passes both."""
        narrow = NARROW * self.area(SX(1))
        return (self.area(passage.inlet) + narrow) / (self.area(passage.outlet) + narrow)

    def drop(self, passage: Passage, u: SX, length: SX) -> SX:
        """Return the drop [Pa] of one way through the cylinder and its line at the inlet's speed ``u`` [m/s]."""
        rho, C_d = self.fluid.rho, self.C_d
        inlet = drop_factor(passage.inlet, rho, C_d) * with_sign(u, self.u_small)
        outlet = drop_factor(passage.outlet, rho, C_d) * with_sign(self.ratio(passage) * u, self.u_small)
        return inlet + outlet + self.line_drop(self.area(passage.inlet) * u, length)

    def equations(self) -> Equations:
        p, t, a, b = self.port_p, self.port_t, self.port_a, self.port_b
        plus, minus = self.passage(self.theta), self.passage(-self.theta)
        yield self.theta == self.flange.phi
        yield self.w == der(self.theta)
        yield self.s == plus.inlet + minus.inlet
        yield self.s_out == smooth_if_else(self.theta >= 0, plus.outlet, minus.outlet)
        yield "P to A", p.p - a.p == self.drop(plus, self.u_pa, self.L_A)
        yield "B to T", b.p - t.p == self.drop(plus, self.u_bt, self.L_B)
        yield "P to B", p.p - b.p == self.drop(minus, self.u_pb, self.L_B)
        yield "A to T", a.p - t.p == self.drop(minus, self.u_at, self.L_A)
        travel = fmax(fabs(self.theta), self.overlap()) - self.overlap()
        leak = self.land_leakage(travel * self.r_c / self.d_p)
        yield from self.flows(self.fluid, self.area(plus.inlet), self.area(minus.inlet), leak)
        yield from self._torques(plus, minus)

    def _torques(self, plus: Passage, minus: Passage) -> Equations:
        ratio = self.d_p / self.delta_r
        yield from self.direction(self.jet_angle, ratio, self.phi_error)
        yield "von Mises, outlets", equal(*von_mises(self.phi_out, self.s_out * ratio))
        yield self.phi_jet_out == jet_angle(self.s_out, self.phi_out, self.phi_half) + self.phi_error
        opened = self._closing(plus, self.u_pa) + self._closing(plus, self.u_bt)
        yield (
            "jets close",
            self.tau_jet == opened - self._closing(minus, self.u_pb) - self._closing(minus, self.u_at),
        )
        yield "film", self.tau_viscous == self.viscous_torque(der(self.w), self.w)
        friction = self.friction_torque(self._radial_force(plus, minus))
        yield "friction", self.tau_friction == friction * self.w / sqrt(self.w**2 + self.w_small**2)
        yield "inertia", self.tau_inertia == self.inertia() * der(self.w)
        loads = self.tau_jet + self.tau_viscous + self.tau_friction
        yield "balance of torques", self.flange.tau == self.tau_inertia + loads

    def _closing(self, passage: Passage, u: SX) -> SX:
        """The torque of a passage's two jets, at the inlet's speed, positive where it closes."""
        rho, u_out = self.fluid.rho, self.ratio(passage) * u
        inlet = jet_force(rho, self.area(passage.inlet), u, self.phi_jet, self.C_c)
        outlet = jet_force(rho, self.area(passage.outlet), u_out, self.phi_jet_out, self.C_c)
        return self.r_c * (passage.inlet_side * inlet + passage.outlet_side * outlet)

    def _radial_force(self, plus: Passage, minus: Passage) -> SX:
        """The force of 3.25 with the pressures at the cylinder: the lines' drops lie outside."""
        A_plus, A_minus = self.area(plus.inlet), self.area(minus.inlet)
        p_A = self.port_a.p + self.line_drop(A_plus * self.u_pa - A_minus * self.u_at, self.L_A)
        p_B = self.port_b.p - self.line_drop(A_plus * self.u_bt - A_minus * self.u_pb, self.L_B)
        dp_AB = smooth_if_else(self.theta >= 0, p_A - p_B, p_B - p_A)
        return self.radial_force(
            A_plus + A_minus, self.area(self.s_out), self.port_p.p - self.port_t.p, dp_AB
        )
