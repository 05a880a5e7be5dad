"""Ideal sensors of heat transfer: they take no heat."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, parameter, real_output
from arthur_acausal.components.thermal.heat_port import HeatPort


class TemperatureSensor(Component):
    """Measures the temperature of its port: ``T`` [K], and ``T_celsius``, the number of degrees Celsius [1]."""

    port = HeatPort()
    T: Real = real_output("K", nominal=300.0, display="degC")
    T_celsius: Real = real_output("1", nominal=10.0, description="degrees Celsius, a plain number")
    T_zero: Real = parameter("K", default=273.15, description="0 degrees Celsius")
    kelvin: Real = parameter("K", default=1.0, description="what one degree means")

    def equations(self) -> Equations:
        yield self.T == self.port.T
        yield self.T_celsius * self.kelvin == self.port.T - self.T_zero
        yield self.port.Q_flow == 0


class RelativeTemperatureSensor(Component):
    """Measures the temperature of port_a above port_b: ``T_rel`` [K]."""

    port_a = HeatPort()
    port_b = HeatPort()
    T_rel: Real = real_output("K", nominal=10.0)

    def equations(self) -> Equations:
        yield self.T_rel == self.port_a.T - self.port_b.T
        yield self.port_a.Q_flow == 0
        yield self.port_b.Q_flow == 0


class HeatFlowSensor(Component):
    """Measures the heat ``Q_flow`` [W] that passes from port_a to port_b."""

    port_a = HeatPort()
    port_b = HeatPort()
    Q_flow: Real = real_output("W")

    def equations(self) -> Equations:
        yield self.port_a.T == self.port_b.T
        yield self.port_a.Q_flow == self.Q_flow
        yield self.port_b.Q_flow == -self.Q_flow
