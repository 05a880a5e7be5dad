"""Initial values of the powertrain from 500 seeded start states: how many are found, by which way, and what fails.

Pressures 0 to 210 bar, pistons within their stroke, velocities within 0.5 m/s, 0 to 5000 rpm, voltages, valve currents
and loads over their range. 300 states are given whole. In 100 the pressures are free: pistons begin in balance under
their loads, the manifold with the pump. 100 begin in the steady state that is reached from theirs.

    python -m benchmarks.initialisation [--json] [--scale 0.1]
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from math import pi
from time import process_time
from typing import Any

import numpy as np

from arthur_acausal import ArthurError, Translation, translate
from arthur_acausal.models.arthur.powertrain import Powertrain
from arthur_acausal.solve.simulate import initial_point

SEED = 20240501
STATES = {"given": 300, "free pressures": 100, "steady": 100}
RANGES = {  # of each state, by the end of its path, SI
    "motor.w": (0.0, 5000 * 2 * pi / 60),
    ".p": (0.0, 210e5),
    ".p_A": (0.0, 210e5),
    ".p_B": (0.0, 210e5),
    "].y": (-0.035, 0.035),
    ".v": (-0.5, 0.5),
    "reservoir.z": (0.0, 0.0635),
}
INPUTS = {"motor.V": (0.0, 48.0), ".I": (-0.05, 0.05), ".F": (-300.0, 300.0)}
HOLDS = 1e-9  # a scaled residual of the found values above this one counts as a failure


@dataclass(slots=True)
class Outcome:
    """What became of one kind of start states."""

    kind: str
    states: int = 0
    found: int = 0
    iterations: list[int] = field(default_factory=list)
    methods: dict[str, int] = field(default_factory=dict)
    failures: list[str] = field(default_factory=list)
    cpu_s: float = 0.0

    def as_dict(self) -> dict[str, Any]:
        """The figures."""
        iterations = np.array(self.iterations or [0])
        return {
            "kind": self.kind,
            "states": self.states,
            "found": self.found,
            "iterations_median": float(np.median(iterations)),
            "iterations_most": int(iterations.max()),
            "methods": self.methods,
            "failures": self.failures,
            "cpu_s": self.cpu_s,
        }


def drawn(
    paths: list[str], ranges: dict[str, tuple[float, float]], random: np.random.Generator
) -> dict[str, float]:
    """A value for each path whose end is among the ranges."""
    found = {}
    for path in paths:
        span = next((r for end, r in ranges.items() if path.endswith(end)), None)
        if span is not None:
            found[path] = float(random.uniform(*span))
    return found


def start_states(model: Translation, count: int, random: np.random.Generator) -> Iterator[tuple[Any, Any]]:
    """Start values and inputs."""
    for _ in range(count):
        yield drawn(model.report.states, RANGES, random), drawn(model.report.inputs, INPUTS, random)


def run(kind: str, model: Translation, count: int, seed: int = SEED) -> Outcome:
    """Initialise so many start states of one kind."""
    random = np.random.default_rng([seed, list(STATES).index(kind)])
    outcome, begun = Outcome(kind), process_time()
    for start, inputs in start_states(model, count, random):
        outcome.states += 1
        try:
            if kind == "steady":
                point = model.steady_state(start=start, inputs=inputs).begin()
            else:
                point = initial_point(model.dae, stop_time=1.0, start=start, inputs=inputs)
        except ArthurError as error:
            outcome.failures.append(f"state {outcome.states}: {error}")
            continue
        statistics = point.statistics
        outcome.iterations.append(statistics.initial_iterations)
        outcome.methods[statistics.initial_method] = outcome.methods.get(statistics.initial_method, 0) + 1
        remains = residual(model, point)
        if remains > HOLDS:
            outcome.failures.append(f"state {outcome.states}: a scaled residual of {remains:.1e} remains")
        else:
            outcome.found += 1
    outcome.cpu_s = process_time() - begun
    return outcome


def residual(model: Translation, point: Any) -> float:
    """The largest residual of F at the point, over the sum of what the unknowns' magnitudes make of its terms."""
    dae = model.dae
    evaluator = dae.evaluator()
    evaluator.t[:] = point.t[-1:]
    for name in ("y", "yp", "u", "z", "m"):
        getattr(evaluator, name)[:] = getattr(point, name)[-1]
    evaluator.p[:] = point.p
    row, column = dae.sparsity.row, np.repeat(np.arange(dae.n), np.diff(dae.sparsity.colind))
    size = np.zeros(dae.n)
    for entries, values in ((evaluator.jacobian_y(), evaluator.y), (evaluator.jacobian_yp(), evaluator.yp)):
        np.add.at(size, row, np.abs(entries) * np.maximum(np.abs(values), dae.nominal)[column])
    return float(np.max(np.abs(evaluator.residual()) / size))


def measure(scale: float = 1.0, n: int = 12) -> list[Outcome]:
    """All kinds; `scale`: the part of the start states."""
    given, free = (
        translate(Powertrain(n=n, audit=False)),
        translate(Powertrain(n=n, audit=False, balanced=True)),
    )
    models = {"given": given, "free pressures": free, "steady": given}
    return [run(kind, models[kind], max(1, round(scale * count))) for kind, count in STATES.items()]


def main(arguments: list[str] | None = None) -> int:
    """Print the table, or one JSON object."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--scale", type=float, default=1.0, help="part of the start states")
    options = parser.parse_args(arguments)
    outcomes = measure(options.scale)
    found, states = sum(o.found for o in outcomes), sum(o.states for o in outcomes)
    if options.json:
        kinds = [o.as_dict() for o in outcomes]
        print(json.dumps({"states": states, "found": found, "part": found / states, "kinds": kinds}))
        return 0
    for o in outcomes:
        figures = o.as_dict()
        print(
            f"{o.kind:15} {o.found:4} of {o.states:4}   iterations {figures['iterations_median']:.0f} (most "
            f"{figures['iterations_most']})   {1e3 * o.cpu_s / o.states:.1f} ms each   {o.methods}"
        )
        for failure in o.failures:
            print(f"  {failure}")
    print(f"{found} of {states}: {found / states:.1%}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
