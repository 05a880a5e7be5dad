"""Single-acting cylinder."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, der, parameter, variable
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.ports import HydraulicPort
from arthur_acausal.components.translational import Flange


class Ram(Component):
    """A single-acting cylinder without mass or friction: fluid in pushes the rod out.

    State: ``p`` [Pa]; the rod's motion is that of what its flange ``rod`` is connected to. The volume is
    dead_volume + area rod.s. Parameters: ``area`` [m^2], ``dead_volume`` [m^3], ``p_ambient`` [Pa] on the
    rod's side. Valid while the volume is positive; it has no stops.
    """

    port = HydraulicPort()
    rod = Flange()
    fluid: Fluid = Fluid()
    area: Real = parameter("m^2", min=0.0)
    dead_volume: Real = parameter("m^3", min=0.0, description="volume at rod.s = 0")
    p_ambient: Real = parameter("Pa", default=0.0, display="bar")
    p: Real = variable("Pa", start=1e5, nominal=1e7, display="bar", description="pressure")
    V: Real = variable("m^3", nominal=1e-5, description="volume of fluid")

    def equations(self) -> Equations:
        yield self.p == self.port.p
        yield self.V == self.dead_volume + self.area * self.rod.s
        rate = self.fluid.pressure_rate(self.p, self.port.q, self.V, self.area * der(self.rod.s))
        yield "mass balance", der(self.p) == rate
        yield "force balance", self.rod.f == -self.area * (self.p - self.p_ambient)
