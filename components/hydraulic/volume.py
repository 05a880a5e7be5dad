"""Rigid volume, for manifolds and dead volumes."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, der, parameter, variable
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.ports import HydraulicPort


class Volume(Component):
    """A rigid volume of compressible fluid; connect as many components to its port as meet there.

    State: ``p`` [Pa]. Parameter: ``V`` [m^3]. Mass is conserved exactly: p' = beta/V q rho_0/rho (ARTHuR
    report, eq. 5.21 and 5.39, with the density's change). Wave propagation is not in it.
    """

    port = HydraulicPort()
    fluid: Fluid = Fluid()
    V: Real = parameter("m^3", min=0.0)
    p: Real = variable("Pa", start=1e5, nominal=1e7, display="bar", description="pressure")
    m: Real = variable("kg", nominal=1e-2, description="mass of the fluid")
    E_stored: Real = variable("J", description="energy of compression")

    def equations(self) -> Equations:
        yield self.p == self.port.p
        yield "mass balance", der(self.p) == self.fluid.pressure_rate(self.p, self.port.q, self.V)
        yield self.m == self.fluid.density(self.p) * self.V
        yield self.E_stored == self.fluid.energy_density(self.p) * self.V
