"""Pictures of a sweep: curves over a parameter, a heat map of two, parallel coordinates, scatter matrix, a fan."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.errors import UsageError, nearest
from arthur_acausal.sweep.opened import Sweep

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

KINDS = ("curves", "heat", "parallel", "matrix", "fan")
MOST_IN_MATRIX = 5
MOST_GROUPS = 8  # curves in one picture
COLOURS = "viridis"


def picture(
    sweep: Sweep, kind: str, *, x: str | None = None, y: str | None = None, by: str | None = None
) -> Figure:
    """Draw a sweep.

    Parameters
    ----------
    kind : "curves": ``y`` over ``x``, a curve for each value of ``by``; "heat": ``y`` as colour over ``x`` and
        ``by``; "parallel": all factors and ``y``; "matrix": factors and ``y`` against each other; "fan": the
        trajectories of the variable ``y`` over time with their quantiles.
    x, y, by : columns of the table; by default the first factor, the first reduction, the second factor.

    Raises UsageError for an unknown kind or column, and for a picture that these runs cannot give.
    """
    from arthur_acausal.result.plot import style

    if kind not in KINDS:
        raise UsageError(f"there is no picture {kind!r}", remedy=nearest(kind, KINDS) or ", ".join(KINDS))
    with style():
        if kind == "fan":
            return _fan(sweep, y)
        frame: Any = sweep.table[sweep.table["status"].isin(["ok", "terminated"])]
        numeric = [n for n in frame.columns if frame[n].dtype.kind in "fi"]
        factors = [n for n in sweep.factors if n in numeric and frame[n].nunique() > 1]
        y = _choose(y, [n for n in sweep.reductions if n in numeric] or numeric, numeric, "y")
        if kind == "parallel":
            return _parallel(sweep, frame, factors, y)
        if kind == "matrix":
            return _matrix(sweep, frame, [*factors[: MOST_IN_MATRIX - 1], y])
        x = _choose(x, factors or numeric, numeric, "x")
        others = [n for n in factors if n != x]
        by = _choose(by, others, numeric, "by") if by is not None or others else None
        return _heat(sweep, frame, x, by, y) if kind == "heat" else _curves(sweep, frame, x, by, y)


def _choose(given: str | None, usual: list[str], known: list[str], what: str) -> str:
    if given is None:
        if not usual:
            raise UsageError(f"the sweep has no number to draw as {what}")
        return usual[0]
    if given not in known:
        raise UsageError(f"the table has no number {given!r}", remedy=nearest(given, known))
    return given


def label(sweep: Sweep, name: str) -> str:
    """Return the name of a column with its unit."""
    unit = sweep.about["units"].get(name, "")
    return f"{name} [{unit}]" if unit and unit != "1" else name


def _figure(width: float = 7.0, height: float = 4.5, **arguments: Any) -> tuple[Figure, Any]:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    return figure, figure.subplots(**arguments)


def _curves(sweep: Sweep, frame: Any, x: str, by: str | None, y: str) -> Figure:
    import matplotlib as mpl

    figure, ax = _figure()
    groups: list[tuple[Any, Any]] = [(None, frame)] if by is None else list(frame.groupby(by))
    if len(groups) > MOST_GROUPS:  # samples rather than a grid: points, coloured by the other one
        drawn = ax.scatter(frame[x], frame[y], c=frame[by], cmap=COLOURS, s=14)
        figure.colorbar(drawn, label=label(sweep, str(by)))
    else:
        shades = mpl.colormaps[COLOURS](np.linspace(0.0, 0.85, len(groups)))
        for colour, (value, part) in zip(shades, groups, strict=True):
            middle = part.groupby(x)[y].median()
            name = None if value is None else f"{value:.4g}"
            (line,) = ax.plot(middle.index, middle.to_numpy(), "-o", ms=4, color=colour, label=name)
            if len(part) > len(middle):  # several runs at a place: all of them behind their median
                ax.plot(part[x], part[y], ".", ms=4, color=line.get_color(), alpha=0.35)
        if by is not None:
            ax.legend(title=label(sweep, by))
    ax.set(xlabel=label(sweep, x), ylabel=label(sweep, y))
    return figure


def _heat(sweep: Sweep, frame: Any, x: str, by: str | None, y: str) -> Figure:
    if by is None:
        raise UsageError("a heat map needs two factors that vary", remedy="draw curves")
    figure, ax = _figure()
    table = frame.pivot_table(index=by, columns=x, values=y, aggfunc="median")
    if table.size <= 4 * len(frame):
        drawn = ax.pcolormesh(table.columns, table.index, table.to_numpy(), cmap=COLOURS, shading="nearest")
    else:  # samples: the plane between them
        drawn = ax.tricontourf(frame[x], frame[by], frame[y], levels=14, cmap=COLOURS)
        ax.plot(frame[x], frame[by], ".", ms=3, color="white", alpha=0.6)
    figure.colorbar(drawn, label=label(sweep, y))
    ax.set(xlabel=label(sweep, x), ylabel=label(sweep, by))
    return figure


def _parallel(sweep: Sweep, frame: Any, factors: list[str], y: str) -> Figure:
    import matplotlib as mpl

    names = [*factors, y]
    values = frame[names].to_numpy(dtype=float)
    low, high = np.nanmin(values, axis=0), np.nanmax(values, axis=0)
    height = (values - low) / np.where(high > low, high - low, 1.0)
    figure, ax = _figure(max(6.0, 1.7 * len(names)))
    for row in height[np.argsort(height[:, -1])]:  # the highest above the others
        if np.isfinite(row).all():
            ax.plot(row, color=mpl.colormaps[COLOURS](row[-1]), lw=1.0, alpha=0.6)
    for k in range(len(names)):
        ax.axvline(k, color="0.3", lw=0.8)
        ax.annotate(f"{low[k]:.4g}", (k, -0.03), ha="center", va="top", fontsize=8)
        ax.annotate(f"{high[k]:.4g}", (k, 1.03), ha="center", va="bottom", fontsize=8)
    ax.set_xticks(range(len(names)), [label(sweep, n).replace(" [", "\n[") for n in names])
    ax.set(ylim=(-0.12, 1.12), yticks=[])
    ax.spines[:].set_visible(False)
    ax.tick_params(length=0)
    return figure


def _matrix(sweep: Sweep, frame: Any, names: list[str]) -> Figure:
    n = len(names)
    figure, axes = _figure(1.9 * n + 1.0, 1.9 * n + 0.6, nrows=n, ncols=n, squeeze=False)
    for i, row in enumerate(names):
        for j, column in enumerate(names):
            ax: Axes = axes[i][j]
            if i == j:
                ax.hist(frame[row].dropna(), bins=20, color="0.6")
            else:
                ax.plot(frame[column], frame[row], ".", ms=3, alpha=0.5)
            ax.tick_params(labelsize=7, labelleft=j == 0 and i > 0, labelbottom=i == n - 1)
            if i == n - 1:
                ax.set_xlabel(label(sweep, column), fontsize=8)
            if j == 0:
                ax.set_ylabel(label(sweep, row), fontsize=8)
    return figure


def _fan(sweep: Sweep, y: str | None) -> Figure:
    variables = list(sweep.about["trajectories"]["variables"])
    if not variables:
        raise UsageError(f"{sweep.folder} keeps no trajectories")
    if y is not None and y not in variables:
        raise UsageError(f"the sweep keeps no trajectory of {y!r}", remedy=nearest(y, variables))
    path = y or variables[0]
    array = sweep.dataset[path]
    values: NDArray[np.float64] = array.to_numpy()
    time = sweep.dataset["time"].to_numpy()
    figure, ax = _figure()
    quantiles = np.nanquantile(values, [0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0], axis=0)
    for k, (shade, name) in enumerate((("0.9", "all runs"), ("0.78", "90 %"), ("0.6", "50 %"))):
        ax.fill_between(time, quantiles[k], quantiles[-1 - k], color=shade, lw=0.0, label=name)
    ax.plot(time, quantiles[3], color="black", label="median")
    ax.legend()
    ax.set(xlabel="time [s]", ylabel=f"{path} [{array.attrs.get('units', '')}]")
    return figure
