"""Motor, pump, relief valve, cylinder, reservoir: figures of the report, and where its laws would give energy."""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from math import exp, pi
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from arthur_acausal import Component, Equations, SolverOptions, Translation, connect, start, translate
from arthur_acausal.components.blocks import Constant
from arthur_acausal.components.hydraulic import (
    GPM,
    GPM_EXACT,
    BatteryDrive,
    BrushlessMotor,
    Cylinder,
    FlowSource,
    Fluid,
    GasReservoir,
    GearPump,
    PressureSource,
    ReliefValve,
    Tank,
    Volume,
    consistent_displacement,
    pump_scaling,
)
from arthur_acausal.components.hydraulic.reservoir import GasLaw
from arthur_acausal.components.rotational import SpeedSource
from arthur_acausal.components.translational import SpeedSource as Pusher

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


class Override(Component):
    """A flow through a relief valve, with the manifold's volume before it and 3 bar behind it."""

    source: FlowSource = FlowSource(q=GPM, fluid=Fluid(constant_density=True))
    manifold = Volume(V=4.83e-6, p=start(20.68e6, fixed=True))
    relief = ReliefValve()
    tank: Tank = Tank(p=3e5)

    def equations(self) -> Equations:
        yield connect(self.source.port, self.manifold.port)
        yield connect(self.manifold.port, self.relief.port_a)
        yield connect(self.relief.port_b, self.tank.port)


@cache
def override() -> Translation:
    """Translate the rig once."""
    return translate(Override())


@pytest.mark.parametrize(("gpm", "kilopascal"), [(1, 34.75), (3, 103.8)])
def test_relief_override(gpm: int, kilopascal: float) -> None:
    """Eq. 5.22 to 5.28 with p_R = 3 bar, the orifice at reference density."""
    solution = override().simulate(1e-3, parameters={"source.q": gpm * GPM})
    assert solution.final("manifold.p") - 20.68e6 == pytest.approx(kilopascal * 1e3, rel=5e-3)


def test_relief_and_manifold_make_a_time_constant_of_1_9_microseconds() -> None:
    """tau = V_m/(beta dq/dp): 4.83e-6/(1.4e9 x 1.816e-9)."""
    rest = override().simulate(1e-3).final("manifold.p")
    tau = 1.90e-6
    options = SolverOptions(rtol=1e-9, atol=1e-6)
    later = override().simulate(tau, start={"manifold.p": rest + 100.0}, options=options)
    assert (later.final("manifold.p") - rest) / 100.0 == pytest.approx(exp(-1), rel=0.02)


def test_the_poppet_stops_at_its_full_area() -> None:
    """A_max = pi d_p^2/4 at x_max = 1.648 mm (5.24, 5.25), 26.9 bar above cracking."""
    solution = override().simulate(1e-2, parameters={"source.q": 6e-3})
    assert solution.final("manifold.p") > 20.68e6 + 26.9e5
    assert solution.final("relief.x") == pytest.approx(1.648e-3, rel=1e-3)
    assert solution.final("relief.A_o") == pytest.approx(pi * 6.35e-3**2 / 4, rel=1e-9)


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


class Pushed(Component):
    """A cylinder between two constant pressures whose rod is moved."""

    cylinder: Cylinder = Cylinder(inertia=False)
    push = Pusher()
    a = PressureSource(p=100e5)
    b = PressureSource(p=50e5)

    def equations(self) -> Equations:
        yield connect(self.cylinder.flange, self.push.flange)
        yield connect(self.a.port, self.cylinder.port_a)
        yield connect(self.b.port, self.cylinder.port_b)


@cache
def pushed(**options: Any) -> Translation:
    """Translate the rig with some options of the cylinder."""
    return translate(Pushed(cylinder=Cylinder(inertia=False, **options)), compile="never")


@settings(max_examples=25)
@given(v=st.floats(-0.5, 0.5), p_a=st.floats(0, 2e7), p_b=st.floats(0, 2e7), stribeck=st.booleans())
def test_friction_takes_energy_in_either_direction(v: float, p_a: float, p_b: float, stribeck: bool) -> None:
    solution = pushed(stribeck=stribeck).simulate(
        1e-3, inputs={"push.v": v}, parameters={"a.p": p_a, "b.p": p_b}
    )
    assert solution.final("cylinder.P_loss") >= 0
    assert solution.final("cylinder.F_friction") * v >= 0


