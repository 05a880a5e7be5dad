"""The valve study of the ARTHuR report, sections 3 and 4, as tables, figures and findings."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import Solution
from arthur_acausal.components.hydraulic.servo_valves import Shape
from arthur_acausal.models.arthur.valves.findings import findings
from arthur_acausal.models.arthur.valves.pictures import deviation, figures
from arthur_acausal.models.arthur.valves.strokes import GPM
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


def write_study(folder: Path) -> str:
    """Write rotary.csv, spool.csv, summary.json, findings.md and the figures; return what was found, in short."""
    folder.mkdir(parents=True, exist_ok=True)
    rotary_runs = {variant.name: variant.run() for variant in ROTARY}
    spool_runs = {variant.name: variant.run() for variant in SPOOL}
    says = (
        {variant.name: variant.says for variant in ROTARY},
        {variant.name: variant.says for variant in SPOOL},
    )
    rotary = {name: {"says": says[0][name], **rotary_numbers(run)} for name, run in rotary_runs.items()}
    spool = {name: {"says": says[1][name], **spool_numbers(run)} for name, run in spool_runs.items()}
    shapes = {shape: deviation(shape) for shape in get_args(Shape)}
    _write_table(folder / "rotary.csv", rotary_runs["default"], ROTARY_COLUMNS)
    _write_table(folder / "spool.csv", spool_runs["default"], SPOOL_COLUMNS)
    summary = {"rotary": rotary, "spool": spool, "deviation_from_linear": shapes}
    (folder / "summary.json").write_text(json.dumps(_finite(summary), indent=2) + "\n", encoding="utf-8")
    (folder / "findings.md").write_text(findings(rotary, spool, shapes), encoding="utf-8")
    for name, figure in figures(rotary_runs["default"], spool_runs["default"]).items():
        figure.savefig(folder / f"{name}.png", dpi=150)
    r, s = rotary["default"], spool["default"]
    return (
        f"work to open fully: rotary {r['W_no_jet_uJ']:.0f} uJ without the jets' torque, {r['W_with_jet_uJ']:.0f} uJ "
        f"with it; spool {s['W_uJ']:.0f} uJ\nwrote {len(list(folder.iterdir()))} files to {folder}"
    )


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
