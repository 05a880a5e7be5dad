"""Drives of the Modelica Standard Library against closed forms and conservation laws."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from arthur_acausal import Component, Equations, Solution, SolverOptions, connect, simulate, start
from arthur_acausal.components.blocks import Ramp
from arthur_acausal.components.translational import ForceSource, MassWithStopAndFriction
from arthur_acausal.models.conformance import msl_drives, msl_losses, msl_mechanics, msl_thermal

CASES = msl_drives.CASES | msl_losses.CASES | msl_thermal.CASES
PRECISE = SolverOptions(rtol=1e-8, intervals=1000)


class Pushed(Component):
    """100 N, then from 0.4 s on a ramp of -1000 N/s, on a mass with a stop at 1 m."""

    mass = MassWithStopAndFriction(
        m=1.0, s_max=1.0, F_C=1.0, F_St=2.0, F_v=0.5, s=start(0.0, fixed=True), v=start(0.0, fixed=True)
    )
    force = ForceSource()
    ramp: Ramp = Ramp.of("N")(offset=100.0, height=-1000.0, duration=1.0, start_time=0.4)

    def equations(self) -> Equations:
        yield connect(self.ramp.y, self.force.f)
        yield connect(self.force.flange, self.mass.flange_a)


def run(name: str, stop_time: float) -> Solution:
    return simulate(CASES[f"msl_{name}"].model(), stop_time=stop_time, options=PRECISE)


@pytest.mark.parametrize(
    ("name", "part", "speed"),
    [("Rotational_EddyCurrentBrake", "inertia", "w"), ("Translational_EddyCurrentBrake", "mass", "v")],
)
def test_an_eddy_current_brake_turns_all_kinetic_energy_to_heat(name: str, part: str, speed: str) -> None:
    """20^2/2 J into 1 J/K."""
    solution = run(f"Mechanics_{name}", 1.0)
    w, T = solution[f"{part}.{speed}"], solution["heatCapacitor.T"]
    assert T - 293.15 == pytest.approx((400 - w**2) / 2, abs=1e-4)
    k = int(np.argmin(abs(solution.t - 0.3)))
    x = w[k] / (10 * (1 + 3.92e-3 * (T[k] - 293.15)))
    brake = "eddyCurrentTorque" if part == "inertia" else "eddyCurrentForce"
    assert solution[f"{brake}.P_loss"][k] == pytest.approx(200 * x / (1 + x**2) * w[k], rel=1e-9)


@pytest.mark.parametrize(
    ("name", "speeds"),
    [
        ("Rotational_CompareBrakingTorque", [f"inertia{k}.w" for k in range(1, 5)]),
        ("Translational_CompareBrakingForce", [f"mass{k}.v" for k in range(1, 5)]),
    ],
)
def test_four_laws_of_braking(name: str, speeds: list[str]) -> None:
    """v' = -100; -v; -v^2/100; -1e4/v, from 100."""
    solution = run(f"Mechanics_{name}", 0.45)
    t = solution.t
    laws = (100 - 100 * t, 100 * np.exp(-t), 100 / (1 + t), np.sqrt(1e4 - 2e4 * t))
    for speed, law in zip(speeds, laws, strict=True):
        assert solution[speed] == pytest.approx(law, abs=1e-4), speed


def test_a_gear_is_shifted_from_the_ring_held_to_the_ring_with_the_sun() -> None:
    solution = run("Mechanics_Rotational_SimpleGearShift", 5.0)
    before = (solution.t > 0.6) & (solution.t < 2.0)
    after = solution.t > 2.5
    engine, load = solution["engine.w"], solution["load.w"]
    assert engine[before] == pytest.approx(2.5 * load[before], abs=1e-6)
    assert engine[after] == pytest.approx(load[after], abs=1e-6)
    ends = {p: solution.final(p) for p in ("clutch.mode", "brake.mode")}
    assert ends == {"clutch.mode": 0.0, "brake.mode": 2.0}
    law = solve_ivp(
        lambda t, w: (20 * 2.5 - 20 * (w / 10.471975511966) ** 2) / (10 + 6.25), (0.5, 2.0), [0.0], rtol=1e-10
    )
    assert solution.at(2.0 - 1e-9, "load.w") == pytest.approx(law.y[0, -1], abs=1e-4)


def test_the_drive_on_the_ground_is_the_one_with_supports() -> None:
    solution = run("Mechanics_Rotational_FirstGrounded", 1.0)
    first = simulate(msl_mechanics.First(), stop_time=1.0, options=PRECISE)
    assert solution["inertia3.w"] == pytest.approx(first["inertia3.w"], abs=1e-6)


