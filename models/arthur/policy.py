"""A small policy for the pump, trained by evolution: what it takes to learn a controller on a model.

    python -m arthur_acausal.models.arthur.policy [--generations 40] [--seed 1] [-o FILE.json]

It is a = tanh(W o + b) of the observation o. Its numbers are sought by CMA-ES (Hansen 2016, arXiv 1604.00772; the
package cma, extra ``learning``), each candidate on the same episode as the others of its generation; which then is
compared with constant speed on episodes that the training has not seen.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import SimulationError
from arthur_acausal.models.arthur.environments import PumpEnv

FloatArray = NDArray[np.float64]
Acting = Callable[[NDArray[np.float32]], NDArray[np.float32]]

UNSEEN = (1001, 1002, 1003, 1004, 1005)
"""Seeds of the episodes on which policies are compared."""
CONSTANT = 523.6
"""The constant speed: 5000 rpm [rad/s]."""
TRAINED = Path(__file__).with_name("data") / "pump_policy.json"


@dataclass(frozen=True, slots=True, eq=False)
class Policy:
    """a = tanh(W o + b) with ``weights`` (actions, observations) and ``bias`` (actions,)."""

    weights: FloatArray
    bias: FloatArray

    @classmethod
    def of(cls, numbers: FloatArray, actions: int) -> Policy:
        """Return the policy of a vector of actions times (observations + 1) numbers."""
        rows = np.asarray(numbers, dtype=float).reshape(actions, -1)
        return cls(rows[:, :-1], rows[:, -1])

    @classmethod
    def load(cls, path: Path = TRAINED) -> Policy:
        """Read a policy that `save` has written."""
        data = json.loads(path.read_text(encoding="utf-8"))
        return cls(np.array(data["weights"], dtype=float), np.array(data["bias"], dtype=float))

    def save(self, path: Path, **told: Any) -> None:
        """Write it as JSON, with what is ``told`` about its training."""
        data = told | {"weights": self.weights.tolist(), "bias": self.bias.tolist()}
        path.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")

    def __call__(self, observation: NDArray[Any]) -> NDArray[np.float32]:
        """Return the action."""
        action: NDArray[np.float32] = np.tanh(self.weights @ observation + self.bias).astype(np.float32)
        return action


@dataclass(frozen=True, slots=True)
class Played:
    """What an episode gave: the sum of rewards, electrical energy [J], lowest supply pressure [Pa]."""

    reward: float
    energy: float
    lowest: float


def play(env: PumpEnv, act: Acting, seed: int) -> Played:
    """Return what comes of one episode; a failure of the integration is raised."""
    observation, info = env.reset(seed=seed)
    begin, lowest, reward, over = info["unit.energy_input.E"], np.inf, 0.0, False
    while not over:
        observation, gained, terminated, truncated, info = env.step(act(observation))
        if "failure" in info:
            raise SimulationError(info["failure"])
        reward, lowest = reward + gained, min(lowest, info["unit.manifold.p"])
        over = terminated or truncated
    return Played(reward, info["unit.energy_input.E"] - begin, lowest)


def constant(env: PumpEnv) -> Acting:
    """Return the policy that always asks for 5000 rpm."""
    action = np.array([env.actions[0].scaled(CONSTANT)], np.float32)
    return lambda _: action


def train(env: PumpEnv, generations: int, seed: int, told: Callable[[str], None]) -> Policy:
    """Return the policy that the evolution ends with; it tells a line each generation."""
    import cma

    size = env.reset(seed=seed)[0].size + 1
    options = {"seed": seed, "verbose": -9, "maxiter": generations}
    strategy = cma.CMAEvolutionStrategy(np.zeros(size), 0.5, options)
    for generation in range(generations):
        candidates = strategy.ask()
        costs = [
            -play(env, Policy.of(numbers, 1), seed * 10_000 + generation).reward for numbers in candidates
        ]
        strategy.tell(candidates, costs)
        told(f"generation {generation + 1}: best reward {-min(costs):.1f}")
    return Policy.of(strategy.result.xfavorite, 1)


def compare(
    env: PumpEnv, policies: dict[str, Acting], seeds: Sequence[int] = UNSEEN
) -> dict[str, list[Played]]:
    """Return what each policy gives on the same episodes."""
    return {name: [play(env, act, seed) for seed in seeds] for name, act in policies.items()}


def main() -> None:
    """Train, compare, and write the policy."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--generations", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("-o", "--output", type=Path, default=TRAINED)
    given = parser.parse_args()
    env = PumpEnv()
    policy = train(env, given.generations, given.seed, lambda line: print(line, flush=True))
    policy.save(given.output, generations=given.generations, seed=given.seed)
    for name, played in compare(env, {"constant speed": constant(env), "learned": policy}).items():
        reward, energy, lowest = (
            np.mean([getattr(p, k) for p in played]) for k in ("reward", "energy", "lowest")
        )
        seconds = env.steps * env.period
        print(f"{name}: reward {reward:.1f}, {energy:.0f} J in {seconds:g} s, lowest {lowest / 1e5:.1f} bar")


if __name__ == "__main__":
    main()
