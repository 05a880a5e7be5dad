"""Thermal sources, named as in the Modelica Standard Library (Thermal.HeatTransfer.Sources)."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, parameter, real_input
from arthur_acausal.components.thermal.heat_port import HeatPort


class FixedTemperature(Component):
    """A body so large that its temperature ``T`` [K] does not change."""

    port = HeatPort()
    T: Real = parameter("K", min=0.0, display="degC")

    def equations(self) -> Equations:
        yield self.port.T == self.T


class PrescribedTemperature(Component):
    """A body whose temperature is the signal ``T`` [K]."""

    port = HeatPort()
    T: Real = real_input("K", default=293.15, min=0.0, display="degC")

    def equations(self) -> Equations:
        yield self.port.T == self.T


class FixedHeatFlow(Component):
    """Heat ``Q_flow`` [W] into what is connected; with the coefficient ``alpha`` [1/K] times 1 + alpha (T - T_ref)."""

    port = HeatPort()
    Q_flow: Real = parameter("W")
    T_ref: Real = parameter("K", default=293.15, display="degC")
    alpha: Real = parameter("1/K", default=0.0)

    def equations(self) -> Equations:
        yield self.port.Q_flow == -self.Q_flow * (1 + self.alpha * (self.port.T - self.T_ref))


class PrescribedHeatFlow(Component):
    """The signal ``Q_flow`` [W] into what is connected; with ``alpha`` [1/K] times 1 + alpha (T - T_ref)."""

    port = HeatPort()
    Q_flow: Real = real_input("W", default=0.0)
    T_ref: Real = parameter("K", default=293.15, display="degC")
    alpha: Real = parameter("1/K", default=0.0)

    def equations(self) -> Equations:
        yield self.port.Q_flow == -self.Q_flow * (1 + self.alpha * (self.port.T - self.T_ref))