def test_the_printed_efficiency_gives_energy_when_driven_backwards() -> None:
    """eta F (5.38): 5 % of the energy appears."""
    solution = pushed(efficiency="printed").simulate(
        1e-3, inputs={"push.v": -0.1}, parameters={"cylinder.c": 0.0}
    )
    F = 100e5 * 7.13e-5 - 50e5 * 5.35e-5
    assert solution.final("cylinder.P_loss") == pytest.approx(-0.05 * F * 0.1, rel=1e-9)


def test_piston_leakage() -> None:
    solution = pushed().simulate(1e-3, parameters={"cylinder.G_leak": 1e-13})
    assert solution.final("cylinder.q_leak") == pytest.approx(1e-13 * 50e5, rel=1e-9)


class Free(Component):
    """A cylinder with air-tight ports that runs into its stop."""

    cylinder: Cylinder = Cylinder(
        y=start(0.034, fixed=True),
        v=start(0.5, fixed=True),
        p_A=start(0.0, fixed=True),
        p_B=start(0.0, fixed=True),
    )


@pytest.mark.parametrize("stop_events", [False, True])
def test_a_stop_throws_the_piston_back(stop_events: bool) -> None:
    """Half a period of m and k (oil left out by a soft fluid): deepest at v sqrt(m/k), back with the same speed."""
    cylinder = Cylinder(
        c=0.0,
        eta=1.0,
        stop_events=stop_events,
        fluid=Fluid(beta=1.0, constant_density=True),
        y=start(0.034, fixed=True),
        v=start(0.5, fixed=True),
        p_A=start(0.0, fixed=True),
        p_B=start(0.0, fixed=True),
    )
    solution = translate(Free(cylinder=cylinder)).simulate(5e-3, tolerance=1e-9)
    assert solution.final("cylinder.v") == pytest.approx(-0.5, rel=1e-4)
    assert max(solution["cylinder.y"]) == pytest.approx(0.035 + 0.5 * (0.05 / 1.436e6) ** 0.5, rel=1e-4)
    assert len([e for e in solution.events if e.kind == "state"]) == (2 if stop_events else 0)


class Breathing(Component):
    """A reservoir by itself."""

    reservoir: GasReservoir = GasReservoir()


@pytest.mark.parametrize("gas", ["algebraic", "integrated"])
def test_the_reservoir_rings_at_4_2_kilohertz(gas: GasLaw) -> None:
    """omega = A_R sqrt(beta/(V_f m_p)) = 2.6e4 rad/s, damping ratio 0.005 (Table 11)."""
    reservoir = GasReservoir(
        gas=gas, p=start(4e5, fixed=True), z=start(0.04, fixed=True), v=start(0.0, fixed=True)
    )
    solution = translate(Breathing(reservoir=reservoir)).simulate(
        20 / 4.2e3, options=SolverOptions(rtol=1e-8, intervals=4000)
    )
    v = solution["reservoir.v"]
    rising = np.flatnonzero((v[:-1] < 0) & (v[1:] >= 0))
    omega = 2 * pi * (len(rising) - 1) / (solution.t[rising[-1]] - solution.t[rising[0]])
    assert omega == pytest.approx(1.15e-3 * (1.4e9 / (6.9e-5 * 0.04)) ** 0.5, rel=0.01)
    turn = [max(v[i:j]) for i, j in pairwise(rising)]
    decay = np.log(turn[0] / turn[-1]) / (2 * pi * (len(turn) - 1))
    assert decay == pytest.approx(10 / (2 * 0.04 * omega), rel=0.02)


def test_the_two_gas_laws_agree() -> None:
    finals = []
    gas: GasLaw
    for gas in ("algebraic", "integrated"):
        reservoir = GasReservoir(gas=gas, p=start(4e5, fixed=True))
        finals.append(
            translate(Breathing(reservoir=reservoir)).simulate(1e-3, tolerance=1e-9).final("reservoir.p_g")
        )
    assert finals[0] == pytest.approx(finals[1], rel=1e-8)
