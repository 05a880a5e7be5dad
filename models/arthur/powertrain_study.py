"""The study of the pump's control: how much foresight saves, as tables, figures and findings."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from arthur_acausal.models.arthur.study.comparison import Comparison
from arthur_acausal.models.arthur.study.design import TOLERANCE, Size
from arthur_acausal.models.arthur.study.findings import findings
from arthur_acausal.models.arthur.study.pictures import figures
from arthur_acausal.models.arthur.study.results import Sweeping, results
from arthur_acausal.models.arthur.study.schemes import SCHEMES, Scheme
from arthur_acausal.models.arthur.study.tables import (
    main_table,
    overview,
    write_rows,
    write_runs,
    write_study_table,
)

SHOWN = ("electrical_W", "undershoot_bar_rms", "force_error_rms")
"""Measures of the overview."""


def write_study(folder: Path, sweep: Sweeping, size: Size, schemes: Sequence[Scheme] = SCHEMES) -> str:
    """Carry out the study, write its files into ``folder``, and return what was found, in short.

    summary.json: scheme -> task -> measure -> mean, ci95, n; study.csv the same. comparisons.json: differences paired
    by seed, what foresight takes at equal sag, runs that fell or failed, the design. runs.csv: every run. pareto.csv
    and the figures; table.md; findings.md.
    """
    folder.mkdir(parents=True, exist_ok=True)
    comparison = Comparison(results(schemes, size, sweep, folder))
    _write_json(folder / "summary.json", comparison.summary())
    told = {
        "design": asdict(size),
        "tuning": {scheme.name: scheme.tuning(accumulator=True) for scheme in schemes},
        "runs": len(comparison.results),
        "worst_closure": comparison.closure,
        "differences": comparison.differences(),
        "at_equal_sag": comparison.equal("undershoot_bar_rms"),
        "at_equal_force_error": comparison.equal("force_error_rms"),
        "fell_or_failed": comparison.failures,
    }
    _write_json(folder / "comparisons.json", told)
    write_runs(folder / "runs.csv", comparison)
    write_rows(folder / "pareto.csv", comparison.points())
    write_study_table(folder / "study.csv", comparison, _about(size, schemes))
    tables = f"{overview(comparison, SHOWN)}\n\n{main_table(comparison)}\n"
    (folder / "table.md").write_text(tables, encoding="utf-8")
    (folder / "findings.md").write_text(findings(comparison), encoding="utf-8")
    for name, figure in figures(comparison).items():
        figure.savefig(folder / f"{name}.png", dpi=110)
    bad = len(comparison.failures)
    return (
        f"{len(comparison.results)} runs, {bad} of them fell or failed; energy closes within {comparison.closure:.1e}\n"
        f"{overview(comparison, SHOWN)}\nwrote {folder}"
    )


def _about(size: Size, schemes: Sequence[Scheme]) -> list[str]:
    """Return how the numbers were made: seeds, schemes, tolerance, versions."""
    packages = ("arthur-acausal", "casadi", "mujoco", "numpy", "scikit-sundae")
    return [
        f"arthur study powertrain --seeds {size.seeds} --few {size.few}; seeds from 0; rtol {TOLERANCE:g}",
        f"schemes: {', '.join(scheme.name for scheme in schemes)}",
        ", ".join(f"{name} {_version(name)}" for name in packages),
    ]


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:  # a source tree that is not installed
        return "not installed"


def _write_json(file: Path, value: object) -> None:
    file.write_text(json.dumps(value, indent=1) + "\n", encoding="utf-8")
