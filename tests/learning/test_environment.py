"""A model as an environment: Gymnasium's own checker, determinism, and a step against its closed form."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

import gymnasium
import numpy as np
import pytest

from arthur_acausal import (
    Component,
    Equations,
    Real,
    UsageError,
    der,
    parameter,
    real_input,
    terminate,
    translate,
    variable,
    when,
)
from arthur_acausal.learning import Channel, Episode, ModelEnv


class Lag(Component):
    """tau x' = u - x; above ``top`` the run ends."""

    u: Real = real_input("1", default=0.0)
    tau: Real = parameter("s", default=0.5)
    top: Real = parameter("1", default=10.0)
    x: Real = variable("1", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield self.tau * der(self.x) == self.u - self.x
        yield when(self.x > self.top, terminate("over the top"))


class LagEnv(ModelEnv):
    """x is to be 1; it begins anywhere from 0 to 0.5."""

    def __init__(self, top: float = 10.0) -> None:
        super().__init__(
            translate(Lag(top=top)),
            actions=[Channel("u", -2.0, 2.0)],
            observations=[Channel("x", -1.0, 1.0)],
            measures=["x"],
            period=0.1,
            duration=1.0,
            extra=1,
        )

    def episode(self, rng: np.random.Generator) -> Episode:
        return Episode(start={"x": float(rng.uniform(0.0, 0.5))})

    def reward(self, before: Mapping[str, float], after: Mapping[str, float]) -> float:
        return -abs(after["x"] - 1.0)

    def preview(self, t: float) -> Any:
        return np.array([t])


def test_gymnasiums_checker_is_content() -> None:
    from gymnasium.utils.env_checker import check_env

    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*render.*")
        check_env(LagEnv(), skip_render_check=True)


def played(env: gymnasium.Env[Any, Any], seed: int) -> list[Any]:
    rng = np.random.default_rng(7)
    rows = [env.reset(seed=seed)[0]]
    for _ in range(10):
        observation, reward, terminated, truncated, _ = env.step(rng.uniform(-1.0, 1.0, 1).astype(np.float32))
        rows.append((observation.tolist(), reward, terminated, truncated))
    return [rows[0].tolist(), *rows[1:]]


def test_a_seed_gives_the_same_episode_and_another_seed_another() -> None:
    env = LagEnv()
    first, other, again = played(env, 1), played(env, 2), played(env, 1)
    assert first == again == played(LagEnv(), 1)
    assert first[0] != other[0]
    assert [row[3] for row in first[1:]] == [False] * 9 + [True]


def test_a_step_is_that_of_the_closed_form() -> None:
    env = LagEnv()
    _, info = env.reset(seed=3)
    x = info["x"]
    for action in (0.25, -1.0, 5.0):  # the last beyond the range: the end of it
        u = 2.0 * min(action, 1.0)
        x = u + (x - u) * np.exp(-0.1 / 0.5)
        observation, reward, *_, info = env.step(np.array([action], np.float32))
        assert info["x"] == pytest.approx(x, abs=1e-4)
        assert reward == pytest.approx(-abs(x - 1.0), abs=1e-4)
        assert observation[0] == pytest.approx(x, abs=1e-4)


def test_it_terminates_where_the_model_ends_the_run() -> None:
    env = LagEnv(top=1.0)
    env.reset(seed=0)
    results = (env.step(np.ones(1, np.float32)) for _ in range(10))
    *_, terminated, truncated, info = next(result for result in results if result[2])
    assert (terminated, truncated, info["ended"]) == (True, False, "over the top")


def test_vectors_of_it_run_as_single_ones_do() -> None:
    vector = gymnasium.vector.SyncVectorEnv([LagEnv, LagEnv])
    try:
        observations, _ = vector.reset(seed=[1, 2])
        alone = [LagEnv().reset(seed=seed)[0] for seed in (1, 2)]
        assert np.array_equal(observations, alone)
        observations, rewards, *_ = vector.step(np.zeros((2, 1), np.float32))
        assert rewards.shape == (2,)
    finally:
        vector.close()


class Escape(Component):
    """x' = u x^2 from 1: with u = 1 there is no solution beyond t = 1."""

    u: Real = real_input("1/s", default=0.0)
    x: Real = variable("1", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.u * self.x**2


class EscapeEnv(ModelEnv):
    """A model without a solution for some actions."""

    def __init__(self) -> None:
        channel = Channel("x", 0.0, 10.0)
        actions = [Channel("u", -1.0, 1.0)]
        super().__init__(
            translate(Escape()),
            actions=actions,
            observations=[channel],
            measures=["x"],
            period=0.5,
            duration=2.0,
        )

    def reward(self, before: Mapping[str, float], after: Mapping[str, float]) -> float:
        return after["x"] - before["x"]

    def failed(self) -> float:
        return -100.0


def test_a_failure_ends_the_episode_and_is_told() -> None:
    env = EscapeEnv()
    env.reset(seed=0)
    _, reward, terminated, *_ = env.step(np.ones(1, np.float32))
    assert reward == pytest.approx(1.0, rel=1e-3)
    assert not terminated
    _, reward, terminated, truncated, info = env.step(np.ones(1, np.float32))
    assert (reward, terminated, truncated) == (-100.0, True, False)
    assert "t = " in info["failure"]
    with pytest.raises(UsageError, match="reset"):
        env.step(np.ones(1, np.float32))


def test_what_is_not_there_is_told_at_once() -> None:
    with pytest.raises(UsageError, match="no range"):
        Channel("x", 1.0, 1.0)
