"""Motor, battery, pump and its sizing: figures of the report, and that no energy appears."""

from __future__ import annotations

from functools import cache
from math import exp, pi
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from arthur_acausal import Component, Equations, Translation, connect, translate
from arthur_acausal.components.blocks import Constant
from arthur_acausal.components.hydraulic import (
    GPM,
    GPM_EXACT,
    BatteryDrive,
    BrushlessMotor,
    Fluid,
    GearPump,
    PressureSource,
    consistent_displacement,
    pump_scaling,
)
from arthur_acausal.components.rotational import SpeedSource

RPM = 2 * pi / 60


def test_pump_scaling() -> None:
    """Report, 6.3.1, at 1 gpm and 5000 rpm; the inertia with the motor's."""
    size = pump_scaling(GPM, 5000 * RPM)
    assert size.D == pytest.approx(0.89059e-6, rel=1e-5)
    assert size.c_L == pytest.approx(1.41742e-7, rel=1e-5)
    assert size.J + 3.147e-4 == pytest.approx(3.15882e-4, rel=1e-5)


def test_the_exact_gallon_a_minute() -> None:
    assert 1 / GPM_EXACT == pytest.approx(15850.32, rel=1e-6)
    assert pump_scaling(GPM_EXACT, 5000 * RPM).D / pump_scaling(GPM, 5000 * RPM).D == pytest.approx(
        15852 / 15850.323
    )


def test_a_consistent_pump_delivers_what_was_asked() -> None:
    D = consistent_displacement(GPM, 5000 * RPM, 20.68e6, 1e12, 1e8)
    delivered = 5000 / 60 * (D - 1 / 1e8) - 20.68e6 / 1e12
    assert delivered == pytest.approx(GPM, rel=1e-12)


class Drive(Component):
    """A motor on a shaft of given speed."""

    motor: BrushlessMotor = BrushlessMotor()
    speed: Constant = Constant.of("rad/s")(k=5000 * RPM)
    shaft = SpeedSource()

    def equations(self) -> Equations:
        yield connect(self.speed.y, self.shaft.w)
        yield connect(self.motor.flange, self.shaft.flange)


@cache
def drive(**options: Any) -> Translation:
    """Translate a motor on a shaft."""
    return translate(Drive(motor=BrushlessMotor(**options)), compile="never")


@pytest.mark.parametrize("law", ["line", "dc"])
@settings(max_examples=25)
@given(V=st.floats(-60, 60), rpm=st.floats(-6000, 6000))
def test_what_the_motor_takes_is_copper_loss_and_shaft_power(law: str, V: float, rpm: float) -> None:
    """With V I in place of sqrt(3/2) V I the shaft would give more than it gets (5.1 to 5.4)."""
    solution = drive(law=law).simulate(1e-3, inputs={"motor.V": V}, parameters={"speed.k": rpm * RPM})
    shaft = solution.final("motor.tau") * rpm * RPM
    assert solution.final("motor.P_el") == pytest.approx(
        solution.final("motor.P_copper") + shaft, rel=1e-9, abs=1e-6
    )
    assert 0 <= solution.final("motor.I") <= 50


def test_the_motor_is_a_150_KV_motor() -> None:
    """1/K_e in rpm/V: 149.94 (eq. 5.4 with K_T = 0.078)."""
    solution = drive().simulate(1e-3, inputs={"motor.V": 40.0})
    K_e = 0.078 * (2 / 3) ** 0.5
    assert 1 / (K_e * RPM) == pytest.approx(149.94, abs=0.01)
    assert solution.final("motor.I") == pytest.approx((40.0 - K_e * 5000 * RPM) / 0.165, rel=1e-9)


def test_the_listing_s_motor_brakes_but_ours_does_not() -> None:
    inputs = {"motor.V": 0.0}
    assert drive(clamp="above").simulate(1e-3, inputs=inputs).final("motor.I") < -200
    assert drive().simulate(1e-3, inputs=inputs).final("motor.I") == 0


