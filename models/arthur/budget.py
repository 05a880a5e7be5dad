"""Where the battery's energy goes: the powertrain's budget as a cascade, and the balance of the rigid bodies."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import ceil
from typing import TYPE_CHECKING

import numpy as np

from arthur_acausal import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SMALL = 0.004
"""Terms below this share of the input are drawn together."""
WIDE = 4
"""Cascades in a row."""
ENDS = ("electrical", "stored", "work")
COLOURS = {"input": "#333333", "loss": "#D55E00", "stored": "#56B4E9", "work": "#009E73"}


@dataclass(frozen=True, slots=True)
class BodyEnergy:
    """Energies of the rigid bodies over a run [J]; it needs the quadruped's ``audit``.

    Attributes
    ----------
    work_J : of the cylinders on the joints, and of a push. positive_J : without the joints' braking.
    kinetic_J, potential_J : growth. contact_J : lost in contacts and joint limits. passive_J : lost in dampers.
    """

    work_J: float
    positive_J: float
    kinetic_J: float
    potential_J: float
    contact_J: float
    passive_J: float

    @property
    def closure(self) -> float:
        """What the balance leaves, as a share of the positive work."""
        rest = self.work_J - self.kinetic_J - self.potential_J - self.contact_J - self.passive_J
        return rest / self.positive_J


def body_energy(solution: Solution) -> BodyEnergy:
    """Return the balance of the rigid bodies; powers are integrated over the stored times."""
    t = solution.t

    def gain(path: str) -> float:
        values = solution[path]
        return float(values[-1] - values[0])

    def integral(power: np.ndarray) -> float:
        return float(np.trapezoid(power, t))

    work = solution.values(solution.select("actuators[*].P_work"))
    external = integral(solution["body.P_external"])
    return BodyEnergy(
        work_J=external,
        positive_J=integral(np.maximum(work, 0.0).sum(axis=1)),
        kinetic_J=gain("body.E_kinetic"),
        potential_J=gain("body.E_potential"),
        contact_J=-integral(solution["body.P_constraints"]),
        passive_J=-integral(solution["body.P_passive"]),
    )


def budget(runs: Mapping[str, Solution]) -> Figure:
    """Return a picture of the mean powers of some audited runs, by title, beside each other: see `cascades`."""
    return cascades({title: mean_powers(solution) for title, solution in runs.items()})


def mean_powers(solution: Solution) -> dict[str, float]:
    """Return the mean powers of an audited run [W]: ``electrical``, each loss, ``stored`` and ``work``."""
    energy, span = solution.energy(), float(solution.t[-1] - solution.t[0])
    told = {"electrical": energy.input_J, **energy.losses_J, "stored": energy.stored_J, "work": energy.work_J}
    return {name: value / span for name, value in told.items()}


def cascades(powers: Mapping[str, Mapping[str, float]]) -> Figure:
    """Return a picture of some budgets of `mean_powers`, by title, four in a row.

    Each is a cascade from the battery's power down through the losses, in the order of the way of the energy, to what
    is stored and what reaches the joints.
    """
    from matplotlib.figure import Figure

    columns = min(len(powers), WIDE)
    rows = ceil(len(powers) / columns)
    figure = Figure(figsize=(5.6 * columns, 4.6 * rows), layout="constrained")
    places = figure.subplots(rows, columns, squeeze=False).flat
    for axes, (title, told) in zip(places, powers.items(), strict=False):
        _cascade(axes, title, told)
    for axes in figure.axes[len(powers) :]:
        axes.remove()
    return figure


def _cascade(axes: Axes, title: str, told: Mapping[str, float]) -> None:
    power, stored, work = (told[name] for name in ENDS)
    losses = {name.replace("_", " "): value for name, value in told.items() if name not in ENDS}
    large = {name: value for name, value in losses.items() if value > SMALL * power}
    rows = [("battery", 0.0, power, COLOURS["input"])]
    left = power
    ends = [("stored", stored, "stored"), ("work on the joints", work, "work")]
    others = ("other losses", sum(losses.values()) - sum(large.values()), "loss")
    for name, value, kind in [*((n, v, "loss") for n, v in large.items()), others, *ends]:
        rows.append((name, left - value, value, COLOURS[kind]))
        left -= value
    names, starts, widths, colours = zip(*rows, strict=True)
    places = range(len(rows))
    axes.barh(places, widths, left=starts, color=colours, height=0.7)
    for place, start, width in zip(places, starts, widths, strict=True):
        share = f"{width:.1f} W, {100.0 * width / power:.1f} %"
        right = start + max(width, 0.0)
        inside = right > 0.7 * power
        x = min(start, start + width) if inside and place else right
        if not place:
            axes.text(
                power / 2, place, f"{width:.1f} W", ha="center", va="center", color="white", fontsize=8.0
            )
        else:
            pad = -3 if inside else 3
            axes.annotate(
                share, (x, place), (pad, 0), textcoords="offset points", fontsize=8.0, va="center",
                ha="right" if inside else "left",
            )  # fmt: skip
    axes.set_yticks(places, names)
    axes.invert_yaxis()
    axes.set_xlim(min(0.0, *(s + min(w, 0.0) for s, w in zip(starts, widths, strict=True))), 1.02 * power)
    axes.set_xlabel("mean power [W]")
    axes.set_title(title, fontsize=10.0)
    axes.spines[["top", "right"]].set_visible(False)
