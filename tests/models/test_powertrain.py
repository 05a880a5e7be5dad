"""The powertrain: start, options, energy and mass, and what its figures must be."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import pi
from typing import Any

import numpy as np
import pytest

from arthur_acausal import Solution, SolverOptions, Translation, UsageError, translate
from arthur_acausal.models.arthur.demo import Demo, demo_inputs
from arthur_acausal.models.arthur.options import VARIANTS, Options
from arthur_acausal.models.arthur.powertrain import Powertrain

CHOICES = {
    "dc motor": Options(motor_law="dc"),
    "battery": Options(supply="battery"),
    "consistent sizing": Options(sizing="consistent"),
    "listing's relief valve": Options(relief_law="listing"),
    "second-order spool": Options(spool="second order"),
    "filter by the pump's flow": Options(filter_drop="pump flow"),
    "printed efficiency": Options(efficiency="printed"),
    "stribeck": Options(stribeck=True),
    "integrated gas": Options(gas="integrated"),
    "air": Options(air=True),
    "cavitation": Options(cavitation=True),
    "constant density": Options(constant_density=True),
    "stop events": Options(stop_events=True),
    "listing": VARIANTS["listing"],
}


@cache
def demo(**arguments: Any) -> Translation:
    """Translate the demonstration once a structure."""
    return translate(Demo(**arguments))


@cache
def second() -> Solution:
    """One second of the default demonstration at rtol 1e-6."""
    return demo().simulate(1.0, options=SolverOptions(rtol=1e-6, intervals=1000))


def test_it_starts_as_table_5_says() -> None:
    solution, n = second(), 12
    assert solution.initial("motor.w") == 0
    for path in ["manifold.p", "reservoir.p", "reservoir.p_g"]:
        assert solution.initial(path) == 3e5
    assert solution.initial("reservoir.z") == 0.04
    for i in range(n):
        assert [solution.initial(f"cylinders[{i}].{x}") for x in ("v", "y", "p_A", "p_B")] == [0, 0, 3e5, 3e5]


def test_its_states_are_those_of_the_report_and_the_meters() -> None:
    """N (with the angle), p_d, four of each actuator, three of the reservoir; the gas pressure is algebraic."""
    states = set(demo().report.states)
    meters = {path for path in states if path.startswith("energy_")}
    assert len(meters) == 11 + 12
    assert len(states - meters) == 2 + 1 + 4 * 12 + 3
    assert set(demo(audit=False).report.states) == states - meters


def test_the_second_shows_what_a_powertrain_does() -> None:
    solution = second()
    assert solution.final("motor.w") * 30 / pi == pytest.approx(5060, abs=100)
    assert np.max(solution["motor.I"]) <= 50.0
    late = solution.t > 0.3
    assert np.min(solution["manifold.p"][late]) > 190e5
    assert np.max(solution["relief.q"]) > 1e-5
    for i in range(12):
        assert np.max(np.abs(solution[f"cylinders[{i}].y"])) < 0.035
        assert 0.03 < np.max(np.abs(solution[f"cylinders[{i}].v"])) < 0.2
    # diagonal legs move together
    assert solution["cylinders[1].y"] == pytest.approx(solution["cylinders[10].y"], abs=1e-5)


def test_energy_closes_within_1e_4_of_the_input() -> None:
    energy = second().energy()
    assert abs(energy.closure) <= 1e-4
    assert energy.input_J > 1000
    assert energy.work_J > 20
    assert set(energy.losses_J) == {
        "copper", "motor_friction", "pump_friction", "pump_leakage", "pump_compression",
        "relief", "filter", "cylinders", "reservoir", *(f"valves[{i}]" for i in range(12)),
    }  # fmt: skip
    assert min(energy.losses_J.values()) > 0


def test_the_meters_agree_with_the_powers_over_the_output_grid() -> None:
    powers = demo(audit=False).simulate(1.0, options=SolverOptions(rtol=1e-6, intervals=5000)).energy()
    meters = second().energy()
    assert powers.input_J == pytest.approx(meters.input_J, rel=1e-3)
    assert powers.losses_J["relief"] == pytest.approx(meters.losses_J["relief"], rel=1e-2)
    assert abs(powers.closure) <= 1e-3


def test_the_listing_prints_its_own_closure() -> None:
    """Its laws do not conserve energy: constant density, eta F, sqrt(2 p_d), 6.1."""
    energy = demo(variant="listing").simulate(1.0, tolerance=1e-5).energy()
    assert 1e-4 < abs(energy.closure) < 0.1


def mass(solution: Solution) -> Any:
    """Mass of all fluid [kg] over time."""
    parts = ["manifold.m", "reservoir.m_fluid", *(f"cylinders[{i}].m_fluid" for i in range(12))]
    return sum(solution[path] for path in parts)


def test_fluid_mass_drifts_less_than_1e_6_in_ten_seconds() -> None:
    total = mass(demo(audit=False).simulate(10.0, tolerance=1e-6))
    assert np.max(np.abs(total / total[0] - 1)) <= 1e-6


def test_the_report_s_law_of_compression_does_not_keep_mass() -> None:
    """5.39 with volume flows: rho V changes by what is compressed, some 1e-3 of the fluid."""
    rig = demo(options=Options(constant_density=True), audit=False)
    solution = rig.simulate(0.3, tolerance=1e-6)
    rho = {path: 850 * np.exp(solution[path] / 1.4e9) for path in ("manifold.p", "reservoir.p")}
    true = rho["manifold.p"] * 4.83e-6 + rho["reservoir.p"] * solution["reservoir.V_f"]
    for i in range(12):
        for side in "AB":
            c = f"cylinders[{i}]"
            true = true + 850 * np.exp(solution[f"{c}.p_{side}"] / 1.4e9) * solution[f"{c}.V_{side}"]
    assert 1e-5 < np.max(np.abs(true / true[0] - 1)) < 1e-2


@pytest.mark.parametrize("name", CHOICES)
def test_every_choice_runs(name: str) -> None:
    solution = demo(n=2, options=CHOICES[name]).simulate(0.2, tolerance=1e-5)
    assert solution.t[-1] == 0.2
    assert np.max(solution["manifold.p"]) > 150e5


@pytest.mark.parametrize(
    "name",
    [
        n
        for n in CHOICES
        if n not in ("listing", "listing's relief valve", "constant density", "filter by the pump's flow")
    ],
)
def test_energy_closes_with_every_consistent_choice(name: str) -> None:
    energy = demo(n=2, options=CHOICES[name]).simulate(0.2, tolerance=1e-6).energy()
    assert abs(energy.closure) <= 1e-4


def test_inputs_of_the_run_drive_it_as_the_demo_s_sources_do() -> None:
    """External inputs by path: motor.V, valves[i].I, loads[i].F."""
    driven = translate(Powertrain(n=2)).simulate(0.1, inputs=demo_inputs(2), tolerance=1e-7)
    sourced = demo(n=2).simulate(0.1, tolerance=1e-7)
    for path in ("manifold.p", "motor.w", "cylinders[1].y"):
        scale = np.ptp(sourced[path])
        assert np.max(np.abs(driven[path] - sourced[path])) < 1e-4 * scale


def test_new_parameters_need_no_new_translation() -> None:
    rig = demo(n=2)
    cracked = rig.simulate(0.2, parameters={"relief.p_c": "140 bar"}, tolerance=1e-5)
    assert 140e5 < np.max(cracked["manifold.p"]) < 145e5
    bigger = rig.simulate(0.2, parameters={"Q_req": "1.25 gpm"}, tolerance=1e-5)
    plain = rig.simulate(0.2, tolerance=1e-5)
    assert bigger.final("pump.q_displaced") / bigger.final("motor.w") == pytest.approx(
        1.25 * 15852 / 15850.323 * plain.final("pump.q_displaced") / plain.final("motor.w"), rel=1e-4
    )


def test_an_unknown_variant_names_the_known_ones() -> None:
    with pytest.raises(UsageError, match="listing"):
        translate(Powertrain(variant="listnig"))
    with pytest.raises(UsageError, match="friction"):
        replace(Options(), efficiency="frictoin")  # type: ignore[arg-type]


def test_current_and_flow_while_the_motor_is_clamped() -> None:
    """At the limit the terminal voltage is R_LL I + K_e w: electrical power stays copper loss and shaft power."""
    solution = demo(n=2).simulate(0.05, parameters={"voltage.amplitude": 60.0}, tolerance=1e-6)
    clamped = solution["motor.I"] > 49.999
    assert np.any(clamped)
    shaft = solution["motor.tau"] * solution["motor.w"]
    taken = solution["motor.P_el"] - solution["motor.P_copper"]
    assert taken[clamped] == pytest.approx(shaft[clamped], rel=1e-9)
