"""The study's figures: fronts of power against sag and force error, cascades of losses, horizon and error."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from arthur_acausal.models.arthur.budget import cascades
from arthur_acausal.models.arthur.study.comparison import FRONTS, TRIED, Comparison
from arthur_acausal.models.arthur.study.design import ERRORS, HORIZONS
from arthur_acausal.models.arthur.study.measures import LOSSES
from arthur_acausal.models.arthur.study.schemes import Scheme
from arthur_acausal.models.arthur.study.statistics import estimate

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = ("#333333", "#999999", "#0072B2", "#56B4E9", "#009E73", "#D55E00", "#CC79A7", "#E69F00")
MARKS = "o*sD^vPX"
TITLES = {"undershoot_bar_rms": "supply undershoot, rms [bar]", "force_error_rms": "force error, rms [N]"}


def figures(comparison: Comparison) -> dict[str, Figure]:
    """Return the figures by their file names; those of what was not varied are left out."""
    found = {"pareto": fronts(comparison)} if comparison.points() else {}
    for task in ("stand", TRIED):
        if powers := losses(comparison, task):
            found[f"cascade-{task.replace(' ', '-')}"] = cascades(powers)
    for name, values, title, unit in (
        ("horizon", HORIZONS, "horizon [ms]", 1e3),
        ("error", ERRORS, "error of the pump's size in the model [%]", 100.0),
    ):
        if any(
            r.case.horizon != HORIZONS[0] if name == "horizon" else r.case.error for r in comparison.results
        ):
            found[name] = varied(comparison, name, values, title, unit)
    return found


def fronts(comparison: Comparison) -> Figure:
    """Return power against sag and against the force error, a line a scheme over its set points, a row a task."""
    from matplotlib.figure import Figure

    tasks, points = comparison.moved, comparison.points()
    figure = Figure(figsize=(11.0, 4.6 * len(tasks)), layout="constrained")
    grid = figure.subplots(len(tasks), len(FRONTS), squeeze=False)
    for task, row in zip(tasks, grid, strict=True):
        for axes, name in zip(row, FRONTS, strict=True):
            for k, scheme in enumerate(comparison.schemes):
                mine = [
                    p
                    for p in points
                    if (p["scheme"], p["task"]) == (scheme.name, task) and p[name] is not None
                ]
                _line(axes, k, scheme, sorted(mine, key=lambda p: p["set_point"]), name)
            axes.set_xlabel(TITLES[name])
            axes.set_ylabel("battery power [W]")
            axes.set_ylim(bottom=0.0)
            axes.set_xlim(left=0.0)
            axes.spines[["top", "right"]].set_visible(False)
            axes.set_title(f"{task}: down and left is better", fontsize=10.0)
    figure.axes[0].legend(fontsize=8.0, title="ringed: own set point", title_fontsize=8.0)
    return figure


def _line(axes: Axes, k: int, scheme: Scheme, points: Sequence[Mapping[str, Any]], name: str) -> None:
    """Draw a scheme's points; where the robot fell there is none, but a word."""
    upright = [p for p in points if not p["falls"]]
    for p in points:
        if p["falls"]:
            told = f"{scheme.name}, {p['set_point']:g} {p['unit']}: {p['falls']} of {p['runs']} fell"
            axes.annotate(told, (0.98, 0.02 + 0.05 * k), xycoords="axes fraction", ha="right", fontsize=7.0)
    x, y = ([p[what] for p in upright] for what in (name, "electrical_W"))
    dx, dy = ([p[f"{what}_ci95"] or 0.0 for p in upright] for what in (name, "electrical_W"))
    axes.errorbar(
        x, y, yerr=dy, xerr=dx, label=scheme.name, color=COLOURS[k], marker=MARKS[k], ms=4.0, lw=1.0,
        elinewidth=0.6,
    )  # fmt: skip
    for p in upright:
        if p["set_point"] == scheme.set_point.values[0]:
            axes.plot(p[name], p["electrical_W"], "o", ms=10.0, mfc="none", mec=COLOURS[k])


def losses(comparison: Comparison, task: str) -> dict[str, dict[str, float]]:
    """Return the mean powers of each scheme at a task by its title, for the cascades of the report's figure 2-2."""
    powers = {}
    for scheme in comparison.schemes:
        names = ("electrical", "stored", "work", *LOSSES)
        told = {name: comparison.mean(scheme, task, f"{name}_W").mean for name in names}
        known = {name: value for name, value in told.items() if value is not None}
        if len(known) == len(told):
            powers[f"{scheme.name}, {task}"] = known
    return powers


def varied(comparison: Comparison, name: str, values: Sequence[float], title: str, unit: float) -> Figure:
    """Return power and sag over the horizon or the model's error, of the schemes that have them."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11.0, 4.2), layout="constrained")
    panels: list[tuple[Axes, str, str]] = list(
        zip(
            figure.subplots(1, 2),
            ("electrical_W", "undershoot_bar_rms"),
            ("battery power [W]", TITLES["undershoot_bar_rms"]),
            strict=True,
        )
    )
    for axes, measure, label in panels:
        for k, scheme in enumerate(comparison.schemes):
            if not (scheme.foresees if name == "horizon" else scheme.models and not scheme.knows):
                continue
            told = {
                x: estimate(r[measure] for r in comparison.changed(scheme, name, x)) for x in sorted(values)
            }
            known = {x: e for x, e in told.items() if e.mean is not None}
            axes.errorbar(
                [x * unit for x in known], [e.mean or 0.0 for e in known.values()],
                yerr=[e.ci95 or 0.0 for e in known.values()], color=COLOURS[k], marker=MARKS[k], ms=4.0, lw=1.0,
                elinewidth=0.6, label=scheme.name,
            )  # fmt: skip
        axes.set_xlabel(title)
        axes.set_ylabel(label)
        axes.set_ylim(bottom=0.0)
        axes.spines[["top", "right"]].set_visible(False)
    figure.axes[0].legend(fontsize=8.0)
    return figure
