"""A room with a thermostat: heat transfer under on-off control."""

from __future__ import annotations

from math import pi

from arthur_acausal import Component, Equations, Real, connect, parameter, start
from arthur_acausal.components.blocks import Constant, Gain, OnOffController, Sine
from arthur_acausal.components.thermal import (
    Convection,
    HeatCapacitor,
    PrescribedHeatFlow,
    PrescribedTemperature,
    TemperatureSensor,
    ThermalConductor,
)


class RoomHeating(Component):
    """Air, walls and weather: a heater of ``power`` [W] keeps a room at ``target`` [K] within +-0.5 K.

    The air exchanges heat with the walls by convection, the walls conduct to the outside, whose temperature swings
    by 5 K over a day. The heater is on more of the time at night.
    """

    power: Real = parameter("W", default=2000.0, min=0.0)
    target: Real = parameter("K", default=294.15, display="degC")
    air: HeatCapacitor = HeatCapacitor(C=5e5, T=start(291.15, fixed=True))
    walls: HeatCapacitor = HeatCapacitor(C=5e6, T=start(287.15, fixed=True))
    inside = Convection()
    h = Constant.of("W/K")(k=150.0)
    through: ThermalConductor = ThermalConductor(G=80.0)
    outside = PrescribedTemperature()
    weather = Sine.of("K")(offset=276.15, amplitude=5.0, f=1 / 86400, phase=pi)
    set_point = Constant.of("K")(k=lambda self: self.target)
    thermostat = OnOffController.of("1", "K")(bandwidth=1.0, pre_y_start=1.0)
    heater = Gain.of("W", "1")(k=lambda self: self.power)
    heat = PrescribedHeatFlow()
    thermometer = TemperatureSensor()

    def equations(self) -> Equations:
        yield connect(self.air.port, self.inside.port_a)
        yield connect(self.inside.port_b, self.walls.port)
        yield connect(self.walls.port, self.through.port_a)
        yield connect(self.through.port_b, self.outside.port)
        yield connect(self.h.y, self.inside.Gc)
        yield connect(self.weather.y, self.outside.T)
        yield connect(self.thermometer.port, self.air.port)
        yield connect(self.thermometer.T, self.thermostat.u)
        yield connect(self.set_point.y, self.thermostat.reference)
        yield connect(self.thermostat.y, self.heater.u)
        yield connect(self.heater.y, self.heat.Q_flow)
        yield connect(self.heat.port, self.air.port)
