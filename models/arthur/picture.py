"""The powertrain's picture: what the pump makes, where it goes, and what each watt turns into."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import Solution
from arthur_acausal.models.arthur.energy import POWERS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

LEG = 3  # cylinders drawn by themselves, those of the first leg; the range of all is shaded
FILLS = ("#0072B2", "#F0E442", "#D55E00", "#56B4E9", "#882255", "#E69F00", "#777777")
"""Told apart by people who see colours differently; dark and light in turn, for a print in grey."""


def picture(solution: Solution) -> Figure:
    """Return the picture of a run: speed, pressures, flows, chamber pressures of one leg, and powers."""
    figure = solution.plot(
        {
            "motor speed [rpm]": {"motor": "motor.w"},
            "pressure [bar]": {
                "manifold": "manifold.p",
                "after the filter": "filter.port_b.p",
                "reservoir": "reservoir.p",
            },
            "flow [L/min]": {"pump": "pump.q", "to the valves": "filter.q", "relief valve": "relief.q"},
            "chambers [bar]": chambers(solution),
            "power [W]": {"electrical input": "motor.P_el"},
        }
    )
    *_, chamber_axes, power_axes = figure.axes
    shade_range(chamber_axes, solution, "cylinders[*].p_?", "range of all")
    stack_losses(power_axes, solution)
    return figure


def chambers(solution: Solution) -> dict[str, str]:
    """Return the chambers of the first leg's cylinders, by label."""
    n = len(solution.select("cylinders[*].p_A"))
    return {
        f"cylinder {i}, {side}": f"cylinders[{i}].p_{side}" for i in range(min(LEG, n)) for side in ("A", "B")
    }


def shade_range(axes: Axes, solution: Solution, pattern: str, label: str) -> None:
    """Shade between the lowest and the highest of all pressures of a pattern."""
    pressures = solution.values(solution.select(pattern)) / 1e5
    low, high = pressures.min(axis=1), pressures.max(axis=1)
    axes.fill_between(solution.t, low, high, color="#e4e4e4", zorder=0.4, label=label)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=8.0)


def stack_losses(axes: Axes, solution: Solution) -> None:
    """Stack the losses, the largest energy first, the small ones together; add the work on the loads.

    The labels say the energies of the model's own audit.
    """
    energy, terms = solution.energy(), losses(solution)
    energies = {name: sum(v for term, v in energy.losses_J.items() if kind(term) == name) for name in terms}
    order = sorted(terms, key=lambda name: -energies[name])
    large, small = order[: len(FILLS) - 1], order[len(FILLS) - 1 :]
    layers = [terms[name] for name in large]
    labels = [f"{name}, {joules(energies[name])}" for name in large]
    if small:
        layers.append(np.sum([terms[name] for name in small], axis=0))
        labels.append(f"other losses, {joules(sum(energies[name] for name in small))}")
    axes.stackplot(
        solution.t, layers, labels=labels, colors=FILLS, linewidth=0.3, edgecolor="white", zorder=0.6
    )
    axes.lines[0].set(color="black", label=f"electrical input, {joules(energy.input_J)}")
    work = solution.values(solution.select("loads[*].P_work")).sum(axis=1)
    label = f"work on the loads, {joules(energy.work_J)}"
    axes.plot(solution.t, work, color="white", linewidth=2.5)  # a rim, so that the dots show on any layer
    axes.plot(solution.t, work, color="black", linestyle=":", label=label)
    axes.set_axisbelow(True)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=8.0, reverse=True)


def losses(solution: Solution) -> dict[str, FloatArray]:
    """Return the power [W] of each kind of loss, (nt,), all parts of a kind together."""
    signals = {name: f"{part}.{signal}" for name, (part, signal) in POWERS.items()}
    del signals["input"], signals["work"]
    signals |= {"valves": "valves[*].P_loss", "drive": "drive.P_loss"}
    return {
        kind(name): solution.values(solution.select(path)).sum(axis=1)
        for name, path in signals.items()
        if "*" in path or path in solution
    }


def joules(energy: float) -> str:
    """Return an energy as text: whole joules, or one decimal below ten."""
    return f"{energy:.0f} J" if abs(energy) >= 10.0 else f"{energy:.1f} J"


def kind(term: str) -> str:
    """Return what a term of the audit is called: "valves[3]" is one of the valves."""
    return term.partition("[")[0].replace("_", " ")
