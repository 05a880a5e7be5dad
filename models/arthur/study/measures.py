"""What is measured of each run: a reduction of the sweep."""

from __future__ import annotations

from math import hypot, nan

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import Solution
from arthur_acausal.models.arthur.dimensions import JOINT_NAMES, Dimensions
from arthur_acausal.models.arthur.figures import GRAVITY, headings
from arthur_acausal.models.arthur.power_unit import POWERS
from arthur_acausal.models.arthur.study.tasks import TASKS, Task
from arthur_acausal.models.arthur.trouble import counts

FloatArray = NDArray[np.float64]

BAR = 1e5
WANTED = 135.0
"""Supply pressure that the legs count on [bar]: the same for all schemes, whatever each is told to keep."""
BATTERY_WH = 222.0
"""Energy of the battery [W h], for the time of a mission: 12 cells of 5 A h; assumed."""
LOSSES = {name: f"unit.energy_{name}.E" for name in POWERS if name != "input"}
LOSSES |= {"valves": "energy_valves.E", "cylinders": "energy_cylinders.E"}


def measures(solution: Solution) -> dict[str, float]:
    """Return the figures of a run over its task's time of measurement; NaN where it fell before.

    It reads what needs no equation solved anew at each instant: states and discrete variables.

    Mean powers [W] are differences of the audit's energies: ``electrical_W`` from the battery, each loss by its name,
    ``work_W`` on the joints, ``stored_W``. ``undershoot_bar_rms`` and ``_max`` are the depth below WANTED of the supply
    pressure, ``undershoot_share`` the share of the time below it by more than 1 bar; ``shortfall_bar_*`` the depth
    below the pressure that the planned motion needs at that time.
    ``force_error_rms`` [N] is that of all cylinders.
    ``cost_of_transport`` is the battery's energy over weight and way.
    """
    task = TASKS[round(solution.final("task"))]
    told = {
        "fell": float(solution.final("fallen")),
        "closure": solution.energy().closure,
        **{name: float(number) for name, number in counts(solution).items() if name != "over_current"},
    }
    inside = (solution.t >= task.begin) & (solution.t <= task.end)
    if told["fell"] or not inside.any():
        return told
    return told | _powers(solution, inside) | _supply(solution, inside) | _walked(solution, inside, task)


def _powers(solution: Solution, inside: NDArray[np.bool_]) -> dict[str, float]:
    span = float(np.ptp(solution.t[inside]))

    def power(path: str) -> float:
        energy = solution[path][inside]
        return float(energy[-1] - energy[0]) / span

    found = {"electrical_W": power("unit.energy_input.E")}
    found |= {f"{name}_W": power(path) for name, path in LOSSES.items()}
    found["work_W"] = power("energy_work.E")
    found["stored_W"] = found["electrical_W"] - sum(found[f"{name}_W"] for name in [*LOSSES, "work"])
    return found | {"mission_h": BATTERY_WH / found["electrical_W"]}


def _supply(solution: Solution, inside: NDArray[np.bool_]) -> dict[str, float]:
    t, p = solution.t[inside], solution["unit.manifold.p"][inside] / BAR
    depth, span = np.maximum(WANTED - p, 0.0), float(np.ptp(t))
    short = np.maximum(solution["unit.control.plan[0].p"][inside] / BAR - p, 0.0)
    return {
        "pressure_bar": float(np.trapezoid(p, t)) / span,
        "undershoot_bar_rms": float(np.sqrt(np.trapezoid(depth**2, t) / span)),
        "undershoot_bar_max": float(depth.max()),
        "shortfall_bar_rms": float(np.sqrt(np.trapezoid(short**2, t) / span)),
        "shortfall_bar_max": float(short.max()),
        "undershoot_share": float(np.trapezoid((depth > 1.0).astype(float), t)) / span,
    }


def _walked(solution: Solution, inside: NDArray[np.bool_], task: Task) -> dict[str, float]:
    t = solution.t[inside]
    span = float(np.ptp(t))
    squares = solution["squares"][inside]
    x, y = (solution[f"body.base_{axis}"][inside] for axis in "xy")
    ahead = float(np.trapezoid(headings(solution)[inside, 0], t)) / span
    turned = float(np.trapezoid(solution["body.base_w_z"][inside], t)) / span
    energy = solution["unit.energy_input.E"][inside]
    way = hypot(x[-1] - x[0], y[-1] - y[0])
    weight = Dimensions().mass * GRAVITY
    return {
        "force_error_rms": float(np.sqrt((squares[-1] - squares[0]) / (len(JOINT_NAMES) * span))),
        "speed_m_s": ahead,
        "speed_error": ahead / task.speed - 1.0 if task.speed else nan,
        "yaw_error": turned / task.yaw_rate - 1.0 if task.yaw_rate else nan,
        "cost_of_transport": float(energy[-1] - energy[0]) / (weight * way) if task.moves else nan,
    }
