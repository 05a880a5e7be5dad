"""What components that let fluid pass from one port to another share."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, real_output, variable
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.ports import HydraulicPort


class TwoPort(Component):
    """Two ports that share one flow; a subclass adds the law between ``dp`` and ``q``.

    ``dp`` [Pa]: pressure drop from port_a to port_b. ``q`` [m^3/s]: flow from port_a to port_b. ``P_loss``
    [W]: power turned to heat, rho q (h(p_a) - h(p_b)). No fluid is stored.
    """

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    fluid: Fluid = Fluid()
    dp: Real = variable("Pa", nominal=1e7, display="bar", description="pressure drop")
    q: Real = variable("m^3/s", nominal=1e-4, display="L/min", description="flow from port_a to port_b")
    P_loss: Real = real_output("W", description="power turned to heat")

    def equations(self) -> Equations:
        a, b = self.port_a, self.port_b
        yield self.dp == a.p - b.p
        yield self.q == a.q
        yield "mass balance", a.q + b.q == 0
        yield self.P_loss == self.fluid.throttling_loss(self.q, a.p, b.p)
