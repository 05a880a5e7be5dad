"""A model as a Gymnasium environment: actions are inputs of it, observations variables of it.

Between two actions the whole system is integrated with variable step to the tolerance that the options name; the
period of the environment is no step of the integration. Towers et al. (2024), arXiv 2407.17032.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from arthur_acausal.api import Translation
from arthur_acausal.errors import UsageError
from arthur_acausal.solve.failure import SolverFailure
from arthur_acausal.solve.inputs import Input
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.stepping import Stepper
from arthur_acausal.solve.trajectory import Trajectory

Array = NDArray[np.float32]
CLIPPED = 10.0  # observations stay within so many times their range


@dataclass(frozen=True, slots=True)
class Channel:
    """A variable by its path, which goes from ``low`` to ``high`` [SI] as an environment's number from -1 to 1."""

    path: str
    low: float
    high: float

    def __post_init__(self) -> None:
        if not (np.isfinite([self.low, self.high]).all() and self.low < self.high):
            raise UsageError(f"{self.path}: from {self.low} to {self.high} is no range")

    def scaled(self, value: float) -> float:
        """Return the environment's number for a value in SI."""
        return 2.0 * (value - self.low) / (self.high - self.low) - 1.0

    def value(self, number: float) -> float:
        """Return the value in SI for a number; beyond -1 to 1 it is the nearer end of the range."""
        share = 0.5 * (min(max(number, -1.0), 1.0) + 1.0)
        return self.low + share * (self.high - self.low)


@dataclass(frozen=True, slots=True)
class Episode:
    """How one episode begins and what is given to it, as for `Translation.simulate`."""

    parameters: Mapping[str, Any] = field(default_factory=dict)
    start: Mapping[str, Any] = field(default_factory=dict)
    inputs: Mapping[str, Input] = field(default_factory=dict)
    start_time: float = 0.0


class ModelEnv(gymnasium.Env[Array, Array]):
    """A model that an agent acts upon.

    A subclass says what an episode begins with, what is rewarded, and what is observed besides the model's variables.

    Parameters
    ----------
    actions : inputs of the model; ``action_space`` is Box(-1, 1, (n,)).
    observations : variables of the model; they are limited to 10 times their range.
    measures : paths of what `reward` reads; an episode's ``info`` holds them in SI.
    extra : how many numbers `preview` adds to an observation.
    period : between two actions [s]. duration : of an episode [s], which is then truncated.
    options : of the integration.

    An episode terminates where the model ends the run, or where the integration fails: then ``info["failure"]`` tells
    why, and the reward is that of `failed`.
    """

    def __init__(
        self,
        model: Translation,
        *,
        actions: Sequence[Channel],
        observations: Sequence[Channel],
        measures: Sequence[str],
        period: float,
        duration: float,
        extra: int = 0,
        options: SolverOptions | None = None,
    ) -> None:
        if not 0.0 < period <= duration:
            raise UsageError(f"period {period:g} s and duration {duration:g} s of an environment")
        self.model, self.options = model, options or SolverOptions(rtol=1e-4)
        self.actions, self.observations, self.measures = tuple(actions), tuple(observations), tuple(measures)
        self.period, self.steps = period, round(duration / period)
        self._paths = [channel.path for channel in self.observations] + list(self.measures)
        for path in self._paths:
            model.dae.recovery.find(path)
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (len(self.actions),), np.float32)
        size = len(self.observations) + extra
        self.observation_space = gymnasium.spaces.Box(-CLIPPED, CLIPPED, (size,), np.float32)
        self._run: Stepper | None = None
        self._known: tuple[Episode, Trajectory] | None = None

    # --- what an environment says

    def episode(self, rng: np.random.Generator) -> Episode:
        """Return how the next episode begins."""
        return Episode()

    @abstractmethod
    def reward(self, before: Mapping[str, float], after: Mapping[str, float]) -> float:
        """Return the reward of a step, from the measures in SI before and after it."""

    def failed(self) -> float:
        """Return the reward of a step in which the integration fails; by default 0."""
        return 0.0

    def preview(self, t: float) -> NDArray[np.float64]:
        """Return what else is observed at a time [s], scaled: ``extra`` numbers."""
        return np.zeros(0)

    # --- what Gymnasium asks

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Array, dict[str, Any]]:
        """Begin an episode; the same seed gives the same ones."""
        super().reset(seed=seed)
        episode = self.episode(self.np_random)
        self._begin, self._count = episode.start_time, 0
        known = self._known
        self._run = self.model.stepper(
            episode.start_time + self.steps * self.period,
            start_time=episode.start_time,
            parameters=episode.parameters,
            inputs=episode.inputs,
            start=episode.start,
            options=self.options,
            begin=known[1] if known is not None and known[0] == episode else None,
        )
        self._known = episode, self._run.begin
        observation, self._measured = self._look(self._run)
        return observation, dict(self._measured)

    def step(self, action: Array) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        """Act for one period."""
        run = self._run
        if run is None:
            raise UsageError("an environment is to be reset before its first step")
        self._count += 1
        numbers = np.asarray(action, dtype=float).reshape(-1).tolist()
        try:
            run.set(
                {channel.path: channel.value(x) for channel, x in zip(self.actions, numbers, strict=True)}
            )
            run.advance(self._begin + self._count * self.period)
        except SolverFailure as error:
            self._run = None
            return self._last, self.failed(), True, False, {**self._measured, "failure": str(error)}
        before = self._measured
        observation, self._measured = self._look(run)
        reward = self.reward(before, self._measured)
        terminated = run.ended not in (None, "finished")
        truncated = not terminated and self._count >= self.steps
        info: dict[str, Any] = dict(self._measured)
        if terminated:
            info["ended"] = run.ended
        return observation, float(reward), terminated, truncated, info

    def _look(self, run: Stepper) -> tuple[Array, dict[str, float]]:
        """Return the observation and the measures at present."""
        values = run.observe(self._paths).tolist()
        count = len(self.observations)
        own = [channel.scaled(x) for channel, x in zip(self.observations, values, strict=False)]
        whole = np.concatenate([own, self.preview(run.t)])
        self._last = np.clip(whole, -CLIPPED, CLIPPED).astype(np.float32)
        return self._last, dict(zip(self.measures, values[count:], strict=True))
