"""Mechanical elements whose losses may leave by a heat port."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, variable
from arthur_acausal.components.thermal import HeatPort


class Heating(Component):
    """An element that turns the power ``P_loss`` [W] to heat; with ``use_heat_port`` it leaves by ``heat_port``."""

    use_heat_port: bool = False
    P_loss: Real = variable("W", description="power turned to heat")

    def build(self) -> None:
        super().build()
        if self.use_heat_port:
            self.heat_port = HeatPort()

    def heat(self) -> Equations:
        """Yield what passes the heat on, if there is a heat port."""
        if self.use_heat_port:
            yield self.heat_port.Q_flow == -self.P_loss
