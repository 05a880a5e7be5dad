"""Ideal sensors of hydraulics."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, real_output
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.ports import HydraulicPort


class PressureSensor(Component):
    """Measures the pressure at its port: ``p`` [Pa]."""

    port = HydraulicPort()
    fluid: Fluid = Fluid()
    p: Real = real_output("Pa", display="bar")

    def equations(self) -> Equations:
        yield self.p == self.port.p
        yield self.port.q == 0


class PressureDifferenceSensor(Component):
    """Measures the pressure at port_a less that at port_b: ``dp`` [Pa]."""

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    fluid: Fluid = Fluid()
    dp: Real = real_output("Pa", display="bar")

    def equations(self) -> Equations:
        yield self.dp == self.port_a.p - self.port_b.p
        yield self.port_a.q == 0
        yield self.port_b.q == 0


class FlowSensor(Component):
    """Measures what flows from port_a to port_b: ``q`` [m^3/s at reference density], ``m_flow`` [kg/s]."""

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    fluid: Fluid = Fluid()
    q: Real = real_output("m^3/s", display="L/min")
    m_flow: Real = real_output("kg/s")

    def equations(self) -> Equations:
        yield self.port_a.p == self.port_b.p
        yield self.port_a.q + self.port_b.q == 0
        yield self.q == self.port_a.q
        yield self.m_flow == self.fluid.rho * self.port_a.q
