"""Steps a second of the learning environments: ``python -m benchmarks.learning [--json] [--seconds S]``.

Random actions; resets are included, making the environment is not. Two environments run in processes of their own, as
Gymnasium's AsyncVectorEnv has them. The last column is what 10 million steps would take.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from typing import Any

import gymnasium

from arthur_acausal.models.arthur.environments import PumpEnv, QuadrupedEnv, WalkingEnv
from benchmarks.measure import load_average, parser, show

ENVIRONMENTS: dict[str, Callable[[], gymnasium.Env[Any, Any]]] = {
    "supply": PumpEnv,
    "walking robot, pump driven": WalkingEnv,
    "robot, forces": QuadrupedEnv,
}
MANY = 10_000_000
PROCESSES = 2


def single(make: Callable[[], gymnasium.Env[Any, Any]], seconds: float) -> tuple[float, float]:
    """Return steps for a second of wall time and of CPU time."""
    env = make()
    env.action_space.seed(0)
    env.reset(seed=0)
    steps, wall, cpu = 0, time.perf_counter(), time.process_time()
    while time.perf_counter() - wall < seconds:
        *_, terminated, truncated, _ = env.step(env.action_space.sample())
        steps += 1
        if terminated or truncated:
            env.reset()
    return steps / (time.perf_counter() - wall), steps / (time.process_time() - cpu)


def vectorised(make: Callable[[], gymnasium.Env[Any, Any]], seconds: float) -> float:
    """Return steps for a second of wall time of all processes together."""
    env = gymnasium.vector.AsyncVectorEnv([make] * PROCESSES, context="spawn")
    try:
        env.action_space.seed(0)
        env.reset(seed=0)
        steps, wall = 0, time.perf_counter()
        while time.perf_counter() - wall < seconds:
            env.step(env.action_space.sample())
            steps += PROCESSES
        return steps / (time.perf_counter() - wall)
    finally:
        env.close()


def measure(seconds: float) -> list[dict[str, Any]]:
    """Return the figures of each environment."""
    found = []
    for name, make in ENVIRONMENTS.items():
        wall, cpu = single(make, seconds)
        both = vectorised(make, seconds)
        found.append(
            {
                "environment": name,
                "steps_per_s": wall,
                "steps_per_cpu_s": cpu,
                "vectorised_steps_per_s": both,
                "hours_for_10_million": MANY / max(wall, both) / 3600.0,
            }
        )
    return found


def main() -> None:
    """Print the figures."""
    command = parser(__doc__ or "")
    command.add_argument("--seconds", type=float, default=10.0, help="of wall time for each figure")
    given = command.parse_args()
    rows = measure(given.seconds)
    if given.json:
        print(json.dumps({"environments": rows, "processes": PROCESSES, "load": load_average()}))
        return
    heads = ["environment", "steps/s", "per CPU s", f"{PROCESSES} processes, steps/s", "10^7 steps [h]"]
    table = [[str(r["environment"]), *(f"{r[k]:.0f}" for k in list(r)[1:])] for r in rows]
    show("Learning environments", heads, table)


if __name__ == "__main__":
    main()
