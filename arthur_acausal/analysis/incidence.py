"""The block-triangular incidence matrix of a model: which equation determines which unknown, and in what order.

Rows and columns stand in the order of solution. States are known to the integrator and have no column. On the
diagonal each equation meets the unknown that it determines; blocks of more than one are solved together.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from arthur_acausal.graph import blt, matching
from arthur_acausal.result.plot import style
from arthur_acausal.transform.structured import StructuredDAE

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

NAMED_UP_TO = 45  # equations whose rows and columns are named
SIDE, LEAST_SIDE, CELL = 7.0, 2.6, 0.28  # inches: of a large matrix, of a small one, of an entry
LONGEST = 46  # characters of a name
MARK = 6.0  # points: of the marks in the legend


@dataclass(frozen=True, slots=True)
class Incidence:
    """Entries as (row, column) in the order of solution; ``blocks``: first row and size of each diagonal block.

    ``torn``: columns that stay unknowns of the integrator; ``rates``: columns that are derivatives of states.
    """

    model: str
    rows: list[str]
    columns: list[str]
    entries: list[tuple[int, int]]
    blocks: list[tuple[int, int]]
    torn: frozenset[int]
    rates: frozenset[int]


def incidence_of(dae: StructuredDAE) -> Incidence:
    """Return the incidence matrix of the equations that remain after alias elimination and index reduction."""
    causal, nodes, reduced = dae.causal, dae.nodes, dae.reduced
    is_state = set(causal.states)
    rates = {nodes.derivative[n] for n in causal.states} - is_state
    unknown = [n for n in range(len(nodes.all)) if n not in is_state]
    place = {n: k for k, n in enumerate(unknown)}
    edges = [
        sorted((place[n] for n in row if n in place), key=lambda k: unknown[k] not in rates)
        for row in reduced.edges
    ]
    assigned = matching(edges, len(unknown))
    blocks = blt(edges, assigned)
    order = [row for block in blocks for row in block]
    column = {assigned[row]: k for k, row in enumerate(order)}
    starts, first = [], 0
    for block in blocks:
        starts.append((first, len(block)))
        first += len(block)
    torn = {place[n] for n in causal.torn if n in place}
    return Incidence(
        dae.flat.name,
        [reduced.rows[row].text for row in order],
        [nodes.name(unknown[assigned[row]]) for row in order],
        [(k, column[v]) for k, row in enumerate(order) for v in edges[row]],
        starts,
        frozenset(column[v] for v in torn),
        frozenset(k for v, k in column.items() if unknown[v] in rates),
    )


def draw_incidence(incidence: Incidence) -> Figure:
    """Draw the matrix: its entries, the diagonal blocks, and names where they can be read."""
    from matplotlib.figure import Figure

    n = len(incidence.rows)
    with style():
        named = n <= NAMED_UP_TO
        side = min(SIDE, max(LEAST_SIDE, CELL * n)) if named else SIDE
        size = (side + 4.2, side + 2.0) if named else (side + 0.5, side + 0.6)
        figure = Figure(figsize=size, layout="constrained")
        ax = figure.subplots()
        ax.grid(False)
        _blocks(ax, incidence)
        _entries(ax, incidence)
        ax.set_xlim(-0.5, n - 0.5)
        ax.set_ylim(n - 0.5, -0.5)
        ax.set_aspect("equal")
        for edge in ("top", "right"):
            ax.spines[edge].set_visible(True)
        if named:
            ax.set_yticks(range(n), [_short(row) for row in incidence.rows], fontsize=6.5)
            ax.set_xticks(range(n), [_short(c) for c in incidence.columns], fontsize=6.5, rotation=90)
        else:
            ax.set_ylabel("equation, in the order of solution")
            ax.set_xlabel("unknown, in the same order")
        loops = sum(size > 1 for _, size in incidence.blocks)
        largest = max((size for _, size in incidence.blocks), default=0)
        about = f"{n:,} equations, {len(incidence.blocks):,} blocks"
        if loops:
            about += f", {loops:,} solved together (largest {largest:,}), {len(incidence.torn):,} torn"
        figure.suptitle(f"{incidence.model}: {about}", fontsize=10.0, x=0.01, ha="left")
        legend = ax.legend(loc="upper right", fontsize=7.0 if named else 8.0, frameon=True)
        for handle in legend.legend_handles:
            if handle is not None:
                handle.set(markersize=MARK)
    return figure


def _short(text: str) -> str:
    """Return a name without its middle, where it is long: path and source line stay."""
    tail = LONGEST // 2 - 1
    return text if len(text) <= LONGEST else f"{text[: LONGEST - tail - 1]}…{text[-tail:]}"


def _blocks(ax: Axes, incidence: Incidence) -> None:
    from matplotlib.patches import Rectangle

    for first, size in incidence.blocks:
        if size > 1:
            corner = (first - 0.5, first - 0.5)
            ax.add_patch(
                Rectangle(corner, size, size, facecolor="#FBE3CF", edgecolor="#D55E00", linewidth=1.0)
            )


def _entries(ax: Axes, incidence: Incidence) -> None:
    """Draw the entries by what their column is; on the diagonal, darker."""
    n = max(len(incidence.rows), 1)
    size = min(max(1.8, 0.75 * 72.0 * SIDE / n), 9.0)
    kinds = (
        ("derivative of a state", "#009E73", incidence.rates),
        ("torn: left to IDA", "#D55E00", incidence.torn),
        ("computed", "#0072B2", frozenset(range(n)) - incidence.rates - incidence.torn),
    )
    for label, colour, columns in kinds:
        chosen = [(c, r) for r, c in incidence.entries if c in columns]
        if not chosen:
            continue
        x, y = zip(*chosen, strict=True)
        diagonal = [(c, r) for c, r in chosen if c == r]
        ax.plot(x, y, "s", color=colour, alpha=0.45, markersize=size, markeredgewidth=0.0)
        x, y = zip(*diagonal, strict=True) if diagonal else ((), ())
        ax.plot(x, y, "s", color=colour, markersize=size, markeredgewidth=0.0, label=label)
