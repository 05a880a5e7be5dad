"""What the numbers of the valve study say, in words; every figure in the text is computed."""

from __future__ import annotations

from collections.abc import Mapping
from math import isnan
from typing import Any

from arthur_acausal.models.arthur.valves.further_findings import (
    actuation_text,
    designs_text,
    robot_text,
    testbed_text,
    trot_text,
)

Numbers = Mapping[str, Mapping[str, Any]]


def findings(summary: Mapping[str, Any]) -> str:
    """Return the findings as Markdown, from what summary.json holds."""
    rotary, spool = summary["rotary"], summary["spool"]
    r, s = rotary["default"], spool["default"]
    parts = [
        "# Rotary against spool: what the numbers say",
        _claim(r, s),
        _fair(r, s, spool["two thirds at the load"]),
        _pressure(rotary, s),
        designs_text(summary.get("designs")),
        _open_points(rotary, spool),
        testbed_text(summary["testbed"]),
        actuation_text(summary["actuation"]),
        robot_text(summary["robot"]),
        trot_text(summary.get("trot")),
        _shapes(summary["deviation_from_linear"]),
        _table("Rotary valve", rotary),
        _table("Spool valve", spool),
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def _claim(r: Mapping[str, float], s: Mapping[str, float]) -> str:
    without, with_jet, spool = r["W_no_jet_uJ"], r["W_with_jet_uJ"], s["W_uJ"]
    holds = "holds" if without < spool else "does not hold"
    mended = "less" if with_jet < spool else "more"
    return (
        "## The claim\n\n"
        f"Figure 3-15's claim, that the rotary valve needs less work, {holds} without the jets' torque: "
        f"{without:.0f} uJ to open it fully, against {spool:.0f} uJ for the spool. But 3.31 itself calls that torque "
        "cumulative: both jets of both passages close the valve. With it the rotary valve needs "
        f"{with_jet:.0f} uJ, {abs(with_jet / spool - 1):.0%} {mended} than the spool valve."
    )


def _fair(r: Mapping[str, float], s: Mapping[str, float], loaded: Mapping[str, float]) -> str:
    no_inertia = r["W_with_jet_no_inertia_uJ"], s["W_no_inertia_uJ"]
    text = (
        "## Is the comparison fair?\n\n"
        "Both sides count inertia here; 3.61 leaves the spool's out. Without any inertia the works are "
        f"{no_inertia[0]:.0f} uJ with jets and {r['W_no_jet_no_inertia_uJ']:.0f} uJ without, against "
        f"{no_inertia[1]:.0f} uJ.\n\nThe valves do not pass the same flow: fully open the rotary valve passes "
        f"{r['Q_A_full_gpm']:.2f} gpm, the spool valve is given {s['Q_S_full_gpm']:.2f} gpm."
    )
    if isnan(r["s_at_0.5_gpm"]):
        return text + " The rotary valve never reaches 0.5 gpm."
    return text + (
        f" To 0.5 gpm the rotary valve opens by {r['s_at_0.5_gpm']:.0%} and needs "
        f"{r['W_with_jet_to_0.5_gpm_uJ']:.0f} uJ with jets, {r['W_no_jet_to_0.5_gpm_uJ']:.0f} uJ without; the spool "
        f"valve opens by {s['s_at_0.5_gpm']:.0%} and needs {s['W_to_0.5_gpm_uJ']:.0f} uJ, or, where its load takes two "
        f"thirds of the pressure as the rotary valve's does, by {loaded['s_at_0.5_gpm']:.0%} and "
        f"{loaded['W_to_0.5_gpm_uJ']:.0f} uJ. " + _equal_flow(r, loaded)
    )


def _equal_flow(r: Mapping[str, float], loaded: Mapping[str, float]) -> str:
    if r["W_no_jet_to_0.5_gpm_uJ"] < loaded["W_to_0.5_gpm_uJ"]:
        return "So at equal flow, too, the rotary valve needs less as long as its jets are left out."
    return "So at equal flow the rotary valve needs more work even without its jets."


def _pressure(rotary: Numbers, s: Mapping[str, float]) -> str:
    rows = [
        f"- {name}: {rotary[name]['W_with_jet_uJ']:.0f} uJ with jets, {rotary[name]['W_no_jet_uJ']:.0f} without"
        for name in ("3.25 as printed", "active ports only", "balanced passages", "offset 0.5", "without C_c")
    ]
    winners = [name for name, numbers in rotary.items() if numbers["W_with_jet_uJ"] < s["W_uJ"]]
    verdict = (
        f"With its jets counted the rotary valve wins, to full opening, in these variants: {', '.join(winners)}. "
        "Full opening is not the same flow: see the table."
        if winners
        else "In none of these variants does the rotary valve win with its jets counted."
    )
    return "## What one change does\n\n" + "\n".join(rows) + f"\n\n{verdict}"


def _open_points(rotary: Numbers, spool: Numbers) -> str:
    r = rotary["default"]
    turbulent, laminar = rotary["turbulent lines"]["Q_A_full_gpm"], r["Q_A_full_gpm"]
    return (
        "## What the case studies hide\n\n"
        f"- The rotary valve's flow fully open, {laminar:.2f} gpm, is that of laminar lines at a Reynolds number near "
        f"1e4. With turbulent ones it is {turbulent:.2f} gpm.\n"
        "- The spool's 0.5 gpm at every opening (3.6.3) needs up to "
        f"{spool['constant flow']['p_needed_max_bar']:.3g} bar at s = 0.01, where the supply has 199: the printed work "
        f"is {spool['constant flow']['W_uJ']:.0f} uJ from there on, and grows without bound towards s = 0.\n"
        "- 3.59's second term, mended, is as large on one land as the first; but the leakages on the two closed lands "
        f"pull opposite ways, and the rest is {spool['default']['F_shear_least_N']:.3f} N. It is not in the "
        "work.\n"
        f"- The cylinder is pressed aside by at least {r['F_radial_least_N']:.0f} N of pressure; the flow's start "
        f"(3.12) adds up to {r['F_transient_max_N']:.2f} N, the passages' walls {r['F_shear_max_N']:.2f} N: both left "
        f"out of the friction. Static friction may hold the closed valve with {r['T_breakaway_mNm']:.1f} mN m (3.5, "
        "coefficient 0.2).\n"
        "- The spool's geometry is a proxy: the report withholds the maker's. C_d, C_v, the area ratio and the lines' "
        "lengths are assumed.\n"
        f"- With the contraction in 3.48, as in 3.8, the spool needs {spool['with C_c']['W_uJ']:.0f} uJ."
    )


def _shapes(shapes: Mapping[str, float]) -> str:
    rows = "\n".join(f"| {name} | {value:.4f} |" for name, value in shapes.items())
    return (
        "## Shapes of the passages\n\nLargest deviation of the open area from linear, of the full area:\n\n"
        f"| shape | deviation |\n|---|---|\n{rows}"
    )


def _table(title: str, variants: Numbers) -> str:
    columns = [key for key in next(iter(variants.values())) if key != "says"]
    head = "| variant | " + " | ".join(columns) + " |\n|" + "---|" * (len(columns) + 1)
    rows = "\n".join(
        f"| {name} | " + " | ".join(f"{numbers[key]:.4g}" for key in columns) + " |"
        for name, numbers in variants.items()
    )
    return f"## {title}: variants\n\n{head}\n{rows}"
