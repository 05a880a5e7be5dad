"""The four ways through a servo valve, whatever moves in it."""

from __future__ import annotations

from collections.abc import Callable

from casadi import SX

from arthur_acausal import Component, Equations, Real, parameter, real_output, variable
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.ports import HydraulicPort
from arthur_acausal.components.hydraulic.servo_valves.jets import (
    JetAngle,
    equal,
    half_angle,
    jet_angle,
    von_mises,
)


class Ways(Component):
    """What dynamic servo valves share: P to A with B to T, or P to B with A to T, their jets' angle and their loss.

    ``u_pa`` ... [m/s]: mean speed in the open area of each way, positive in the direction of its name. Flows into the
    ports are positive. A valve says what drops each way's pressure, and how far it is open.
    """

    port_p = HydraulicPort()
    port_t = HydraulicPort()
    port_a = HydraulicPort()
    port_b = HydraulicPort()
    leakage: Real = parameter("1", default=1.0, min=0.0, description="share of the leakage past closed ports")
    u_small: Real = parameter("m/s", default=0.1, min=0.0, description="laminar below about this jet speed")
    s: Real = variable("1", nominal=0.1, description="opening over the port's width, by magnitude")
    phi: Real = variable("rad", start=0.5, description="jet angle of 3.6")
    phi_half: Real = variable("rad", start=1.2, description="where 3.7 begins")
    phi_jet: Real = variable("rad", start=0.5, description="jet angle")
    u_pa: Real = variable("m/s", nominal=100.0, description="jet speed from P to A")
    u_bt: Real = variable("m/s", nominal=100.0, description="from B to T")
    u_pb: Real = variable("m/s", nominal=100.0, description="from P to B")
    u_at: Real = variable("m/s", nominal=100.0, description="from A to T")
    P_loss: Real = real_output("W", description="fluid power turned to heat between the ports")

    def flows(self, fluid: Fluid, A_plus: SX, A_minus: SX, leak: SX) -> Equations:
        """Yield the flows of the ports and their loss for open areas [m^2] and a leakage [m^3/(s Pa)]."""
        p, t, a, b = self.port_p, self.port_t, self.port_a, self.port_b
        leak = self.leakage * leak
        q_pa, q_bt = A_plus * self.u_pa + leak * (p.p - a.p), A_plus * self.u_bt + leak * (b.p - t.p)
        q_pb, q_at = A_minus * self.u_pb + leak * (p.p - b.p), A_minus * self.u_at + leak * (a.p - t.p)
        yield p.q == q_pa + q_pb
        yield t.q == -(q_at + q_bt)
        yield a.q == q_at - q_pa
        yield b.q == q_bt - q_pb
        loss = fluid.throttling_loss
        of_plus = loss(q_pa, p.p, a.p) + loss(q_bt, b.p, t.p)
        yield self.P_loss == of_plus + loss(q_pb, p.p, b.p) + loss(q_at, a.p, t.p)

    def direction(self, kind: JetAngle, ratio: SX, error: SX) -> Equations:
        """Yield the jets' angle for ``ratio`` = width/clearance, off by ``error`` [rad]."""
        yield "von Mises", equal(*von_mises(self.phi, self.s * ratio))
        yield from half_angle(kind, self.phi_half, ratio)
        yield self.phi_jet == jet_angle(self.s, self.phi, self.phi_half) + error

    def jets(self, jet: Callable[[SX, SX], SX], A_plus: SX, A_minus: SX) -> SX:
        """Return what closes the valve, of all jets: ``jet`` of the open area and the speed, by either state's sign."""
        opened_plus = jet(A_plus, self.u_pa) + jet(A_plus, self.u_bt)
        return opened_plus - jet(A_minus, self.u_pb) - jet(A_minus, self.u_at)
