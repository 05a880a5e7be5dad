"""The valve study of the ARTHuR report, sections 3 and 4, as tables, figures and findings."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import Solution
from arthur_acausal.components.hydraulic.servo_valves import Shape
from arthur_acausal.models.arthur.valves.actuation import settled_errors
from arthur_acausal.models.arthur.valves.consequences import (
    loop_runs,
    of_the_robot,
    testbed_numbers,
    testbed_runs,
)
from arthur_acausal.models.arthur.valves.design import DESIGNS, design_numbers, printed_again, printed_numbers
from arthur_acausal.models.arthur.valves.findings import findings
from arthur_acausal.models.arthur.valves.pictures import (
    deviation,
    figures,
    loop_figure,
    mission_figure,
    testbed_figure,
)
from arthur_acausal.models.arthur.valves.strokes import GPM
from arthur_acausal.models.arthur.valves.trot import trot_numbers
from arthur_acausal.models.arthur.valves.variants import ROTARY, SPOOL, rotary_numbers, spool_numbers

DEG = math.pi / 180
ROTARY_COLUMNS = {
    "s": ("s", 1.0),
    "Q_A_gpm": ("Q_A", GPM),
    "phi_deg": ("phi_jet_1", DEG),
    "T_friction_mNm": ("T_friction", 1e-3),
    "T_viscous_mNm": ("T_viscous", 1e-3),
    "T_inertia_mNm": ("T_inertia", 1e-3),
    "T_jet_mNm": ("T_jet", 1e-3),
    "W_no_jet_uJ": ("W_no_jet", 1e-6),
    "W_with_jet_uJ": ("W_with_jet", 1e-6),
}
"""Column -> (variable, unit in SI)."""
SPOOL_COLUMNS = {
    "s": ("s", 1.0),
    "Q_S_gpm": ("Q_S", GPM),
    "phi_deg": ("phi_jet", DEG),
    "F_steady_N": ("F_steady", 1.0),
    "F_friction_N": ("F_friction", 1.0),
    "W_uJ": ("W", 1e-6),
}


Table = Mapping[str, Sequence[Any]]
Sweeping = Callable[[str, Mapping[str, Any]], Table]


def write_study(
    folder: Path, sweep: Sweeping | None = None, walks: Mapping[str, Solution] | None = None
) -> str:
    """Write rotary.csv, spool.csv, summary.json, findings.md and the figures; return what was found, in short.

    ``sweep``: carries out a sweep of `RotaryStroke`, given a name and what `arthur_acausal.sweep.sweep` takes, and
    returns its table by columns; without it no designs are tried. ``walks``: what `trots` returns; without it the
    robot's budget is figure 2-2's only.
    """
    folder.mkdir(parents=True, exist_ok=True)
    rotary_runs = {variant.name: variant.run() for variant in ROTARY}
    spool_runs = {variant.name: variant.run() for variant in SPOOL}
    bed, loops = testbed_runs(), loop_runs()
    says = (
        {variant.name: variant.says for variant in ROTARY},
        {variant.name: variant.says for variant in SPOOL},
    )
    rotary: dict[str, Any] = {
        name: {"says": says[0][name], **rotary_numbers(run)} for name, run in rotary_runs.items()
    }
    spool: dict[str, Any] = {
        name: {"says": says[1][name], **spool_numbers(run)} for name, run in spool_runs.items()
    }
    summary: dict[str, Any] = {
        "rotary": rotary,
        "spool": spool,
        "deviation_from_linear": {shape: deviation(shape) for shape in get_args(Shape)},
        "testbed": {name: testbed_numbers(run) for name, run in bed.items()},
        "actuation": {name: settled_errors(run) for name, run in loops.items()},
        "robot": of_the_robot(rotary_runs["default"], spool_runs["default"]),
    }
    if walks is not None:
        summary["trot"] = trot_numbers(walks)
    if sweep is not None:
        summary["designs"] = _designs(sweep, spool["two thirds at the load"]["W_to_0.5_gpm_uJ"] * 1e-6)
    _write_table(folder / "rotary.csv", rotary_runs["default"], ROTARY_COLUMNS)
    _write_table(folder / "spool.csv", spool_runs["default"], SPOOL_COLUMNS)
    (folder / "summary.json").write_text(json.dumps(_finite(summary), indent=2) + "\n", encoding="utf-8")
    (folder / "findings.md").write_text(findings(summary), encoding="utf-8")
    drawn = figures(rotary_runs["default"], spool_runs["default"])
    drawn |= {"testbed": testbed_figure(bed), "figure-4-14": loop_figure(loops)}
    if walks is not None:
        drawn["mission-time"] = mission_figure(summary["trot"])
    for name, figure in drawn.items():
        figure.savefig(folder / f"{name}.png", dpi=150)
    r, s = rotary["default"], spool["default"]
    written = sum(file.is_file() for file in folder.iterdir())
    return (
        f"work to open fully: rotary {r['W_no_jet_uJ']:.0f} uJ without the jets' torque, {r['W_with_jet_uJ']:.0f} uJ "
        f"with it; spool {s['W_uJ']:.0f} uJ\nwrote {written} files to {folder}"
    )


def _designs(sweep: Sweeping, spool: float) -> dict[str, Any]:
    """Return what designs need less work [J] than the spool valve, and how the best one bears the printing."""
    found = design_numbers(sweep("designs", DESIGNS), spool)
    again = sweep("printed", printed_again(found["best"]))
    return found | {"best_printed_again": printed_numbers(again["to_flow.W_with_jet"], spool)}


def table(run: Solution, columns: Mapping[str, tuple[str, float]]) -> dict[str, NDArray[np.float64]]:
    """Return the columns of a run in their units."""
    return {name: run[variable] / unit for name, (variable, unit) in columns.items()}


def _write_table(file: Path, run: Solution, columns: Mapping[str, tuple[str, float]]) -> None:
    values = table(run, columns)
    with file.open("w", newline="", encoding="utf-8") as stream:
        rows = csv.writer(stream)
        rows.writerow(values)
        rows.writerows([f"{x:.9g}" for x in row] for row in zip(*values.values(), strict=True))


def _finite(value: Any) -> Any:
    """Return the same with null for what has no value: JSON has no NaN."""
    if isinstance(value, Mapping):
        return {key: _finite(entry) for key, entry in value.items()}
    return None if isinstance(value, float) and not math.isfinite(value) else value
