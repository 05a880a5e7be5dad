"""The quadruped's picture: how the trunk moves, what the feet bear, what the hydraulics does for it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import Solution
from arthur_acausal.models.arthur.dimensions import LEGS
from arthur_acausal.models.arthur.figures import attitude
from arthur_acausal.models.arthur.picture import FILLS, shade_range

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

LOSSES = {
    "valves": ("actuators[*].P_valve",),
    "motor and drive": ("unit.motor.P_copper", "unit.motor.P_friction", "unit.drive.P_loss"),
    "pump": ("unit.pump.P_friction", "unit.pump.P_leakage", "unit.pump.P_compression"),
    "cylinders": ("actuators[*].P_cylinder",),
    "relief, filter, tank": ("unit.relief.P_loss", "unit.filter.P_loss", "unit.reservoir.P_loss"),
}
"""Layers of the panel of powers, each the sum of its signals [W]."""


def picture(solution: Solution) -> Figure:
    """Return the picture of a run: trunk, feet, pressures, flows and powers."""
    figure = solution.plot(
        {
            "trunk height [mm]": {"height": "body.base_z"},
            "trunk speed [m/s]": {"along x": "body.base_v_x", "along y": "body.base_v_y"},
            "trunk attitude [deg]": {},
            "force on the feet [N]": {leg: f"body.sensor_{leg}_touch" for leg in LEGS},
            "pressure [bar]": {"manifold": "unit.manifold.p", "tank": "unit.reservoir.p"},
            "flow [L/min]": {
                "pump": "unit.pump.q",
                "to the valves": "unit.filter.q",
                "relief": "unit.relief.q",
            },
            "power [W]": {"battery": "unit.drive.P_battery"},
        }
    )
    _, _, turning, _, pressures, _, powers = figure.axes
    _draw_attitude(turning, solution)
    shade_range(pressures, solution, "actuators[*].cylinder.p_?", "chambers")
    _stack(powers, solution)
    return figure


def _draw_attitude(axes: Axes, solution: Solution) -> None:
    roll, pitch = np.degrees(attitude(solution))
    axes.plot(solution.t, roll, color="#0072B2", label="roll")
    axes.plot(solution.t, pitch, color="#D55E00", linestyle="--", label="pitch")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=8.0)


def _stack(axes: Axes, solution: Solution) -> None:
    """Stack what becomes heat, the largest first, and draw the work on the joints."""
    layers = {name: total(solution, *signals) for name, signals in LOSSES.items()}
    order = sorted(layers, key=lambda name: -float(np.trapezoid(layers[name], solution.t)))
    heat = [layers[name] for name in order]
    axes.stackplot(solution.t, heat, labels=order, colors=FILLS, linewidth=0.3, edgecolor="white", zorder=0.6)
    axes.lines[0].set(color="black")
    work = total(solution, "actuators[*].P_work")
    axes.plot(solution.t, work, color="white", linewidth=2.5)  # a rim, so that the dots show on any layer
    axes.plot(solution.t, work, color="black", linestyle=":", label="work on the joints")
    axes.set_axisbelow(True)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=8.0, reverse=True)


def total(solution: Solution, *signals: str) -> FloatArray:
    """Return the sum (nt,) of all signals of these patterns."""
    paths = [path for signal in signals for path in solution.select(signal)]
    summed: FloatArray = solution.values(paths).sum(axis=1)
    return summed
