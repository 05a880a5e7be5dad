"""Small circuits around one hydraulic component."""

from __future__ import annotations

from arthur_acausal import Component, Equations, connect
from arthur_acausal.components.hydraulic import (
    ControlledPressureSource,
    Fluid,
    Orifice,
    ServoValve,
    Tank,
    TwoPort,
    Volume,
)


class BetweenPressures(Component):
    """A component with two ports between two given pressures: inputs ``a.p``, ``b.p`` [Pa]."""

    fluid: Fluid = Fluid(constant_density=True)
    part: TwoPort = Orifice(area=1e-6)
    b = ControlledPressureSource()

    def build(self) -> None:
        self.a = ControlledPressureSource(fluid=self.fluid)

    def equations(self) -> Equations:
        yield connect(self.a.port, self.part.port_a)
        yield connect(self.part.port_b, self.b.port)


class Discharge(Component):
    """A volume that empties through a component with two ports into a tank."""

    fluid: Fluid = Fluid(constant_density=True)
    volume: Volume = Volume(V=1e-3)
    part: TwoPort = Orifice(area=1e-6)

    def build(self) -> None:
        self.tank = Tank(p=0.0, fluid=self.fluid)

    def equations(self) -> Equations:
        yield connect(self.volume.port, self.part.port_a)
        yield connect(self.part.port_b, self.tank.port)


class ValveBetweenPressures(Component):
    """A servo valve with a given pressure at each port: inputs ``p.p``, ``t.p``, ``a.p``, ``b.p`` [Pa]."""

    fluid: Fluid = Fluid()
    valve: ServoValve = ServoValve()
    t = ControlledPressureSource()
    a = ControlledPressureSource()
    b = ControlledPressureSource()

    def build(self) -> None:
        self.p = ControlledPressureSource(fluid=self.fluid)

    def equations(self) -> Equations:
        yield connect(self.p.port, self.valve.port_p)
        yield connect(self.t.port, self.valve.port_t)
        yield connect(self.a.port, self.valve.port_a)
        yield connect(self.b.port, self.valve.port_b)
