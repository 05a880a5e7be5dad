"""Reading of Hopsan's models: each counterpart is a sound component, and small circuits meet their closed forms."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, exp, pi, sqrt
from typing import Any

import pytest

from arthur_acausal import Solution, SolverOptions, UsageError, translate
from arthur_acausal.flatten.flatten import flatten
from arthur_acausal.models.conformance.hopsan import Assembly, Reader, nodes_of
from arthur_acausal.models.conformance.hopsan_given import Given, fluid
from arthur_acausal.models.conformance.hopsan_table import TABLE

Part = tuple[str, str, dict[str, Any]]


@pytest.mark.parametrize("kind", TABLE)
def test_a_counterpart_balances_and_has_the_ports_and_signals_of_the_table(kind: str) -> None:
    counterpart = TABLE[kind]
    made = counterpart.make(Given("part", kind, {}, {}, frozenset(counterpart.signals), fluid(), 1e-3))
    for name in [*counterpart.ports.values(), *counterpart.signals.values()]:
        assert hasattr(type(made), name)
    flat = flatten(made)
    assert flat.n_equations == len(flat.variables)


def case(parts: Sequence[Part], links: Sequence[tuple[str, str]]) -> dict[str, Any]:
    """Return what a case.json of these components says."""
    return {
        "simulation": {"start": "0", "stop": "1", "timestep": "0.001"},
        "components": [
            {"name": name, "type": kind, "parameters": {k: {"value": str(v)} for k, v in values.items()}}
            for name, kind, values in parts
        ],
        "connections": [list(link) for link in links],
    }


def run(
    parts: Sequence[Part], links: Sequence[tuple[str, str]], stop: float = 1.0
) -> tuple[Solution, Reader]:
    reader = Reader(case(parts, links))
    options = SolverOptions(rtol=1e-8, intervals=1000)
    return translate(Assembly(plan=reader.plan)).simulate(stop, options=options), reader


def final(found: tuple[Solution, Reader], signal: str) -> float:
    solution, reader = found
    path, sign = reader.path(signal)
    return sign * float(solution.final(path))


def test_an_orifice_between_two_sources() -> None:
    """q = C_q A sqrt(2 dp/rho) with the orifice's own density."""
    found = run(
        [
            ("high", "HydraulicPressureSourceC", {"p#Value": 9e6}),
            ("low", "HydraulicTankC", {"p#Value": 1e6}),
            ("orifice", "HydraulicTurbulentOrifice", {"A#Value": 1e-5, "C_q#Value": 0.6, "rho#Value": 900}),
            ("meter", "HydraulicFlowSensor", {}),
        ],
        [("high.P1", "orifice.P1"), ("orifice.P2", "low.P1"), ("meter.P1", "low.P1")],
    )
    q = 0.6 * 1e-5 * sqrt(2 * 8e6 / 900)
    assert final(found, "model$meter#out#Value") == pytest.approx(q, rel=1e-6)  # into what stores
    assert final(found, "orifice#P2#Flow") == pytest.approx(q, rel=1e-6)  # out of what does not
    assert final(found, "orifice#P1#Flow") == pytest.approx(-q, rel=1e-6)
    assert final(found, "orifice#P1#Pressure") == 9e6


@pytest.mark.parametrize(("dp", "share"), [(4e5, 1.0), (-4e5, 0.0), (5e4, 0.0)])
def test_a_check_valve(dp: float, share: float) -> None:
    """K_s sqrt(dp) above the cracking pressure, nothing else."""
    found = run(
        [
            ("a", "HydraulicPressureSourceC", {"p#Value": 1e6 + dp}),
            ("b", "HydraulicPressureSourceC", {"p#Value": 1e6}),
            ("valve", "HydraulicCheckValvePreLoaded", {"K_s": 2e-7, "p_f#Value": 1e5}),
        ],
        [("a.P1", "valve.P1"), ("valve.P2", "b.P1")],
    )
    assert final(found, "valve#P2#Flow") == pytest.approx(share * 2e-7 * sqrt(abs(dp)), rel=1e-6, abs=1e-12)


@pytest.mark.parametrize(("pilot", "open_"), [(1.0e6, False), (4.5e6, True)])
def test_a_pilot_opens_a_check_valve(pilot: float, open_: bool) -> None:
    """Against the load it opens where p_x > p_b + (p_a - p_b)/phi + p_f: 5 - 4/4 + 0.1 MPa here."""
    found = run(
        [
            ("a", "HydraulicPressureSourceC", {"p#Value": 1e6}),
            ("b", "HydraulicPressureSourceC", {"p#Value": 5e6}),
            ("x", "HydraulicPressureSourceC", {"p#Value": pilot}),
            ("valve", "HydraulicPilotControlledCheckValve", {"K_s": 2e-7, "p_f#Value": 1e5, "phi#Value": 4}),
        ],
        [("a.P1", "valve.P1"), ("valve.P2", "b.P1"), ("x.P1", "valve.P_PILOT")],
    )
    assert final(found, "valve#P1#Flow") == pytest.approx(open_ * 2e-7 * sqrt(4e6), rel=1e-6)


