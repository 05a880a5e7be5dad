"""The figures of the valve study, with the report's axes and numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from casadi import SX, Function
from numpy.typing import NDArray

from arthur_acausal import Solution
from arthur_acausal.components.hydraulic.servo_valves import Shape, full_area, open_area
from arthur_acausal.components.hydraulic.servo_valves.jets import von_mises
from arthur_acausal.models.arthur.valves.actuation import settled_errors

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]
Curve = tuple[str, FloatArray, FloatArray]

STYLES = ("-", "--", ":", "-.", (0, (6, 1, 1, 1, 1, 1)), (0, (1, 4)))
OPENING = "valve opening ξ/$d_p$ [1]"


def figures(rotary: Solution, spool: Solution) -> dict[str, Figure]:
    """Return the report's figures by their file names."""
    s, x = rotary["s"], spool["s"]
    jets = float(s[rotary["T_jet"] > rotary["T_friction"]].min(initial=1.0))
    leads = float(x[spool["F_steady"] > spool["F_friction"]].max(initial=0.0))
    of_jets = rotary.final("W_jet") / rotary.final("W_with_jet")
    of_flow = spool.final("W_steady") / spool.final("W")
    needs = [run.final(name) for run, name in ((rotary, "W_no_jet"), (spool, "W"), (rotary, "W_with_jet"))]
    claim = "needs less work only without its jets" if needs == sorted(needs) else "against the spool valve"

    def torque(label: str, name: str) -> Curve:
        return label, s, rotary[name] * 1e3

    def work(label: str, name: str) -> Curve:
        return label, s, rotary[name] * 1e6

    return {
        "figure-3-5": jet_angles(),
        "figure-3-8": drawn(
            [
                torque("jets (3.31)", "T_jet"),
                torque("bearing friction", "T_friction"),
                torque("inertia", "T_inertia"),
                torque("fluid film", "T_viscous"),
            ],
            "torque [mN m]",
            f"Rotary valve: from {jets:.0%} of the opening the jets' torque exceeds the friction",
        ),
        "figure-3-9": drawn(
            [
                work("total with jets", "W_with_jet"),
                work("total without jets", "W_no_jet"),
                work("jets", "W_jet"),
                work("bearing friction", "W_friction"),
                work("inertia", "W_inertia"),
                work("fluid film", "W_viscous"),
            ],
            "work from closed [µJ]",
            f"Rotary valve: the jets take {of_jets:.0%} of the work",
        ),
        "figure-3-13": drawn(
            [
                ("steady flow force", x, spool["F_steady"]),
                ("film on the heads", x, spool["F_friction"]),
                ("inertia", x, spool["F_inertia"]),
            ],
            "axial force [N]",
            f"Spool valve: the steady flow force leads up to {leads:.0%} of the opening",
        ),
        "figure-3-14": drawn(
            [
                ("total", x, spool["W"] * 1e6),
                ("steady flow force", x, spool["W_steady"] * 1e6),
                ("film on the heads", x, spool["W_friction"] * 1e6),
                ("inertia", x, spool["W_inertia"] * 1e6),
            ],
            "work from the middle [µJ]",
            f"Spool valve: {of_flow:.0%} of the work go against the flow force",
        ),
        "figure-3-15": drawn(
            [
                work("rotary, with jets (3.31)", "W_with_jet"),
                ("spool", x, spool["W"] * 1e6),
                work("rotary, without jets", "W_no_jet"),
            ],
            "work to open [µJ]",
            f"To open fully, the rotary valve {claim}",
        ),
        "figure-4-11": shapes(("tear drop", "house")),
    }


def jet_angles() -> Figure:
    """Figure 3-5: von Mises' angle over the opening, drawn by its parameter."""
    phi = SX.sym("phi")
    numerator, denominator = von_mises(phi, SX(1.0))
    limits = (21.1313, 68.86874)
    angles = np.radians(np.linspace(limits[0], limits[1], 4000))
    ratio = np.asarray(Function("ratio", [phi], [numerator / denominator])(angles)).ravel()
    shown = (ratio >= 0) & (ratio <= 30)
    figure = drawn(
        [("3.6", ratio[shown], np.degrees(angles[shown]))],
        "jet angle φ [deg]",
        "The jet leaves at 66° from ten clearances on, never above 68.9°",
        "opening over clearance x/$δ_r$ [1]",
    )
    axes = figure.axes[0]
    for limit in limits:
        axes.axhline(limit, color="0.6", linewidth=0.8, zorder=0.5)
        axes.annotate(f"{limit:.1f}°", (30, limit), (-4, 2), textcoords="offset points", ha="right")
    axes.set(xlim=(0, 30), ylim=(15, 75))
    return figure


