"""Drawing the diagram of a model with Matplotlib."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from arthur_acausal.analysis.diagram import SIGNAL, Box, Diagram, Line
from arthur_acausal.analysis.layout import heights, layers, neighbours
from arthur_acausal.result.plot import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = {
    "electrical": "#E69F00",
    "hydraulic": "#0072B2",
    "thermal": "#D55E00",
    "rotational": "#009E73",
    "translational": "#6B4C9A",
    "planar": "#CC79A7",
    SIGNAL: "#777777",
}
OTHERS = ("#000000", "#56B4E9", "#8B5A2B", "#B2182B")
CHARACTER, LINE, PAD = 0.073, 0.15, 0.12  # inches
PORT = 0.16  # between lines that end at one side of a box
COLUMN_GAP, LEAST_WIDTH = 1.0, 0.9
MARGIN, HEAD, FOOT = 0.3, 0.55, 0.45


@dataclass(slots=True)
class Placed:
    """A box with its centre, width and height [inch], y upwards, and its column."""

    box: Box
    x: float
    y: float
    width: float
    height: float
    column: int


def draw(diagram: Diagram) -> Figure:
    """Draw boxes in columns, lines between them in the colours of their domains, and a legend."""
    from matplotlib.figure import Figure

    placed = place(diagram)
    left = min(p.x - p.width / 2 for p in placed) - MARGIN
    right = max(p.x + p.width / 2 for p in placed) + MARGIN
    low = min(p.y - p.height / 2 for p in placed) - MARGIN - FOOT
    high = max(p.y + p.height / 2 for p in placed) + MARGIN + HEAD
    right = max(
        right, left + CHARACTER * max(len(diagram.about), len(diagram.title)) + 2 * MARGIN, left + 4.0
    )
    with style():
        figure = Figure(figsize=(right - left, high - low))
        ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        ax.set_axis_off()
        ax.set_xlim(left, right)
        ax.set_ylim(low, high)
        colours = _colours(line.domain for line in diagram.lines)
        _lines(ax, diagram.lines, placed, colours)
        for p in placed:
            _box(ax, p)
        ax.text(left + MARGIN, high - 0.12, diagram.title, fontsize=11, fontweight="bold", va="top")
        ax.text(left + MARGIN, high - 0.36, diagram.about, fontsize=8, color="#555555", va="top")
        _legend(ax, colours, left + MARGIN, low + 0.25)
    return figure


def place(diagram: Diagram) -> list[Placed]:
    """Return where the boxes stand."""
    boxes, edges = diagram.boxes, [(line.a, line.b) for line in diagram.lines]
    order, near = layers(len(boxes), edges), neighbours(len(boxes), edges)
    column = {node: k for k, layer in enumerate(order) for node in layer}
    ports = [0] * len(boxes)
    for node in range(len(boxes)):
        sides = [0, 0]
        for line in diagram.lines:
            if node in (line.a, line.b) and line.a != line.b:
                other = line.b if line.a == node else line.a
                sides[column[other] >= column[node]] += 1
        ports[node] = max(sides)
    sizes = [max(_height(box), PORT * (ports[k] + 1)) for k, box in enumerate(boxes)]
    centre = heights(order, near, sizes)
    widths = [max(LEAST_WIDTH, CHARACTER * max(map(len, _texts(box))) + 2 * PAD) for box in boxes]
    x, xs = 0.0, []
    for layer in order:
        width = max(widths[node] for node in layer)
        xs.append(x + width / 2)
        x += width + COLUMN_GAP
    return [
        Placed(box, xs[column[k]], -centre[k], widths[k], sizes[k], column[k]) for k, box in enumerate(boxes)
    ]


def _texts(box: Box) -> list[str]:
    about = f"{box.count} × {box.kind}" if box.count > 1 else box.kind
    return [box.name, about, *([f"▸ {', '.join(box.inputs)}"] if box.inputs else [])]


def _height(box: Box) -> float:
    return LINE * len(_texts(box)) + 2 * PAD


def _colours(domains: Iterable[str]) -> dict[str, str]:
    found = dict.fromkeys(domains)
    others = iter(OTHERS * len(found))
    return {domain: COLOURS.get(domain) or next(others) for domain in found}


def _box(ax: Axes, p: Placed) -> None:
    from matplotlib.patches import FancyBboxPatch

    shadows = [0.08, 0.04] if p.box.count > 1 else []
    for shift in [*shadows, 0.0]:
        corner = (p.x - p.width / 2 + shift, p.y - p.height / 2 - shift)
        ax.add_patch(
            FancyBboxPatch(
                corner,
                p.width,
                p.height,
                boxstyle="round,pad=0,rounding_size=0.05",
                facecolor="white",
                edgecolor="#333333",
                linewidth=0.9,
                zorder=3,
            )
        )
    texts = _texts(p.box)
    top = p.y + LINE * (len(texts) - 1) / 2
    for k, text in enumerate(texts):
        look = {"fontsize": 8.5, "fontweight": "bold"} if k == 0 else {"fontsize": 7.5, "color": "#555555"}
        if k == 2:
            look["color"] = COLOURS[SIGNAL]
        ax.text(p.x, top - LINE * k, text, ha="center", va="center", zorder=4, **look)  # type: ignore[arg-type]


def _lines(ax: Axes, lines: list[Line], placed: list[Placed], colours: dict[str, str]) -> None:
    """Draw the lines; those at one side of a box end below each other in the order of where they lead."""
    sides: dict[tuple[int, bool], list[tuple[float, int]]] = {}
    for k, line in enumerate(lines):
        for own, other in ((line.a, line.b), (line.b, line.a)):
            if line.a != line.b:
                right = placed[other].column >= placed[own].column
                sides.setdefault((own, right), []).append((-placed[other].y, k))
    ends: dict[tuple[int, int], tuple[float, float]] = {}
    for (node, right), members in sides.items():
        p = placed[node]
        for i, (_, k) in enumerate(sorted(members)):
            y = p.y + PORT * ((len(members) - 1) / 2 - i)
            ends[k, node] = (p.x + (p.width / 2 if right else -p.width / 2), y)
    for k, line in enumerate(lines):
        if line.a == line.b:
            _loop(ax, placed[line.a], colours[line.domain], line.count)
        else:
            same = placed[line.a].column == placed[line.b].column
            _curve(ax, ends[k, line.a], ends[k, line.b], line, colours[line.domain], same)


def _curve(
    ax: Axes, a: tuple[float, float], b: tuple[float, float], line: Line, colour: str, same: bool
) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    if same:  # both in one column: a bow beside it
        bow = max(a[0], b[0]) + 0.25 + 0.12 * min(abs(a[1] - b[1]), 2.5)
        points = [a, (bow, a[1]), (bow, b[1]), b]
    else:
        middle = (a[0] + b[0]) / 2
        points = [a, (middle, a[1]), (middle, b[1]), b]
    signal = line.domain == SIGNAL
    ax.add_patch(
        PathPatch(
            Path(points, [Path.MOVETO, Path.CURVE4, Path.CURVE4, Path.CURVE4]),
            facecolor="none",
            edgecolor=colour,
            linewidth=1.0 if signal else 1.8,
            linestyle="--" if signal else "-",
            zorder=2,
        )
    )
    if signal:
        way = -0.1 if points[2][0] < b[0] else 0.1
        corners = [(b[0], b[1]), (b[0] + way, b[1] + 0.045), (b[0] + way, b[1] - 0.045)]
        ax.fill(*zip(*corners, strict=True), color=colour, zorder=5, linewidth=0)
    if line.count > 1:
        x, y = (sum(w * q[i] for w, q in zip((1, 3, 3, 1), points, strict=True)) / 8 for i in (0, 1))
        ground = {"facecolor": "white", "edgecolor": "none", "pad": 0.8}
        ax.text(
            x, y, f"×{line.count}", fontsize=7, color=colour, ha="center", va="center", zorder=6, bbox=ground
        )


def _loop(ax: Axes, p: Placed, colour: str, count: int) -> None:
    """Draw what connects the members of one box: a small arc above it."""
    from matplotlib.patches import Arc

    x, y = p.x + p.width / 4, p.y + p.height / 2
    ax.add_patch(Arc((x, y), 0.34, 0.3, theta1=0, theta2=180, color=colour, linewidth=1.8, zorder=2))
    ax.text(x + 0.2, y + 0.1, f"×{count}", fontsize=7, color=colour, ha="left", va="center", zorder=6)


def _legend(ax: Axes, colours: dict[str, str], x: float, y: float) -> None:
    for domain, colour in sorted(colours.items()):
        ax.plot(
            [x, x + 0.3], [y, y], color=colour, linewidth=1.8, linestyle="--" if domain == SIGNAL else "-"
        )
        ax.text(x + 0.38, y, domain, fontsize=8, va="center")
        x += 0.38 + CHARACTER * len(domain) + 0.3
