"""Piston without storage."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, der, parameter, variable
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.ports import HydraulicPort
from arthur_acausal.components.translational import Flange


class Piston(Component):
    """A double-acting piston without mass, friction or volume: what it sweeps flows through its ports.

    f = p_a A_a - p_b A_b pushes the flange to positive s, so that fluid into port_a extends it (Merritt 1967, ch. 6).
    ``G_leak`` [m^3/(s Pa)]: laminar leakage from a to b. For chambers that compress join a ``Volume`` to each port,
    or take ``Cylinder``. Valid where the chambers' compliance lies elsewhere.
    """

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    flange = Flange()
    fluid: Fluid = Fluid()
    A_a: Real = parameter("m^2", min=0.0, description="area, side a")
    A_b: Real = parameter("m^2", min=0.0, description="area, side b")
    G_leak: Real = parameter("m^3/(s*Pa)", default=0.0, min=0.0, description="leakage past the piston")
    v: Real = variable("m/s", description="velocity")
    q_leak: Real = variable("m^3/s", nominal=1e-6, description="leakage from a to b")

    def equations(self) -> Equations:
        a, b = self.port_a, self.port_b
        yield self.v == der(self.flange.s)
        yield self.q_leak == self.G_leak * (a.p - b.p)
        yield "swept by side a", a.q == self.A_a * self.v + self.q_leak
        yield "swept by side b", b.q == -self.A_b * self.v - self.q_leak
        yield "force balance", self.flange.f == self.A_b * b.p - self.A_a * a.p
