"""Thermal elements, named as in the Modelica Standard Library (Thermal.HeatTransfer.Components)."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, der, parameter, real_input, variable
from arthur_acausal.components.thermal.heat_port import HeatPort

ROOM_TEMPERATURE = 293.15
"""20 degrees Celsius in kelvin."""


class HeatCapacitor(Component):
    """A body of one temperature that stores heat: C der(T) = Q_flow. State: ``T`` [K]; ``C`` [J/K].

    The temperature within a body may be taken as one where its Biot number is below about 0.1 (Incropera,
    Fundamentals of Heat and Mass Transfer, 2007, sec. 5.2).
    """

    port = HeatPort()
    C: Real = parameter("J/K", min=0.0, description="heat capacity")
    T: Real = variable("K", start=ROOM_TEMPERATURE, nominal=300.0, display="degC", description="temperature")
    der_T: Real = variable("K/s", description="rate of the temperature")

    def equations(self) -> Equations:
        yield self.T == self.port.T
        yield self.der_T == der(self.T)
        yield "heat balance", self.C * self.der_T == self.port.Q_flow


class ThermalElement(Component):
    """What elements share that transport heat without storing any.

    ``Q_flow`` [W] passes from port_a to port_b, ``dT`` [K] is the temperature of port_a above port_b.
    """

    port_a = HeatPort()
    port_b = HeatPort()
    dT: Real = variable("K", nominal=10.0, description="port_a.T - port_b.T")
    Q_flow: Real = variable("W", description="heat from port_a to port_b")

    def equations(self) -> Equations:
        yield self.dT == self.port_a.T - self.port_b.T
        yield self.port_a.Q_flow == self.Q_flow
        yield self.port_b.Q_flow == -self.Q_flow


class ThermalConductor(ThermalElement):
    """Conduction: Q_flow = G dT. ``G`` [W/K], for a plate lambda A/L (Fourier's law)."""

    G: Real = parameter("W/K", min=0.0, description="thermal conductance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "Fourier's law", self.Q_flow == self.G * self.dT


class ThermalResistor(ThermalElement):
    """Conduction: dT = R Q_flow. ``R`` [K/W]; it may be zero."""

    R: Real = parameter("K/W", min=0.0, description="thermal resistance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "Fourier's law", self.dT == self.R * self.Q_flow


class Convection(ThermalElement):
    """Heat transfer to a fluid: Q_flow = Gc (T_solid - T_fluid), with the signal ``Gc`` [W/K] = h A.

    port_a is the solid, port_b the fluid. Newton's law of cooling (Incropera 2007, eq. 1.3a).
    """

    Gc: Real = real_input("W/K", min=0.0, description="convective conductance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "Newton's law of cooling", self.Q_flow == self.Gc * self.dT


class BodyRadiation(ThermalElement):
    """Radiation between two grey bodies: Q_flow = Gr sigma (T_a^4 - T_b^4), sigma the Stefan-Boltzmann constant.

    ``Gr`` [m^2]: net radiation conductance, emissivity times area for a small body in large surroundings
    (Incropera 2007, eq. 1.7). CODATA 2018: sigma = 5.670374419e-8 W/(m^2 K^4).
    """

    Gr: Real = parameter("m^2", min=0.0, description="net radiation conductance")
    sigma: Real = parameter("W/(m^2*K^4)", default=5.670374419e-8, description="Stefan-Boltzmann constant")

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.port_a.T, self.port_b.T
        yield "Stefan-Boltzmann law", self.Q_flow == self.Gr * self.sigma * (a**4 - b**4)


class ThermalCollector(Component):
    """Joins ``m`` heat ports, ``ports[k]``, to one, ``port``: equal temperatures, no storage."""

    m: int = 3
    port = HeatPort()

    def build(self) -> None:
        self.ports = [HeatPort() for _ in range(self.m)]

    def equations(self) -> Equations:
        for port in self.ports:
            yield port.T == self.port.T
        total = self.port.Q_flow
        for port in self.ports:
            total = total + port.Q_flow
        yield "heat balance", total == 0
