"""The robot's trot: what a simulated second costs by variable steps, in one system, and by the other ways.

    python -m benchmarks.quadruped [--json] [--quick] [-o FILE.png]

All methods integrate the same equations from the same checkpoint with the same set points, see quadruped_problem.py.
The error is the largest of any joint's angle at any sample, against ours at a tight tolerance.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from benchmarks.measure import load_average, parser, show

if TYPE_CHECKING:
    from benchmarks.quadruped_problem import Array, Cost, Problem

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6)
REPORT_S_PER_S = 17 * 3600.0
"""What the ARTHuR report's own program takes: 17 hours for a simulated second [s]."""


@dataclass(frozen=True, slots=True)
class Size:
    """How much is run: trot before the checkpoint [s], trot compared [s], rtol of the reference, trot timed [s]."""

    warm_up: float
    duration: float
    reference: float
    timed: float


FULL = Size(1.0, 0.5, 1e-9, 2.0)
QUICK = Size(0.4, 0.1, 1e-8, 0.5)


def row(method: str, key: str, value: float, cost: Cost, reference: Array) -> dict[str, Any]:
    """Return the figures of one method at one tolerance or step."""
    error = float(np.max(np.abs(cost.joints - reference)))
    return {
        "method": method,
        key: value,
        "cpu_s_per_s": cost.cpu_s_per_s,
        "wall_s_per_s": cost.wall_s_per_s,
        "error_rad": error if np.isfinite(error) else None,
    }


def ours(trot: Problem, reference: Array) -> list[dict[str, Any]]:
    """Return our figures at each tolerance."""
    return [row("ours", "rtol", rtol, trot.ours(rtol), reference) for rtol in TOLERANCES]


def profiled(duration: float) -> dict[str, Any]:
    """Return what a second of the whole costs, the controller in the loop, and where that goes."""
    from benchmarks.quadruped_problem import realtime
    from benchmarks.quadruped_profile import Clocks, watching

    clocks = Clocks()
    dae, cpu, wall = realtime(duration)
    realtime(duration, lambda: watching(clocks))
    return {"realtime_factor": wall, "realtime_cpu_s_per_s": cpu, "profile": clocks.shares(dae)}


def measured(size: Size) -> dict[str, Any]:
    """Run all."""
    from benchmarks.quadruped_problem import problem

    figures = profiled(size.timed)
    trot = problem(size.warm_up, size.duration)
    reference = trot.ours(size.reference).joints
    figures["ours"] = ours(trot, reference)
    return figures | {"load_average": load_average(), "report_s_per_s": REPORT_S_PER_S}


def table(figures: dict[str, Any]) -> None:
    """Print the figures."""
    rows = [
        [
            f"{r['method']}, {'rtol' if 'rtol' in r else 'h ='} {r.get('rtol', r.get('h')):.3g}",
            f"{r['cpu_s_per_s']:.3g}",
            f"{r['wall_s_per_s']:.3g}",
            "unstable" if r["error_rad"] is None else f"{r['error_rad']:.2g}",
        ]
        for kind in ("ours", "fixed_step", "cosim")
        for r in figures.get(kind, [])
    ]
    rows.append(["the report's program", "", f"{REPORT_S_PER_S:.3g}", ""])
    show("Trot: a simulated second", ["method", "CPU [s]", "wall [s]", "error [rad]"], rows)
    shares = ", ".join(f"{part} {share:.0%}" for part, share in figures["profile"].items())
    print(f"With the controller at rtol 1e-4: {figures['realtime_factor']:.2f} s wall,", end=" ")
    print(f"{figures['realtime_cpu_s_per_s']:.2f} s CPU for a simulated second\n({shares})")


def main() -> None:
    command_line = parser("What a simulated second of the robot's trot costs, and how exact it is")
    command_line.add_argument("--quick", action="store_true", help="a shortened set, within two minutes")
    options = command_line.parse_args()
    figures = measured(QUICK if options.quick else FULL)
    if options.json:
        print(json.dumps(figures))
    else:
        table(figures)


if __name__ == "__main__":
    main()