@pytest.mark.parametrize(("command", "q_a"), [(0.0, -1.0), (1.0, 1.0)])
def test_an_on_off_valve_joins_a_to_either_side(command: float, q_a: float) -> None:
    values = {"x_vmax#Value": 0.002, "d#Value": 0.01, "rho#Value": 870, "C_q#Value": 0.67}
    found = run(
        [
            ("p", "HydraulicPressureSourceC", {"p#Value": 10e6}),
            ("a", "HydraulicPressureSourceC", {"p#Value": 5e6}),
            ("t", "HydraulicTankC", {"p#Value": 0}),
            ("on", "SignalConstant", {"y#Value": command}),
            ("valve", "Hydraulic32DirectionalValve", values),
        ],
        [("p.P1", "valve.PP"), ("a.P1", "valve.PA"), ("t.P1", "valve.PT"), ("on.y", "valve.in")],
    )
    q = 0.67 * pi * 0.01 * 0.002 * sqrt(2 * 5e6 / 870)
    assert final(found, "valve#PA#Flow") == pytest.approx(q_a * q, rel=1e-6)


def test_a_proportional_valve_follows_its_command_in_metres() -> None:
    """A critically damped spool after a step: x = x_0 (1 - (1 + omega t) exp(-omega t))."""
    found = run(
        [
            ("p", "HydraulicPressureSourceC", {"p#Value": 10e6}),
            ("a", "HydraulicPressureSourceC", {"p#Value": 5e6}),
            ("x", "SignalConstant", {"y#Value": 1e-3}),
            ("valve", "Hydraulic22Valve", {"omega_h": 100, "delta_h": 1, "x_vmax#Value": 0.01}),
        ],
        [("p.P1", "valve.PP"), ("a.P1", "valve.PA"), ("x.y", "valve.in")],
        stop=0.02,
    )
    assert final(found, "valve#xv#Value") == pytest.approx(1e-3 * (1 - 3 * exp(-2.0)), rel=1e-6)


@pytest.mark.parametrize(("x", "p_load"), [(1e-3, 5e6), (-1e-3, 3e6)])
def test_a_load_sensing_valve_tells_the_pressure_of_the_port_that_it_feeds(x: float, p_load: float) -> None:
    found = run(
        [
            ("p", "HydraulicPressureSourceC", {"p#Value": 10e6}),
            ("a", "HydraulicPressureSourceC", {"p#Value": 5e6}),
            ("b", "HydraulicPressureSourceC", {"p#Value": 3e6}),
            ("t", "HydraulicTankC", {"p": 1e5}),
            ("x", "SignalConstant", {"y#Value": x}),
            ("sensed", "HydraulicVolumeMultiPort", {"V#Value": 1e-4}),
            ("valve", "Hydraulic43LoadSensingValve", {"omega_h": 1000}),
        ],
        [
            ("p.P1", "valve.PP"),
            ("a.P1", "valve.PA"),
            ("b.P1", "valve.PB"),
            ("t.P1", "valve.PT"),
            ("sensed.P1", "valve.PL"),
            ("x.y", "valve.in"),
        ],
    )
    assert final(found, "valve#PL#Pressure") == pytest.approx(p_load, rel=1e-6)


@pytest.mark.parametrize(
    ("kind", "values", "expected"),
    [
        ("SignalSineWave", {"f#Value": 0.25, "y_A#Value": 3, "y_offset#Value": 0.5}, 3 * sqrt(0.5)),
        ("SignalSquareWave", {"f#Value": 0.4, "y_0#Value": 1, "y_A#Value": 3}, 4.0),
        ("SignalSquareWave", {"f#Value": 0.6, "y_0#Value": 1, "y_A#Value": 3}, -2.0),
        ("SignalPulseWave", {"dT#Value": 0.8, "D#Value": 0.3, "y_A#Value": 3}, 3.0),
        ("SignalPulseWave", {"dT#Value": 0.8, "D#Value": 0.2, "y_A#Value": 3}, 0.0),
        ("SignalSoftStep", {"t_start#Value": 0.5, "t_end#Value": 1.5, "y_0#Value": 1, "y_A#Value": 3}, 2.5),
        ("SignalPulse", {"t_start#Value": 0.5, "t_end#Value": 0.9, "y_0#Value": 1, "y_A#Value": 3}, 1.0),
        ("SignalRamp", {"t_start#Value": 0.5, "t_end#Value": 2.5, "y_0#Value": 1, "y_A#Value": 4}, 2.0),
    ],
)
def test_a_signal_after_one_second(kind: str, values: dict[str, Any], expected: float) -> None:
    parts = [("source", kind, values), ("gain", "SignalGain", {"k#Value": 2})]
    found = run(parts, [("source.out", "gain.in")])
    assert final(found, "gain#out#Value") == pytest.approx(2 * expected, abs=1e-9)


