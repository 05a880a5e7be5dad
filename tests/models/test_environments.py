"""The robot's environments: Gymnasium's checker, the model's own runs, and what was learned in one."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from arthur_acausal import SolverOptions, translate
from arthur_acausal.models.arthur.demand import Demand
from arthur_acausal.models.arthur.environments import RECORDED, PumpEnv, QuadrupedEnv, WalkingEnv
from arthur_acausal.models.arthur.policy import CONSTANT, Policy, compare, constant, play
from arthur_acausal.models.arthur.pump_plant import PumpPlant, inputs_of


@pytest.fixture(scope="module")
def env() -> PumpEnv:
    """One second of the supply."""
    return PumpEnv(duration=1.0)


def test_gymnasiums_checker_is_content_with_the_supply() -> None:
    from gymnasium.utils.env_checker import check_env

    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*render.*")
        check_env(PumpEnv("voltage", duration=0.2), skip_render_check=True)


def test_constant_speed_in_the_environment_is_the_model_with_constant_speed(env: PumpEnv) -> None:
    demand = Demand.load(RECORDED)
    played = play(env, constant(env), seed=5)
    env.reset(seed=5)
    begin = env._begin
    whole = translate(PumpPlant(demand=demand, law="given speed")).simulate(
        begin + 1.0,
        start_time=begin,
        inputs={**inputs_of(demand), "w_command": CONSTANT},
        options=SolverOptions(rtol=1e-6, output_interval=0.02),
    )
    # The environment begins in balance at the default speed and is then asked for another: it lags at first.
    late = whole.final("unit.energy_input.E") - whole.at(begin + 0.2, "unit.energy_input.E")
    steps = [env.step(constant(env)(np.zeros(0, np.float32)))[4]["unit.energy_input.E"] for _ in range(50)]
    assert steps[-1] - steps[9] == pytest.approx(late, rel=5e-3)
    assert played.energy == pytest.approx(steps[-1], rel=1e-9)


def test_the_learned_policy_beats_constant_speed_where_it_has_not_been(env: PumpEnv) -> None:
    found = compare(env, {"constant": constant(env), "learned": Policy.load()}, seeds=(1001, 1002))
    for fixed, learned in zip(found["constant"], found["learned"], strict=True):
        assert learned.reward > fixed.reward
        assert learned.energy < fixed.energy


@pytest.mark.parametrize("kind", [WalkingEnv, QuadrupedEnv])
def test_the_whole_robot_steps_the_same_for_the_same_seed(kind: type[WalkingEnv | QuadrupedEnv]) -> None:
    env = kind(duration=0.1)
    action = np.full(env.action_space.shape or (), 0.1, np.float32)
    results = []
    for _ in range(2):
        first, _ = env.reset(seed=3)
        observation, reward, terminated, truncated, info = env.step(action)
        assert env.observation_space.contains(first)
        assert env.observation_space.contains(observation)
        assert not (terminated or truncated)
        assert info["unit.energy_input.E"] > 0.0
        results.append((first.tolist(), observation.tolist(), reward))
    assert results[0] == results[1]
