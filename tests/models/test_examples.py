"""The registered models: each translates and runs; the examples show what they say."""

from __future__ import annotations

from importlib import import_module

import numpy as np
import pytest

from arthur_acausal import Component, SolverOptions, simulate, translate
from arthur_acausal.models import DESCRIPTIONS, REGISTRY
from arthur_acausal.models.examples.accumulator_charge import AccumulatorCharge
from arthur_acausal.models.examples.bouncing_ball import BouncingBall
from arthur_acausal.models.examples.jack import Jack
from arthur_acausal.models.examples.motor_control import MotorControl
from arthur_acausal.models.examples.power_supply import PowerSupply
from arthur_acausal.models.examples.rc_ladder import RCLadder
from arthur_acausal.models.examples.room_heating import RoomHeating

BOUNCES = [
    0.4515236409857309, 1.083656738365754, 1.5261499065317703, 1.8358951242479817, 2.0527167766493295,
    2.204491933330273, 2.3107345430069337, 2.385104369780596, 2.4371632485221597, 2.473604463641254,
]  # fmt: skip


@pytest.mark.parametrize("name", REGISTRY)
def test_a_registered_model_can_be_found_and_runs(name: str) -> None:
    module, _, cls = REGISTRY[name].partition(":")
    model = getattr(import_module(module), cls)
    assert issubclass(model, Component)
    assert DESCRIPTIONS[name]
    assert translate(model()).simulate(1e-3).t[-1] == 1e-3


def test_the_ball_bounces_when_it_should() -> None:
    """Closed form: sqrt(2 h/g), then 2 e^k sqrt(2 h/g) more each; e 0.7, h 1 m, g 9.81 m/s^2."""
    solution = simulate(BouncingBall(), 2.49, options=SolverOptions(rtol=1e-10))
    times = [event.time for event in solution.events if event.kind == "state"]
    assert times == pytest.approx(BOUNCES, abs=1e-9)
    assert solution.final("bounces") == 10


def test_the_ladder_charges() -> None:
    """Slowest mode: R C 4 sin^2(pi/(2 (2 n + 1))); after 20 of its time constants every node is at V."""
    solution = simulate(RCLadder(n=5), 20 * 1e-3 / (4 * np.sin(np.pi / 22) ** 2))
    assert solution.final("capacitors[4].v") == pytest.approx(1.0, rel=1e-6)


def test_the_jack_rises_at_the_orifice_s_speed() -> None:
    """v = C_d A_o sqrt(2 (p_s - p)/rho)/A with p = m g/A = 49.05 bar, compressibility aside."""
    solution = simulate(Jack(), 2.0)
    flow = 0.7 * 2e-6 * (2 * (100e5 - 49.05e5) / 850) ** 0.5
    assert solution.final("load.v") == pytest.approx(flow / 1e-3, rel=0.01)
    assert solution.final("ram.p") == pytest.approx(49.05e5, rel=0.01)


def test_the_accumulator_fills_along_its_polytrope_until_the_relief_valve_opens() -> None:
    solution = simulate(AccumulatorCharge(), 3.0, options=SolverOptions(rtol=1e-7))
    p, V_g = solution["accumulator.p"], solution["accumulator.V_g"]
    full = p > 85e5
    assert p[full] == pytest.approx(84e5 * (1e-4 / V_g[full]) ** 1.4, rel=1e-6)
    assert 138e5 < p[-1] < 142e5
    assert solution.final("relief.q") == pytest.approx(3.8e-3 / 60, rel=0.02)


def test_the_power_supply_ripples() -> None:
    """From peak to peak I/(2 f C) less the time in which the capacitor is charged: about three quarters of it."""
    solution = simulate(PowerSupply(), 0.5, options=SolverOptions(intervals=5000))
    v = solution["load.v"][solution.t > 0.46]
    most = np.mean(v) / 20 / (100 * 4.7e-3)
    assert 0.6 * most < np.ptp(v) < most
    assert np.max(v) < 325 / 25 - 2 * 0.7


def test_the_room_stays_within_half_a_kelvin() -> None:
    """The heater's mean power is what the walls lose; its state changes at +-0.5 K."""
    solution = simulate(RoomHeating(), 2 * 86400.0, options=SolverOptions(intervals=5000))
    late = solution.t > 20000
    assert solution["air.T"][late].min() == pytest.approx(293.65, abs=1e-4)
    assert solution["air.T"][late].max() == pytest.approx(294.65, abs=1e-4)


def test_the_motor_holds_its_speed() -> None:
    """100 rad/s under a load of 1 N m: i = (tau + d w)/k = 11 A, and the voltage R i + k w = 15.5 V."""
    solution = simulate(MotorControl(), 3.0, inputs={"load.tau": -1.0})
    assert solution.final("rotor.w") == pytest.approx(100.0, rel=1e-3)
    assert solution.final("L.i") == pytest.approx(11.0, rel=1e-3)
    assert solution.final("controller.y") == pytest.approx(15.5, rel=1e-3)
