"""Rotary servo valve with a mechanical flange."""

from __future__ import annotations

from casadi import SX, fabs, fmax, fmin, sqrt

from arthur_acausal import Equations, Real, der, parameter, smooth_if_else, variable
from arthur_acausal.components.hydraulic.servo_valves.jets import (
    drop_factor,
    jet_force,
    with_sign,
)
from arthur_acausal.components.hydraulic.servo_valves.rotary_body import RotaryBody
from arthur_acausal.components.hydraulic.servo_valves.ways import Ways
from arthur_acausal.components.rotational import Flange


class RotaryValve(RotaryBody, Ways):
    """A four-way rotary valve that a shaft turns: ARTHuR report, section 3; geometry and options as `RotaryBody`.

    The angle of ``flange`` beyond the overlap opens P to A and B to T where positive (state 1), P to B and A to T
    where negative; each way through the cylinder has two equal orifices and a line: dp = 2 K_Q Q^2 + K_L Q (3.33 to
    3.44), in either direction, made linear below the jet speed ``u_small`` [m/s]. Closed ports leak (a laminar slot
    over the overlap; ``leakage``: share of it, 1 or 0).

    ``tau`` [N m], positive against opening where it is a jet's: ``tau_jet`` closes (3.31, each orifice by its own
    flow), ``tau_viscous`` (3.18), ``tau_friction`` (3.24, 3.25; against the motion, sliding below ``w_small``
    [rad/s]), ``tau_inertia`` (3.20). They sum to the shaft's. Transient and shear forces in the passages are radial
    and small: not in the friction. Valid between the stops, which are not part of the valve: |angle| up to the
    overlap and one port.
    """

    flange = Flange()
    w_small: Real = parameter("rad/s", default=1e-3, min=0.0, description="slower is creeping, not friction")
    theta: Real = variable("rad", start=0.0, nominal=0.1, description="angle of the cylinder")
    w: Real = variable("rad/s", start=0.0, nominal=10.0, description="its speed")
    tau_jet: Real = variable("N*m", nominal=1e-3, description="of the jets, 3.31")
    tau_viscous: Real = variable("N*m", nominal=1e-3, description="of the film, 3.18")
    tau_friction: Real = variable("N*m", nominal=1e-3, description="of the radial force, 3.24")
    tau_inertia: Real = variable("N*m", nominal=1e-3, description="3.20")

    def opening(self, theta: SX) -> SX:
        """Return the open share [1] of the ports that open with positive ``theta`` [rad]."""
        return fmin(fmax((theta - self.overlap()) * self.r_c / self.d_p, 0), 1)

    def drop(self, s: SX, u: SX, length: SX) -> SX:
        """Return the drop [Pa] of one way through the cylinder and its line at the orifices' speed ``u`` [m/s]."""
        orifices = 2 * drop_factor(s, self.fluid.rho, self.C_d) * with_sign(u, self.u_small)
        return orifices + self.line_drop(self.area(s) * u, length)

    def equations(self) -> Equations:
        p, t, a, b = self.port_p, self.port_t, self.port_a, self.port_b
        plus, minus = self.opening(self.theta), self.opening(-self.theta)
        yield self.theta == self.flange.phi
        yield self.w == der(self.theta)
        yield self.s == plus + minus
        yield "P to A", p.p - a.p == self.drop(plus, self.u_pa, self.L_A)
        yield "B to T", b.p - t.p == self.drop(plus, self.u_bt, self.L_B)
        yield "P to B", p.p - b.p == self.drop(minus, self.u_pb, self.L_B)
        yield "A to T", a.p - t.p == self.drop(minus, self.u_at, self.L_A)
        A_plus, A_minus = self.area(plus), self.area(minus)
        travel = fmax(fabs(self.theta), self.overlap()) - self.overlap()
        leak = self.land_leakage(travel * self.r_c / self.d_p)
        yield from self.flows(self.fluid, A_plus, A_minus, leak)
        yield from self._torques(A_plus, A_minus)

    def _torques(self, A_plus: SX, A_minus: SX) -> Equations:
        ratio = self.d_p / self.delta_r
        yield from self.direction(self.jet_angle, ratio, self.phi_error)

        def jet(area: SX, u: SX) -> SX:
            return 2 * self.r_c * jet_force(self.fluid.rho, area, u, self.phi_jet, self.C_c)

        yield "jets close", self.tau_jet == self.jets(jet, A_plus, A_minus)
        yield "film", self.tau_viscous == self.viscous_torque(der(self.w), self.w)
        yield (
            "friction",
            self.tau_friction
            == self.friction_torque(self._radial_force(A_plus, A_minus))
            * self.w
            / sqrt(self.w**2 + self.w_small**2),
        )
        yield "inertia", self.tau_inertia == self.inertia() * der(self.w)
        loads = self.tau_jet + self.tau_viscous + self.tau_friction
        yield "balance of torques", self.flange.tau == self.tau_inertia + loads

    def _radial_force(self, A_plus: SX, A_minus: SX) -> SX:
        """The force of 3.25 with the pressures at the cylinder: the lines' drops lie outside."""
        A = A_plus + A_minus
        p_A = self.port_a.p + self.line_drop(A_plus * self.u_pa - A_minus * self.u_at, self.L_A)
        p_B = self.port_b.p - self.line_drop(A_plus * self.u_bt - A_minus * self.u_pb, self.L_B)
        dp_AB = smooth_if_else(self.theta >= 0, p_A - p_B, p_B - p_A)
        return self.radial_force(A, A, self.port_p.p - self.port_t.p, dp_AB)