def test_a_volume_fills_through_a_laminar_orifice() -> None:
    """p = p_s (1 - exp(-t Kc beta/V)), with a bulk modulus of the volume's own."""
    found = run(
        [
            ("supply", "HydraulicPressureSourceC", {"p#Value": 1e7}),
            ("orifice", "HydraulicLaminarOrifice", {"Kc#Value": 1e-12}),
            ("volume", "HydraulicVolumeMultiPort", {"V#Value": 1e-3, "Beta_e#Value": 5e8, "P1#Pressure": 0}),
            ("gauge", "HydraulicPressureSensor", {}),
        ],
        [("supply.P1", "orifice.P1"), ("orifice.P2", "volume.P1"), ("gauge.P1", "volume.P1")],
        stop=2.0,
    )
    assert final(found, "gauge#out#Value") == pytest.approx(1e7 * (1 - exp(-1.0)), rel=1e-5)


def test_a_mass_on_a_spring_swings_and_both_ends_count_outwards() -> None:
    """x = F/k + (x_0 - F/k) cos(sqrt(k/m) t); the other end counts the other way; what is loose does not matter."""
    free = {"B#Value": 0, "x_min#Value": -9, "x_max#Value": 9}
    found = run(
        [
            ("mass", "MechanicTranslationalMass", {"m": 4, "P2#Position": 0.1, **free}),
            ("spring", "MechanicTranslationalSpring", {"k#Value": 100}),
            ("wall", "MechanicFixedPosition", {}),
            ("right", "MechanicPositionSensor", {}),
            ("left", "MechanicPositionSensor", {}),
            ("push", "MechanicForceTransformer", {"F#Value": 5, "P1#Position": -0.1}),
            ("loose", "MechanicForceTransformer", {"F#Value": 7}),
        ],
        [
            ("mass.P2", "spring.P1"),
            ("spring.P2", "wall.Pm1"),
            ("right.P1", "mass.P2"),
            ("push.P1", "mass.P1"),
            ("left.P1", "mass.P1"),
        ],
    )
    x = 0.05 + (0.1 - 0.05) * cos(5.0)
    assert final(found, "left#out#Value") == pytest.approx(-x, rel=1e-5)
    assert final(found, "right#out#Value") == pytest.approx(x, rel=1e-5)


def test_a_motor_runs_up_against_its_friction() -> None:
    """w = D dp/(2 pi B) (1 - exp(-B t/J)); a torque that is connected works against it."""
    found = run(
        [
            ("p", "HydraulicPressureSourceC", {"p#Value": 2e7}),
            ("t", "HydraulicTankC", {"p#Value": 0}),
            (
                "motor",
                "HydraulicFixedDisplacementMotorQ",
                {"D_m#Value": 5e-5, "B_m#Value": 0.2, "J_m#Value": 0.1},
            ),
            ("load", "MechanicTorqueTransformer", {"T#Value": 50}),
            ("speed", "MechanicAngularVelocitySensor", {}),
        ],
        [("p.P1", "motor.P1"), ("motor.P2", "t.P1"), ("load.P1", "motor.P3"), ("speed.P1", "motor.P3")],
    )
    torque = 5e-5 * 2e7 / (2 * pi) - 50
    assert final(found, "speed#out#Value") == pytest.approx(torque / 0.2 * (1 - exp(-2.0)), rel=1e-5)


@pytest.mark.parametrize(
    ("parts", "links", "message"),
    [
        (
            [("x", "HydraulicWarpDrive", {})],
            [("x.P1", "x.P1")],
            r"HydraulicWarpDrive \(x\) has no counterpart",
        ),
        ([], [("x.P1", "y.P1")], "there is no component 'x'"),
        (
            [("x", "HydraulicTankC", {"p#Value": "__import__('os')"}), ("y", "HydraulicPressureSensor", {})],
            [("x.P1", "y.P1")],
            "x.p is not a number",
        ),
    ],
)
def test_what_is_not_known_is_refused(parts: list[Part], links: list[tuple[str, str]], message: str) -> None:
    with pytest.raises(UsageError, match=message):
        translate(Assembly(plan=Reader(case(parts, links)).plan))


def test_nodes_are_sets_of_ports_however_they_are_connected() -> None:
    a, b, c, d, e = (("x", port) for port in "abcde")
    found = sorted(sorted(node) for node in nodes_of([(a, b), (c, d), (b, d), (e, e)]))
    assert found == [[a, b, c, d], [e]]
