"""The robot's trot: what a simulated second costs by variable steps, in one system, and by the other ways.

    python -m benchmarks.quadruped [--json] [--quick] [-o FILE.png]

All methods integrate the same equations from the same checkpoint with the same set points, see quadruped_problem.py.
The error is the largest of any joint's angle at any sample, against ours at a tight tolerance. The fixed-step methods
are compiled C, MuJoCo included, see quadruped_fixed.c; the linearly implicit ones may keep a Jacobian for some steps.
At the beginning of the trot ours is held, too, against RK4 with steps so short that only rounding is left of its error.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from benchmarks.measure import load_average, parser, show

if TYPE_CHECKING:
    from benchmarks.quadruped_fixed import Program
    from benchmarks.quadruped_problem import Array, Cost, Problem

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6)
FIXED = (
    ("RK4", "rk4", 1e-5, 1),
    ("RK4", "rk4", 4e-6, 1),
    ("linearly implicit Euler", "ros1", 20e-6, 1),
    ("ROS2", "ros2", 20e-6, 1),
    ("ROS2", "ros2", 50e-6, 1),
    ("ROS2", "ros2", 100e-6, 1),
    ("ROS2", "ros2", 200e-6, 1),
    ("ROS2, kept Jacobian", "ros2", 20e-6, 10),
    ("ROS2, kept Jacobian", "ros2", 100e-6, 10),
    ("ROS2, kept Jacobian", "ros2", 200e-6, 5),
)
"""Method, its name in the program, step [s], steps from one Jacobian to the next."""
LIMITED = (("explicit Euler", "euler"), ("semi-implicit Euler", "semi"))
"""Methods that run at their largest stable step."""
GUESS = 2e-5  # where the search for that begins [s]
SEARCHED = 5  # samples over which a step has to be stable in the search
EXCHANGES = (2e-3, 1e-3, 0.5e-3, 0.1e-3)  # of the co-simulation [s]
MICRO = 1e-5  # step of the hydraulics within it [s]
TARGET = 1e-5  # error at which costs are compared [rad]
AGREEING = 1e-8  # rtol of ours beside the finest RK4
AGREED = 0.05  # for so long [s]
REPORT_S_PER_S = 17 * 3600.0
"""What the ARTHuR report's own program takes: 17 hours for a simulated second [s]."""


@dataclass(frozen=True, slots=True)
class Size:
    """How much is run.

    Trot before the checkpoint [s], trot compared [s], rtol of the reference, trot timed [s], finest step of RK4 [s].
    """

    warm_up: float
    duration: float
    reference: float
    timed: float
    finest: float


FULL = Size(1.0, 0.5, 1e-9, 2.0, 1e-7)
QUICK = Size(0.4, 0.1, 1e-8, 0.5, 1e-6)


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


def rivals(trot: Problem, reference: Array, finest: float) -> dict[str, Any]:
    """Return the figures of the fixed-step methods and of the co-simulation, and how the finest agrees with ours."""
    from benchmarks.quadruped_fixed import compiled

    with compiled(trot) as program:
        steps = [
            (label, name, program.largest_stable(name, GUESS, reference, SEARCHED), 1)
            for label, name in LIMITED
        ]
        fixed = [
            row(label, "h", h, program.run(name, h, every=every), reference)
            for label, name, h, every in (*steps, *FIXED)
        ]
        cosim = [
            row("co-simulation", "h", H, program.run("cosim", MICRO, exchange=H), reference)
            for H in EXCHANGES
        ]
        agreement = agreeing(trot, program, finest)
    return {"fixed_step": fixed, "cosim": cosim, "agreement": agreement}


def agreeing(trot: Problem, program: Program, h: float) -> dict[str, float]:
    """Return by how much the joints of ours and of RK4 with the step ``h`` [s] differ."""
    beginning = replace(trot, duration=AGREED)
    joints = program.run("rk4", h, ticks=beginning.times.size - 1).joints
    difference = float(np.max(np.abs(joints - beginning.ours(AGREEING).joints)))
    return {"rtol": AGREEING, "h": h, "duration_s": AGREED, "difference_rad": difference}


def cost_at(rows: Iterable[dict[str, Any]], target: float) -> float:
    """Return the least CPU time at an error, infinity if no method is so exact.

    Between two runs of one method it lies on the line through them, in logarithms.
    """
    methods: dict[str, list[tuple[float, float]]] = {}
    for r in rows:
        if r["error_rad"]:
            methods.setdefault(r["method"], []).append((r["error_rad"], r["cpu_s_per_s"]))
    costs = [float("inf")]
    for runs in methods.values():
        errors, cpu = np.log(sorted(runs)).T
        if errors[0] <= np.log(target):
            costs.append(float(np.exp(np.interp(np.log(target), errors, cpu))))
    return min(costs)


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
    figures |= rivals(trot, reference, size.finest)
    gain = cost_at(figures["fixed_step"] + figures["cosim"], TARGET) / cost_at(figures["ours"], TARGET)
    figures["cpu_gain_at_1e-5"] = gain if np.isfinite(gain) else None
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
    gain = figures["cpu_gain_at_1e-5"]
    if gain is not None:
        print(f"CPU time of the best rival over ours, at an error of {TARGET:g} rad: {gain:.2f}")
    found = figures["agreement"]
    print(
        f"Ours at rtol {found['rtol']:g} and RK4 at {found['h']:g} s, {found['duration_s']:g} s of trot:",
        end=" ",
    )
    print(f"joints within {found['difference_rad']:.1e} rad")
    shares = ", ".join(f"{part} {share:.0%}" for part, share in figures["profile"].items())
    print(f"With the controller at rtol 1e-4: {figures['realtime_factor']:.2f} s wall,", end=" ")
    print(f"{figures['realtime_cpu_s_per_s']:.2f} s CPU for a simulated second\n({shares})")


def draw(figures: dict[str, Any], path: str) -> None:
    """Write the work-precision picture."""
    from matplotlib.figure import Figure

    picture = Figure(figsize=(7, 5), layout="constrained")
    axes = picture.subplots()
    rows = [r for kind in ("ours", "fixed_step", "cosim") for r in figures[kind] if r["error_rad"]]
    for method in dict.fromkeys(r["method"] for r in rows):
        own = [r for r in rows if r["method"] == method]
        style: dict[str, Any] = {"marker": "s", "linestyle": "--", "markersize": 4}
        if method == "ours":
            style = {"marker": "o", "color": "black", "linewidth": 2}
        axes.loglog([r["error_rad"] for r in own], [r["cpu_s_per_s"] for r in own], label=method, **style)
    axes.set(xlabel="error of a joint [rad]", ylabel="CPU time for a simulated second [s]")
    axes.set_title(f"The robot's trot (the report's program: {REPORT_S_PER_S:,.0f} s)", fontsize="medium")
    axes.grid(alpha=0.3)
    axes.legend(fontsize="small")
    picture.savefig(path, dpi=150)


def main() -> None:
    command_line = parser("What a simulated second of the robot's trot costs, and how exact it is")
    command_line.add_argument("--quick", action="store_true", help="a shortened set, within two minutes")
    command_line.add_argument("-o", metavar="FILE.png", help="write the work-precision picture")
    options = command_line.parse_args()
    figures = measured(QUICK if options.quick else FULL)
    if options.o:
        draw(figures, options.o)
    if options.json:
        print(json.dumps(figures))
    else:
        table(figures)


if __name__ == "__main__":
    main()