def mission_figure(trot: Mapping[str, Any]) -> Figure:
    """How long the robot trots on its battery, by the kind of its valves."""
    from matplotlib.figure import Figure

    bars = {
        "two-stage: pilots": trot["minutes_two_stage"],
        "rotary, 12.7 µm clearance": trot["rotary"]["minutes"],
        "spool, 2.5 µm clearance": trot["spool"]["minutes"],
        "ideal: no loss, no mass": trot["minutes_ideal"],
    }
    figure = Figure(figsize=(7.2, 3.0), layout="constrained")
    axes: Axes = figure.subplots()
    axes.barh(list(bars), list(bars.values()), color="0.45", height=0.6)
    for place, minutes in enumerate(bars.values()):
        axes.annotate(
            f"{minutes:.1f}", (minutes, place), (3, 0), textcoords="offset points", va="center", fontsize=9
        )
    axes.invert_yaxis()
    axes.set_xlabel("trot at 0.5 m/s on 360 Wh [min]")
    axes.set_title("Leaving the pilots out is what counts, then the clearance", fontsize=10.5, loc="left")
    axes.spines[["top", "right"]].set_visible(False)
    return figure


def testbed_figure(runs: Mapping[str, Solution]) -> Figure:
    """The jets' torque over the position with the three spools of section 4.2."""
    return drawn(
        [
            (f"{name} orifice" if name != "antagonistic" else name, run["z"], run["T_jet"] * 1e3)
            for name, run in runs.items()
        ],
        "jets' torque, against forward motion [mN m]",
        "Testbed, 500 psi: antagonistic ports lower the torque of two orifices, and the flow",
        "position of the spool over the port's width, 0: aligned [1]",
    )


def loop_figure(runs: Mapping[str, Solution]) -> Figure:
    """Figure 4-14: set and actual position over time, with both motors."""
    first = next(iter(runs.values()))
    worst = max(abs(error) for error in settled_errors(runs["brushless"]))
    curves = [(name, run.t * 1e3, np.degrees(run["drive.phi"])) for name, run in runs.items()]
    return drawn(
        [("set", first.t * 1e3, np.degrees(first["drive.wanted"])), *curves],
        "position of the spool [deg]",
        f"A cogging motor rests up to {worst:.1f}° off; one without steps arrives",
        "time [ms]",
    )


def shapes(names: Sequence[Shape]) -> Figure:
    """Figure 4-11: open area of a passage over the opening, both as shares."""
    s = np.linspace(0.0, 1.0, 401)
    curves = [(name, s, share(name, s)) for name in names]
    figure = drawn(
        [*curves, ("linear", s, s)],
        "open area over the full area [1]",
        "The house opens more linearly than the tear drop",
        "relative opening [1]",
    )
    axes = figure.axes[0]
    axes.text(
        0.97,
        0.05,
        "\n".join(f"{name}: off by {deviation(name):.4f} at most" for name in names),
        transform=axes.transAxes,
        ha="right",
    )
    return figure


def share(shape: Shape, s: FloatArray) -> FloatArray:
    """Return the open share of a passage's area where the share ``s`` of its width is open."""
    x = SX.sym("s")
    return np.asarray(Function("A", [x], [open_area(shape, x)])(s)).ravel() / full_area(shape)


def deviation(shape: Shape) -> float:
    """Return the largest deviation [1] of the open share from linear."""
    s = np.linspace(0.0, 1.0, 20001)
    return float(np.abs(share(shape, s) - s).max())


def drawn(curves: Sequence[Curve], ylabel: str, title: str, xlabel: str = OPENING) -> Figure:
    """Return a figure of black lines, told apart by their dashes and named at their side."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.2, 4.4), layout="constrained")
    axes: Axes = figure.subplots()
    for k, (label, x, y) in enumerate(curves):
        axes.plot(x, y, color="black", linestyle=STYLES[k % len(STYLES)], linewidth=1.6, label=label)
    axes.set(xlabel=xlabel, ylabel=ylabel, xlim=(curves[0][1].min(), curves[0][1].max()))
    axes.set_title(title, fontsize=10.5, loc="left")
    axes.grid(color="0.9", linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    if len(curves) > 1:
        axes.legend(frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure
