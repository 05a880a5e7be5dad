"""Laws of flow: passive, symmetric, and as accurate as they say."""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest
from casadi import SX
from hypothesis import given, settings
from hypothesis import strategies as st

from arthur_acausal import Solution, Translation, translate
from arthur_acausal.components.hydraulic import (
    CheckValve,
    Filter,
    Fluid,
    LaminarPipe,
    LinearResistance,
    Orifice,
    Pipe,
    ReliefValve,
    ServoValve,
    TwoPort,
)
from arthur_acausal.components.hydraulic.laws import exact_root, turbulent_root
from tests.components.rigs import BetweenPressures, ValveBetweenPressures

PRESSURES = st.floats(0.0, 3e7)
PARTS: dict[str, TwoPort] = {
    "orifice": Orifice(area=1e-6),
    "linear": LinearResistance(R=1e11),
    "laminar": LaminarPipe(L=1.0, d=4e-3),
    "pipe": Pipe(L=1.0, d=4e-3),
    "check": CheckValve(A_max=1e-5, A_leak=1e-9),
    "relief": ReliefValve(A_leak=1e-9),
    "filter": Filter(),
}
SYMMETRIC = ("orifice", "linear", "laminar", "pipe", "filter")


@cache
def translated(name: str) -> Translation:
    """Translate one part between two pressures; interpreted, as it is evaluated a few times only."""
    return translate(BetweenPressures(part=PARTS[name], fluid=Fluid()), compile="never")


def evaluate(rig: Translation, inputs: dict[str, Any], **arguments: Any) -> Solution:
    """Solve a rig without states at one instant."""
    return rig.simulate(1e-3, inputs=inputs, **arguments)


def flow(name: str, p_a: float, p_b: float) -> tuple[float, float]:
    """Return flow [m^3/s] and loss [W] of a part between two pressures."""
    solution = evaluate(translated(name), {"a.p": p_a, "b.p": p_b})
    return solution.final("part.q"), solution.final("part.P_loss")


@pytest.mark.parametrize("name", PARTS)
@settings(max_examples=25)
@given(p_a=PRESSURES, p_b=PRESSURES)
def test_what_lets_fluid_pass_is_passive(name: str, p_a: float, p_b: float) -> None:
    q, loss = flow(name, p_a, p_b)
    assert q * (p_a - p_b) >= 0
    assert loss >= 0


@pytest.mark.parametrize("name", SYMMETRIC)
@settings(max_examples=10)
@given(p_a=PRESSURES, p_b=PRESSURES)
def test_flow_is_symmetric(name: str, p_a: float, p_b: float) -> None:
    assert flow(name, p_a, p_b)[0] == pytest.approx(-flow(name, p_b, p_a)[0], rel=1e-9, abs=1e-18)


def smoothed(dp: float, dp_small: float) -> float:
    """Evaluate the root with its laminar transition."""
    return float(turbulent_root(SX(dp), SX(dp_small)))


def exact(dp: float) -> float:
    """Evaluate the root without."""
    return float(exact_root(SX(dp), SX(1e3)))


@given(dp=st.floats(-1e8, 1e8), dp_small=st.floats(1.0, 1e5))
def test_the_laminar_transition_is_odd_and_increasing(dp: float, dp_small: float) -> None:
    root = smoothed(dp, dp_small)
    assert root == -smoothed(-dp, dp_small)
    assert smoothed(dp + 1.0, dp_small) > root


@given(dp=st.floats(1e4, 1e8))
def test_the_root_is_met_where_the_drop_is_large(dp: float) -> None:
    assert smoothed(dp, 1e3) == pytest.approx(dp**0.5, rel=(1e3 / dp) ** 2 / 4 * 1.01)
    assert exact(dp) == pytest.approx(dp**0.5, rel=1e-15)
    assert exact(-dp) == -exact(dp)


def test_an_orifice_passes_what_its_formula_says() -> None:
    """C_d A sqrt(2 dp/rho): 0.7 mm^2 at 100 bar, 850 kg/m^3."""
    assert flow("orifice", 100e5, 0.0)[0] == pytest.approx(0.7 * 1e-6 * (2 * 100e5 / 850) ** 0.5, rel=1e-7)


def test_a_pipe_turns_turbulent() -> None:
    """Laminar below Re = 1187 (Hagen and Poiseuille), Blasius' 0.3164 Re^(-1/4) above."""
    slow = evaluate(translated("pipe"), {"a.p": 1e4, "b.p": 0.0})
    laminar = flow("laminar", 1e4, 0.0)[0]
    assert slow.final("part.Re") < 1187
    assert slow.final("part.q") == pytest.approx(laminar, rel=1e-9)
    fast = evaluate(translated("pipe"), {"a.p": 150e5, "b.p": 0.0})
    Re, q = fast.final("part.Re"), fast.final("part.q")
    v = q / (3.141592653589793 * 2e-3**2)
    assert 3000 < Re < 1e5
    assert 0.3164 * Re**-0.25 / 4e-3 * 850 * v**2 / 2 == pytest.approx(150e5, rel=1e-6)


@cache
def valve(**options: Any) -> Translation:
    """Translate a servo valve between four pressures."""
    return translate(ValveBetweenPressures(valve=ServoValve(**options)), compile="never")


def valve_flows(I: float, p: tuple[float, float, float, float], **options: Any) -> dict[str, float]:
    """Return the four port flows and the loss of a servo valve with the pressures at P, T, A, B."""
    inputs = {"valve.I": I} | dict(zip(("p.p", "t.p", "a.p", "b.p"), p, strict=True))
    solution = evaluate(valve(**options), inputs)
    ports = ("port_p", "port_t", "port_a", "port_b")
    return {port: solution.final(f"valve.{port}.q") for port in ports} | {
        "loss": solution.final("valve.P_loss")
    }


@pytest.mark.parametrize("law", ["laminar transition", "listing"])
@settings(max_examples=25)
@given(I=st.floats(-1, 1), p_p=PRESSURES, p_t=PRESSURES, p_a=PRESSURES, p_b=PRESSURES)
def test_a_servo_valve_is_passive_and_keeps_mass(
    law: str, I: float, p_p: float, p_t: float, p_a: float, p_b: float
) -> None:
    found = valve_flows(I, (p_p, p_t, p_a, p_b), law=law)
    loss = found.pop("loss")
    assert loss >= 0
    assert sum(found.values()) == pytest.approx(0, abs=1e-15)


@settings(max_examples=25)
@given(I=st.floats(0, 1), p_a=PRESSURES, p_b=PRESSURES)
def test_a_negative_current_swaps_the_ports(I: float, p_a: float, p_b: float) -> None:
    forward = valve_flows(I, (207e5, 3e5, p_a, p_b))
    backward = valve_flows(-I, (207e5, 3e5, p_b, p_a))
    assert forward["port_a"] == pytest.approx(backward["port_b"], rel=1e-12, abs=1e-20)
    assert forward["port_p"] == pytest.approx(backward["port_p"], rel=1e-12, abs=1e-20)


def test_the_rated_valve_passes_its_rated_flow() -> None:
    """7.5 L/min at 1 A with 35 bar across each land."""
    found = valve_flows(1.0, (70e5, 0.0, 35e5, 35e5))
    assert -found["port_a"] * 60e3 == pytest.approx(7.5, rel=1e-5)
    assert found["port_b"] * 60e3 == pytest.approx(7.5, rel=1e-5)


def test_overlap_and_leakage_of_a_servo_valve() -> None:
    dead = evaluate(
        valve(),
        {"valve.I": 0.02, "p.p": 200e5, "t.p": 0.0, "a.p": 100e5, "b.p": 100e5},
        parameters={"valve.overlap": 0.03},
    )
    assert dead.final("valve.port_p.q") == 0
    leaking = evaluate(
        valve(),
        {"valve.I": 0.0, "p.p": 200e5, "t.p": 0.0, "a.p": 100e5, "b.p": 100e5},
        parameters={"valve.G_leak": 1e-14},
    )
    assert leaking.final("valve.port_p.q") == pytest.approx(2e-14 * 100e5, rel=1e-9)


def test_a_check_valve_shuts() -> None:
    assert flow("check", 0.0, 100e5)[0] == pytest.approx(-0.7 * 1e-9 * (2 * 100e5 / 850) ** 0.5, rel=1e-6)
    assert flow("check", 100e5, 0.0)[0] == pytest.approx(0.7 * 1e-5 * (2 * 100e5 / 850) ** 0.5, rel=1e-6)