def test_forces_act_by_their_sign() -> None:
    solution = run("Mechanics_Translational_SignConvention", 1.0)
    for k in (1, 2, 3):
        assert (solution.final(f"mass{k}.s"), solution.final(f"mass{k}.v")) == pytest.approx((0.5, 1.0))


def test_stribeck_friction_by_law_and_by_table_agree_and_a_stop_holds() -> None:
    solution = run("Mechanics_Translational_Friction", 5.0)
    assert solution["stop1.v"] == pytest.approx(solution["mass.v"], abs=0.1)
    sliding = np.abs(solution["stop1.v"]) > 0.1
    v = np.abs(solution["stop1.v"][sliding])
    assert np.abs(solution["stop1.f"][sliding]) == pytest.approx(5 + v + 10 * np.exp(-2 * v), abs=1e-6)
    assert solution["stop2.s"].min() == pytest.approx(-0.4, abs=1e-6)
    hit = [e.time for e in solution.events if e.kind == "when"]
    law = solve_ivp(  # from s = 0 with -5 m/s to the stop: spring and friction
        lambda t, x: [x[1], -500 * (x[0] + 0.25) + 3 - x[1] + 5 * np.exp(2 * x[1])],
        (0.0, 1.0),
        [0.0, -5.0],
        rtol=1e-10,
        events=lambda t, x: x[0] + 0.4,
    )
    assert hit[0] == pytest.approx(law.t_events[0][0], abs=1e-6)
    after = solution.t > hit[0] + 1e-3
    assert solution["stop2.s"][after].min() >= -0.4 - 1e-6


def test_a_stop_holds_a_mass_against_any_force_and_lets_it_go() -> None:
    """It is pushed into the stop by 100 N and pulled off by what is above 3.003 N."""
    solution = simulate(Pushed(), stop_time=1.0, options=PRECISE)
    hit = next(e.time for e in solution.events if e.kind == "when")
    held = (solution.t > hit + 1e-6) & (solution.t < 0.503003 - 1e-6)
    assert held.sum() > 100
    assert solution["mass.s"][held] == pytest.approx(1.0, abs=1e-9)
    assert (solution["mass.mode"][held] == 0.0).all()
    assert solution.final("mass.s") < 0.5


def test_a_vehicle_reaches_the_speed_of_balance_and_stops() -> None:
    """At the nominal torque driving resistances balance: 1.18/1.2 of the drag."""
    solution = run("Mechanics_Translational_Vehicle", 60.0)
    balance = 25 / 3.5 * np.sqrt(1.18 / 1.2)
    assert solution.at(49.9, "vehicle.v") == pytest.approx(balance, rel=1e-2)
    assert solution["vehicle1.v"] == pytest.approx(
        solution["vehicle.v"], abs=1e-6
    )  # twice the torque and mass
    assert solution.final("vehicle.v") == pytest.approx(0.0, abs=1e-6)


def test_a_motor_warms_by_its_losses() -> None:
    solution = run("Thermal_HeatTransfer_Motor", 360.0)

    def law(t: float, T: np.ndarray) -> list[float]:
        winding = 100 * (1 + 3.03e-3 * (T[0] - 368.15))
        across = 10 * (T[0] - T[1])
        return [(winding - across) / 2500, (500 + across - 25 * (T[1] - 293.15)) / 25000]

    reference = solve_ivp(law, (0.0, 360.0), [293.15, 293.15], rtol=1e-10, atol=1e-9).y[:, -1]
    assert [solution.final("winding.T"), solution.final("core.T")] == pytest.approx(reference, abs=1e-4)


def test_a_drive_with_heat_ports_keeps_its_energy_balance() -> None:
    solution = run("Mechanics_Rotational_HeatLosses", 0.05)
    t = solution.t
    given = np.trapezoid(solution["torque.tau"] * solution["inertia1.w"], t)
    heat = np.trapezoid(solution["convection.Q_flow"], t)
    kinetic = sum(solution.final(f"inertia{k}.E_kinetic") for k in range(1, 7))
    twist = (
        1e4 * solution.final("springDamper.phi_rel") ** 2 + 1e5 * solution.final("elastoBacklash.depth") ** 2
    )
    elastic = twist / 2 + solution.final("spring3.E_elastic")
    assert given == pytest.approx(heat + kinetic + elastic, rel=2e-3)
