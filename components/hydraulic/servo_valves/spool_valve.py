"""Linear spool servo valve with a mechanical flange."""

from __future__ import annotations

from casadi import SX, fabs, fmax, fmin, sqrt

from arthur_acausal import Equations, Real, der, variable
from arthur_acausal.components.hydraulic.servo_valves.jets import (
    drop_factor,
    jet_force,
    with_sign,
)
from arthur_acausal.components.hydraulic.servo_valves.spool_body import SpoolBody
from arthur_acausal.components.hydraulic.servo_valves.ways import Ways
from arthur_acausal.components.translational import Flange


class SpoolValve(SpoolBody, Ways):
    """A four-way spool valve that a linear actuator moves: ARTHuR report, section 3.6; geometry as `SpoolBody`.

    The position of ``flange`` beyond the overlap opens P to A and B to T where positive, P to B and A to T where
    negative, each through one orifice: dp = K_Q Q^2 (3.54, 3.55) in either direction, made linear below the jet speed
    ``u_small`` [m/s]. Closed lands leak (3.56 to 3.58; ``leakage``: share of it, 1 or 0).

    Forces [N]: ``f_jet`` closes (3.48, without the leakage's momentum), ``f_drag`` is the film's (3.59, first term),
    ``f_shear`` the leakage's on the two closed lands, which nearly cancel (3.59, second term), ``f_transient`` (3.49,
    with ``transient``, which needs pressures that can be differentiated), ``f_inertia``. They sum to the flange's.
    """

    transient: bool = False
    flange = Flange()
    x: Real = variable("m", start=0.0, nominal=1e-4, description="position of the spool")
    v: Real = variable("m/s", start=0.0, nominal=0.1, description="its velocity")
    f_jet: Real = variable("N", description="of the jets, 3.48")
    f_drag: Real = variable("N", description="of the film, 3.59")
    f_shear: Real = variable("N", description="of the leakage on the closed lands, 3.59")
    f_transient: Real = variable("N", description="3.49")
    f_inertia: Real = variable("N", description="mass times acceleration")

    def opening(self, x: SX) -> SX:
        """Return the open share [1] of the ports that open with positive ``x`` [m]."""
        return fmin(fmax((x - self.L_OL) / self.d_p, 0), 1)

    def drop(self, s: SX, u: SX) -> SX:
        """Return the drop [Pa] of one orifice."""
        # A fully open port has no drop in 3.54; what is left keeps its speed from being undetermined.
        return fmax(drop_factor(s, self.fluid.rho, self.C_d), self.fluid.rho / 1000) * with_sign(
            u, self.u_small
        )

    def equations(self) -> Equations:
        p, t, a, b = self.port_p, self.port_t, self.port_a, self.port_b
        plus, minus = self.opening(self.x), self.opening(-self.x)
        yield self.x == self.flange.s
        yield self.v == der(self.x)
        yield self.s == plus + minus
        yield "P to A", p.p - a.p == self.drop(plus, self.u_pa)
        yield "B to T", b.p - t.p == self.drop(plus, self.u_bt)
        yield "P to B", p.p - b.p == self.drop(minus, self.u_pb)
        yield "A to T", a.p - t.p == self.drop(minus, self.u_at)
        A_plus, A_minus = self.area(plus), self.area(minus)
        leak = self.land_leakage(fmax(fabs(self.x), self.L_OL) - self.L_OL)
        yield from self.flows(self.fluid, A_plus, A_minus, leak)
        yield from self._forces(A_plus, A_minus)

    def _forces(self, A_plus: SX, A_minus: SX) -> Equations:
        p, t, a, b = self.port_p.p, self.port_t.p, self.port_a.p, self.port_b.p
        ratio = self.d_p / self.c_r
        yield from self.direction(self.jet_angle, ratio, self.phi_error)

        def jet(area: SX, u: SX) -> SX:
            return jet_force(self.fluid.rho, area, u, self.phi_jet, self.C_c)

        yield "jets close", self.f_jet == self.jets(jet, A_plus, A_minus)
        yield "film", self.f_drag == self.drag(self.v)
        # The leakages P to B and A to T pull the spool opposite ways; so do P to A and B to T in the other state.
        side = self.x / sqrt(self.x**2 + self.L_OL**2)
        dp = (1 + side) / 2 * ((a - t) - (p - b)) + (1 - side) / 2 * ((p - a) - (b - t))
        yield "leakage's shear", self.f_shear == self.leakage * self.land_shear(dp)
        if self.transient:
            q_S = A_plus * self.u_pa - A_minus * self.u_pb
            q_R = A_plus * self.u_bt - A_minus * self.u_at
            yield "transient", self.f_transient == self.transient_force(der(q_S - q_R))
        else:
            yield self.f_transient == 0
        yield "inertia", self.f_inertia == self.mass() * der(self.v)
        loads = self.f_jet + self.f_drag + self.f_shear + self.f_transient
        yield "balance of forces", self.flange.f == self.f_inertia + loads
