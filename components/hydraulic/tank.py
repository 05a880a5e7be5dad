"""Tank at constant pressure."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, parameter
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.ports import HydraulicPort


class Tank(Component):
    """A tank so large that its pressure ``p`` [Pa] stays constant, whatever flows in or out."""

    port = HydraulicPort()
    fluid: Fluid = Fluid()
    p: Real = parameter("Pa", default=101325.0, display="bar")

    def equations(self) -> Equations:
        yield self.port.p == self.p