class Bus(Component):
    """A motor on a shaft, fed by a battery."""

    battery = BatteryDrive()
    motor = BrushlessMotor()
    speed: Constant = Constant.of("rad/s")(k=5000 * RPM)
    shaft = SpeedSource()

    def equations(self) -> Equations:
        yield connect(self.speed.y, self.shaft.w)
        yield connect(self.motor.flange, self.shaft.flange)
        yield connect(self.battery.V, self.motor.V)
        yield connect(self.motor.P_el, self.battery.P_el)


def test_a_battery_sags_and_its_power_is_accounted_for() -> None:
    rig = translate(Bus(), compile="never")
    solution = rig.simulate(1e-3, inputs={"battery.V_command": 60.0})
    V_bus, I_bus = solution.final("battery.V_bus"), solution.final("battery.I_bus")
    assert V_bus == pytest.approx(44.4 - 0.03 * I_bus, rel=1e-9)
    assert V_bus * I_bus == pytest.approx(solution.final("motor.P_el"), rel=1e-9)
    assert solution.final("motor.V_t") <= V_bus * (1 + 1e-12)
    assert solution.final("battery.P_battery") == pytest.approx(
        solution.final("battery.P_loss") + solution.final("motor.P_el"), rel=1e-9
    )


class Pumping(Component):
    """A pump between two pressures on a shaft of given speed."""

    fluid: Fluid = Fluid()
    speed: Constant = Constant.of("rad/s")(k=5000 * RPM)
    shaft = SpeedSource()
    pump: GearPump = GearPump(D=0.89059e-6)
    discharge = PressureSource(p=206.8e5)

    def build(self) -> None:
        self.suction = PressureSource(p=3e5, fluid=self.fluid)

    def equations(self) -> Equations:
        yield connect(self.speed.y, self.shaft.w)
        yield connect(self.shaft.flange, self.pump.flange)
        yield connect(self.suction.port, self.pump.port_a)
        yield connect(self.pump.port_b, self.discharge.port)


@pytest.mark.parametrize("constant", [True, False])
@settings(max_examples=10)
@given(rpm=st.floats(0, 6000), p=st.floats(3e5, 3e7))
def test_a_pump_s_shaft_power_is_fluid_power_and_losses(constant: bool, rpm: float, p: float) -> None:
    rig = pumping(constant)
    solution = rig.simulate(1e-3, parameters={"speed.k": rpm * RPM, "discharge.p": p})
    given_to = solution.final("shaft.P")
    losses = [solution.final(f"pump.P_{name}") for name in ("friction", "leakage", "compression")]
    to_fluid = -solution.final("suction.P") - solution.final("discharge.P")
    assert given_to == pytest.approx(sum(losses) + to_fluid, rel=1e-9, abs=1e-6)
    assert min(losses) >= -1e-9


@cache
def pumping(constant: bool) -> Translation:
    """Translate the pump's rig."""
    return translate(Pumping(fluid=Fluid(constant_density=constant)), compile="never")


def test_the_pump_delivers_0_84_gpm_at_207_bar() -> None:
    """Eq. 5.14: 5000/60 (D - 1e-8) - 203.8e5/1e12, at the suction's density; 0.33 gpm leak in all (5.13, 5.14)."""
    solution = pumping(True).simulate(1e-3)
    assert solution.final("pump.q") / GPM == pytest.approx(0.84, abs=0.01)
    assert solution.final("pump.q") == pytest.approx(
        5000 / 60 * (0.89059e-6 - 1e-8) - 203.8e5 / 1e12, rel=1e-6
    )
    dense = pumping(False).simulate(1e-3)
    assert dense.final("pump.q_displaced") == pytest.approx(
        5000 / 60 * 0.89059e-6 * exp(3e5 / 1.4e9), rel=1e-9
    )
    compression = dense.final("pump.P_compression")
    assert compression == pytest.approx(5000 / 60 * 0.89059e-6 * 203.8e5**2 / 2 / 1.4e9, rel=0.01)
