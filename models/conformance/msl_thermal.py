"""Examples of the Modelica Standard Library 4.1.0, Thermal.HeatTransfer, built from the library.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, connect, parameter, start
from arthur_acausal.components.blocks import Not, OnOffController, Ramp
from arthur_acausal.components.electrical import ConstantVoltage, Ground, HeatingResistor, IdealOpeningSwitch
from arthur_acausal.components.thermal import (
    FixedTemperature,
    HeatCapacitor,
    TemperatureSensor,
    ThermalConductor,
)
from arthur_acausal.models.conformance.case import Case


class TwoMasses(Component):
    """Two bodies of different temperature joined by a conductor (TwoMasses)."""

    mass1 = HeatCapacitor(C=15.0, T=start(373.15, fixed=True))
    mass2 = HeatCapacitor(C=15.0, T=start(273.15, fixed=True))
    conduction = ThermalConductor(G=10.0)
    sensor1 = TemperatureSensor()
    sensor2 = TemperatureSensor()

    def equations(self) -> Equations:
        yield connect(self.mass1.port, self.conduction.port_a)
        yield connect(self.conduction.port_b, self.mass2.port)
        yield connect(self.mass1.port, self.sensor1.port)
        yield connect(self.mass2.port, self.sensor2.port)


class ControlledTemperature(Component):
    """A resistor that heats itself, switched by an on-off controller along a ramp (ControlledTemperature)."""

    T_ambient: Real = parameter("K", default=293.15)
    ground = Ground()
    source = ConstantVoltage(V=10.0)
    switch = IdealOpeningSwitch()
    resistor = HeatingResistor(R=10.0, T_ref=293.15, alpha=1 / 255)
    heatCapacitor = HeatCapacitor(C=1.0, T=start(lambda self: self.T_ambient, fixed=True))
    conductor = ThermalConductor(G=0.1)
    ambient = FixedTemperature(T=lambda self: self.T_ambient)
    sensor = TemperatureSensor()
    ramp = Ramp(height=25.0, duration=6.0, offset=25.0, start_time=2.0)
    onOffController = OnOffController(bandwidth=2.0)
    inverter = Not()

    def equations(self) -> Equations:
        yield connect(self.source.pin_n, self.ground.pin)
        yield connect(self.source.pin_n, self.resistor.pin_n)
        yield connect(self.source.pin_p, self.switch.pin_p)
        yield connect(self.switch.pin_n, self.resistor.pin_p)
        for port in (self.heatCapacitor.port, self.sensor.port, self.conductor.port_a):
            yield connect(self.resistor.heat_port, port)
        yield connect(self.conductor.port_b, self.ambient.port)
        yield connect(self.ramp.y, self.onOffController.reference)
        yield connect(self.sensor.T_celsius, self.onOffController.u)
        yield connect(self.onOffController.y, self.inverter.u)
        yield connect(self.inverter.y, self.switch.control)


_CASES = (
    Case("msl_Thermal_HeatTransfer_TwoMasses", TwoMasses, {"mass1.T": "mass1.T", "mass2.T": "mass2.T"}, 1.0),
    Case(
        "msl_Thermal_HeatTransfer_ControlledTemperature",
        ControlledTemperature,
        {"heatCapacitor.T": "heatCapacitor.T", "onOffController.y": "onOffController.y"},
        10.0,
    ),
)
CASES: dict[str, Case] = {case.name: case for case in _CASES}
