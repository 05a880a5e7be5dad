"""Examples of the Modelica Standard Library 4.1.0, Thermal.HeatTransfer, built from the library.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, connect, parameter, start
from arthur_acausal.components.blocks import Constant, Not, OnOffController, Pulse, Ramp
from arthur_acausal.components.electrical import ConstantVoltage, Ground, HeatingResistor, IdealOpeningSwitch
from arthur_acausal.components.thermal import (
    Convection,
    FixedTemperature,
    HeatCapacitor,
    PrescribedHeatFlow,
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


class Motor(Component):
    """A motor of two bodies, winding and core, under a load that changes (Motor)."""

    T_ambient: Real = parameter("K", default=293.15)
    losses: Pulse = Pulse.of("W")(amplitude=900.0, offset=100.0, duty=0.4, period=600.0, start_time=360.0)
    constant: Constant = Constant.of("W")(k=500.0)
    windingLosses = PrescribedHeatFlow(T_ref=368.15, alpha=3.03e-3)
    coreLosses = PrescribedHeatFlow()
    winding = HeatCapacitor(C=2500.0, T=start(lambda self: self.T_ambient, fixed=True))
    core = HeatCapacitor(C=25000.0, T=start(lambda self: self.T_ambient, fixed=True))
    winding2core = ThermalConductor(G=10.0)
    Twinding = TemperatureSensor()
    Tcore = TemperatureSensor()
    convectionConstant: Constant = Constant.of("W/K")(k=25.0)
    convection = Convection()
    environment = FixedTemperature(T=lambda self: self.T_ambient)

    def equations(self) -> Equations:
        yield connect(self.losses.y, self.windingLosses.Q_flow)
        yield connect(self.constant.y, self.coreLosses.Q_flow)
        yield connect(self.convectionConstant.y, self.convection.Gc)
        for port in (self.windingLosses.port, self.winding2core.port_a, self.Twinding.port):
            yield connect(self.winding.port, port)
        for port in (self.coreLosses.port, self.winding2core.port_b, self.Tcore.port, self.convection.port_a):
            yield connect(self.core.port, port)
        yield connect(self.convection.port_b, self.environment.port)


_CASES = (
    Case(
        "msl_Thermal_HeatTransfer_Motor",
        Motor,
        {"Twinding.T": "Twinding.T_celsius", "Tcore.T": "Tcore.T_celsius"},
        7200.0,
    ),
    Case("msl_Thermal_HeatTransfer_TwoMasses", TwoMasses, {"mass1.T": "mass1.T", "mass2.T": "mass2.T"}, 1.0),
    Case(
        "msl_Thermal_HeatTransfer_ControlledTemperature",
        ControlledTemperature,
        {"heatCapacitor.T": "heatCapacitor.T", "onOffController.y": "onOffController.y"},
        10.0,
    ),
)
CASES: dict[str, Case] = {case.name: case for case in _CASES}
