"""Pictures of solutions over time."""

from __future__ import annotations

import io
import os
from collections.abc import Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from arthur_acausal.errors import ResultError
from arthur_acausal.result.atomic import write_atomically
from arthur_acausal.result.panel import Panel, Wanted, panels

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from arthur_acausal.result.solution import Solution

# Okabe and Ito (2008): told apart by people who see colours differently. With each colour goes a line style,
# so that a print in grey can be read too.
PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
STYLES = ("-", "--", "-.", ":")
STYLE: dict[Any, Any] = {
    "font.size": 9.0,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.formatter.useoffset": False,
    "axes.formatter.limits": (-4, 5),
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "legend.fontsize": 8.0,
    "lines.linewidth": 1.2,
    "savefig.dpi": 150.0,
}
WIDTH, PANEL_HEIGHT, MARGIN_HEIGHT = 9.0, 2.0, 0.9  # inches
MOST_EVENTS = 30  # more lines would hide the curves
LEGEND_ROWS = 13
FORMATS = ("png", "pdf", "svg")


def plot(solution: Solution, wanted: Wanted, file: str | os.PathLike[str] | None = None) -> Figure:
    """Draw variables over time and write the picture where a file is given; see `Solution.plot`."""
    chosen = panels(solution, wanted)
    if not chosen:
        raise ResultError("there is nothing to draw", remedy="name at least one variable")
    with style():
        figure, axes = new_figure([PANEL_HEIGHT] * len(chosen))
        for ax, panel in zip(axes, chosen, strict=True):
            draw(ax, solution, panel)
        finish(figure, axes, solution)
    if file is not None:
        write(figure, file)
    return figure


def style() -> AbstractContextManager[None]:
    """The look of all pictures; figures are made and drawn within it."""
    import matplotlib

    return matplotlib.rc_context(STYLE)


def new_figure(heights: Sequence[float]) -> tuple[Figure, list[Axes]]:
    """Empty panels of these heights [inch] below each other, with one time axis.

    The figure belongs to no window, so that it can be made on any machine and in any thread.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(WIDTH, MARGIN_HEIGHT + sum(heights)), layout="constrained")
    axes = figure.subplots(len(heights), 1, sharex=True, squeeze=False, height_ratios=heights)
    return figure, list(axes[:, 0])


def draw(ax: Axes, solution: Solution, panel: Panel) -> None:
    """Draw a panel's lines, with a legend beside them."""
    for index, (label, path) in enumerate(panel.lines.items()):
        ax.plot(
            solution.t,
            panel.unit.from_si(solution[path]),
            color=PALETTE[index % len(PALETTE)],
            linestyle=STYLES[index % len(STYLES)],
            label=label,
        )
    ax.set_ylabel(panel.label)
    if panel.lines:
        columns = 1 + (len(panel.lines) - 1) // LEGEND_ROWS
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), ncols=columns)


def finish(figure: Figure, axes: Sequence[Axes], solution: Solution) -> None:
    """Title, time axis, and a thin line at each event where they are few."""
    figure.suptitle(title(solution), x=0.01, ha="left", fontsize=11.0)
    figure.align_ylabels(list(axes))
    axes[-1].set_xlabel("time [s]")
    span = solution.t[0], solution.t[-1]
    if span[0] < span[1]:
        axes[-1].set_xlim(*span)
    times = sorted({event.time for event in solution.events})
    for ax in axes:
        for time in times if len(times) <= MOST_EVENTS else ():
            ax.axvline(time, color="#999999", linewidth=0.5, zorder=0.5)


def title(solution: Solution) -> str:
    """What the model is; how the run ended, where that was early."""
    about = solution.run.description.removesuffix(".") or solution.model
    status = solution.run.status
    return about if status == "finished" else f"{about} ({status} at {solution.t[-1]:.4g} s)"


def write(figure: Figure, file: str | os.PathLike[str]) -> None:
    """Write a picture; its format follows from the name."""
    kind = check_format(file)
    buffer = io.BytesIO()
    with style():
        figure.savefig(buffer, format=kind)
    write_atomically(file, buffer.getvalue())


def check_format(file: str | os.PathLike[str]) -> str:
    """The format that a file's name asks for. Raises ResultError where pictures are not written so."""
    kind = Path(file).suffix.lower().removeprefix(".")
    if kind not in FORMATS:
        raise ResultError(
            f"cannot write {file}",
            cause=f"pictures are not written as {kind!r}" if kind else "its name has no ending",
            remedy=f"end the name in {', '.join('.' + known for known in FORMATS)}",
        )
    return kind
