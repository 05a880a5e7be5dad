"""Ideal sources of pressure and flow."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, parameter, real_input, variable
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.ports import HydraulicPort


class PressureSource(Component):
    """Keeps its port at the pressure ``p`` [Pa], whatever the flow.

    ``P`` [W]: the power that it gives, rho q h(p).
    """

    port = HydraulicPort()
    fluid: Fluid = Fluid()
    p: Real = parameter("Pa", display="bar")
    P: Real = variable("W", description="power given")

    def equations(self) -> Equations:
        yield self.port.p == self.p
        yield self.P == -self.fluid.throttling_loss(self.port.q, self.p, self.fluid.p_ref)


class ControlledPressureSource(Component):
    """Keeps its port at the pressure of the signal ``p`` [Pa], whatever the flow."""

    port = HydraulicPort()
    fluid: Fluid = Fluid()
    p: Real = real_input("Pa", default=101325.0, display="bar")

    def equations(self) -> Equations:
        yield self.port.p == self.p


class FlowSource(Component):
    """Gives the flow ``q`` [m^3/s at reference density] out of its port, whatever the pressure."""

    port = HydraulicPort()
    fluid: Fluid = Fluid()
    q: Real = parameter("m^3/s", display="L/min")
    P: Real = variable("W", description="power given")

    def equations(self) -> Equations:
        yield self.port.q == -self.q
        yield self.P == self.fluid.throttling_loss(self.q, self.port.p, self.fluid.p_ref)


class ControlledFlowSource(Component):
    """Gives the flow of the signal ``q`` [m^3/s at reference density], whatever the pressure."""

    port = HydraulicPort()
    fluid: Fluid = Fluid()
    q: Real = real_input("m^3/s", default=0.0, display="L/min")

    def equations(self) -> Equations:
        yield self.port.q == -self.q
