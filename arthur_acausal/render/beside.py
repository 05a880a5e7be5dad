"""Curves beside a body's pictures: what the model chooses, and contact forces."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from arthur_acausal import Solution
from arthur_acausal.mujoco.dynamics import FloatArray
from arthur_acausal.mujoco.offscreen import Image
from arthur_acausal.result.panel import Panel, panels
from arthur_acausal.result.plot import PALETTE, STYLES, draw, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Shown: TypeAlias = Mapping[str, Any] | Sequence[str]

DPI = 100
WIDTH = 400  # of the curves beside a film, pixels
NOW = (213, 94, 0)  # colour of the line at the time that is shown
CELL = (3.0, 2.25)  # of a picture in a strip, inches
COLUMNS = 4
HEIGHT = 1.7  # of a panel below a strip, inches


class Curves:
    """What is drawn beside the body: panels of a solution, and contact forces [N] over their own times."""

    def __init__(
        self, solution: Solution, shown: Shown, times: FloatArray, forces: Mapping[str, FloatArray]
    ) -> None:
        self.solution, self.times, self.forces = solution, times, forces
        self.panels: list[Panel] = panels(solution, shown) if shown else []

    def __len__(self) -> int:
        """How many panels there are."""
        return len(self.panels) + bool(self.forces)

    def draw(self, axes: Sequence[Axes]) -> None:
        """Draw all panels, one into each axes."""
        for ax, panel in zip(axes, self.panels, strict=False):
            draw(ax, self.solution, panel)
        if self.forces:
            for k, (name, force) in enumerate(self.forces.items()):
                colour, line = PALETTE[k % len(PALETTE)], STYLES[k % len(STYLES)]
                axes[-1].plot(self.times, force, color=colour, linestyle=line, label=name)
            axes[-1].set_ylabel("contact force [N]")
            axes[-1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        axes[-1].set_xlabel("time [s]")
        if self.times[0] < self.times[-1]:
            axes[-1].set_xlim(self.times[0], self.times[-1])


class Beside:
    """The curves beside a film: drawn once, with a line at the present time."""

    def __init__(self, curves: Curves, height: int) -> None:
        from matplotlib.figure import Figure

        with style():
            figure = Figure(figsize=(WIDTH / DPI, height / DPI), dpi=DPI, layout="constrained")
            axes = list(figure.subplots(len(curves), 1, sharex=True, squeeze=False)[:, 0])
            curves.draw(axes)
            for ax in axes:
                if ax.get_legend() is not None:
                    place = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0), "ncols": 4, "fontsize": 6.5}
                    ax.legend(**place, handlelength=1.2, columnspacing=0.8, borderpad=0.1)
            self._image = _pixels(figure)
        self._boxes = [ax.get_window_extent() for ax in axes]
        self._span = axes[-1].get_xlim()

    def at(self, t: float) -> Image:
        """Return the picture with a line at the time ``t`` [s]."""
        image = self._image.copy()
        first, last = self._span
        for box in self._boxes:
            x = round(box.x0 + (t - first) / (last - first) * (box.width - 2))
            rows = slice(image.shape[0] - round(box.y1), image.shape[0] - round(box.y0))
            image[rows, x : x + 2] = NOW
        return image


def strip(images: Sequence[Image], times: FloatArray, curves: Curves) -> Figure:
    """Return a film strip: pictures with their times, and below them the curves, with lines at these times."""
    from matplotlib.figure import Figure

    columns = min(COLUMNS, len(images))
    rows = -(-len(images) // columns)
    heights = [CELL[1]] * rows + [HEIGHT] * len(curves)
    with style():
        figure = Figure(figsize=(CELL[0] * columns, sum(heights)), layout="constrained")
        grid = figure.add_gridspec(len(heights), columns, height_ratios=heights)
        for k, (image, t) in enumerate(zip(images, times.tolist(), strict=True)):
            cell = figure.add_subplot(grid[k // columns, k % columns])
            cell.imshow(image)
            cell.set_axis_off()
            cell.set_title(f"{t:.3g} s", fontsize=8.0)
        below: list[Axes] = []
        for row in range(rows, len(heights)):
            below.append(figure.add_subplot(grid[row, :], sharex=below[0] if below else None))
        if below:
            curves.draw(below)
            for ax in below:
                ax.label_outer()
                for t in times.tolist():
                    ax.axvline(t, color="#999999", linewidth=0.5, zorder=0.5)
    return figure


def _pixels(figure: Figure) -> Image:
    """Return a figure as an image (height, width, 3)."""
    from PIL.Image import open as read

    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=DPI)
    return np.asarray(read(buffer).convert("RGB"))
