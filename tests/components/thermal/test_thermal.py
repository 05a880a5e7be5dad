"""Heat transfer against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal import Component, Equations, SolverOptions, connect, simulate, start
from arthur_acausal.components.blocks import Constant, Ramp
from arthur_acausal.components.electrical import ConstantVoltage, Ground, HeatingResistor
from arthur_acausal.components.thermal import (
    BodyRadiation,
    Convection,
    FixedHeatFlow,
    FixedTemperature,
    HeatCapacitor,
    HeatFlowSensor,
    PrescribedHeatFlow,
    PrescribedTemperature,
    RelativeTemperatureSensor,
    TemperatureSensor,
    ThermalCollector,
    ThermalConductor,
    ThermalElement,
    ThermalResistor,
)

PRECISE = SolverOptions(rtol=1e-9)


class Cooling(Component):
    """A warm body, an element, and a fixed temperature."""

    body = HeatCapacitor(C=100.0, T=start(400.0, fixed=True))
    element: ThermalElement = ThermalConductor(G=2.0)
    meter = HeatFlowSensor()
    difference = RelativeTemperatureSensor()
    ambient: FixedTemperature = FixedTemperature(T=300.0)

    def equations(self) -> Equations:
        yield connect(self.body.port, self.element.port_a)
        yield connect(self.element.port_b, self.meter.port_a)
        yield connect(self.meter.port_b, self.ambient.port)
        yield connect(self.difference.port_a, self.body.port)
        yield connect(self.difference.port_b, self.ambient.port)


@pytest.mark.parametrize("element", [ThermalConductor(G=2.0), ThermalResistor(R=0.5)], ids=["G", "R"])
def test_a_body_cools_down(element: ThermalElement) -> None:
    """T - T_a falls as exp(-G t/C)."""
    solution = simulate(Cooling(element=element), stop_time=100.0, options=PRECISE)
    above = 100.0 * np.exp(-solution.t * 2.0 / 100.0)
    assert solution["body.T"] == pytest.approx(300.0 + above, abs=1e-5)
    assert solution["difference.T_rel"] == pytest.approx(above, abs=1e-5)
    assert solution["meter.Q_flow"] == pytest.approx(2.0 * above, abs=1e-5)


def test_a_body_radiates_into_cold_space() -> None:
    """T^-3 = T_0^-3 + 3 sigma Gr t/C towards 0 K."""
    cold = Cooling(element=BodyRadiation(Gr=0.5), ambient=FixedTemperature(T=0.0))
    solution = simulate(cold, stop_time=1000.0, options=PRECISE)
    exact = (400.0**-3 + 3 * 5.670374419e-8 * 0.5 * solution.t / 100.0) ** (-1 / 3)
    assert solution["body.T"] == pytest.approx(exact, rel=1e-8)


class Wall(Component):
    """Heat into a plate that a fluid cools and that conducts to two bodies, joined by a collector."""

    heater = FixedHeatFlow(Q_flow=50.0)
    more = PrescribedHeatFlow()
    power = Constant.of("W")(k=10.0)
    plate = HeatCapacitor(C=1.0, T=start(300.0, fixed=True))
    air = Convection()
    h = Constant.of("W/K")(k=4.0)
    fluid = PrescribedTemperature()
    temperature = Ramp.of("K")(offset=290.0, height=10.0, duration=5.0)
    joint = ThermalCollector(m=2)
    G1 = ThermalConductor(G=1.0)
    G2 = ThermalConductor(G=1.0)
    cold = FixedTemperature(T=280.0)
    sensor = TemperatureSensor()

    def equations(self) -> Equations:
        for port in (self.heater.port, self.more.port, self.air.port_a, self.joint.port, self.sensor.port):
            yield connect(self.plate.port, port)
        yield connect(self.power.y, self.more.Q_flow)
        yield connect(self.h.y, self.air.Gc)
        yield connect(self.temperature.y, self.fluid.T)
        yield connect(self.air.port_b, self.fluid.port)
        for port, conductor in zip(self.joint.ports, (self.G1, self.G2), strict=True):
            yield connect(port, conductor.port_a)
            yield connect(conductor.port_b, self.cold.port)


def test_a_plate_comes_to_equilibrium() -> None:
    """60 W = 4 W/K (T - 300 K) + 2 W/K (T - 280 K)."""
    solution = simulate(Wall(), stop_time=60.0)
    T = (60.0 + 4.0 * 300.0 + 2.0 * 280.0) / 6.0
    assert solution.final("plate.T") == pytest.approx(T, rel=1e-6)
    assert solution.final("sensor.T_celsius") == pytest.approx(T - 273.15, rel=1e-5)
    assert solution.final("G1.Q_flow") == pytest.approx(T - 280.0, rel=1e-5)


class Heater(Component):
    """A resistor of rising resistance on a constant voltage heats itself against a conductor."""

    source = ConstantVoltage(V=10.0)
    resistor = HeatingResistor(R=10.0, T_ref=300.0, alpha=0.01)
    body = HeatCapacitor(C=0.1, T=start(300.0, fixed=True))
    path = ThermalConductor(G=0.1)
    ambient = FixedTemperature(T=300.0)
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.pin_p, self.resistor.pin_p)
        yield connect(self.source.pin_n, self.resistor.pin_n)
        yield connect(self.source.pin_n, self.ground.pin)
        yield connect(self.resistor.heat_port, self.body.port)
        yield connect(self.body.port, self.path.port_a)
        yield connect(self.path.port_b, self.ambient.port)


def test_a_heating_resistor_comes_to_equilibrium() -> None:
    """V^2/(R (1 + alpha d)) = G d: d = 61.803398874989 K, the golden ratio."""
    solution = simulate(Heater(), stop_time=50.0)
    assert solution.final("body.T") - 300.0 == pytest.approx(61.80339887498949, rel=1e-6)
    assert solution.final("resistor.P_loss") == pytest.approx(6.180339887498949, rel=1e-6)
