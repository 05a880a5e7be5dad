"""The study's tables as files: every run, the fronts' points, the main table in Markdown."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from arthur_acausal.models.arthur.study.comparison import Comparison, describe
from arthur_acausal.models.arthur.study.statistics import Estimate

COLUMNS = {
    "electrical_W": ("battery W", "{:.0f}"),
    "net_W": ("less stored W", "{:.0f}"),
    "relief_W": ("relief W", "{:.0f}"),
    "valves_W": ("throttling W", "{:.0f}"),
    "pump_leakage_W": ("leakage W", "{:.0f}"),
    "copper_W": ("windings W", "{:.0f}"),
    "undershoot_bar_rms": ("sag rms bar", "{:.2f}"),
    "undershoot_bar_max": ("sag max bar", "{:.1f}"),
    "force_error_rms": ("force error N", "{:.1f}"),
    "speed_error": ("speed error", "{:+.1%}"),
    "cost_of_transport": ("cost of transport", "{:.1f}"),
    "mission_h": ("mission h", "{:.2f}"),
}
"""Measure -> heading and format in the main table."""


def write_runs(file: Path, comparison: Comparison) -> None:
    """Write every run, also those that fell or failed."""
    names = ["fell", *comparison.measures]
    rows = [
        {
            "scheme": r.scheme.name,
            **describe(r.case),
            "status": r.status,
            **{n: r.values.get(n, "") for n in names},
        }
        for r in comparison.results
    ]
    write_rows(file, rows)


def write_rows(file: Path, rows: Sequence[Mapping[str, Any]]) -> None:
    """Write rows of the same keys as CSV; None stays empty. Of no rows nothing is written."""
    if not rows:
        return
    with file.open("w", newline="", encoding="utf-8") as stream:
        table = csv.DictWriter(stream, list(rows[0]))
        table.writeheader()
        for row in rows:
            table.writerow({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()})


def write_study_table(file: Path, comparison: Comparison, about: Sequence[str]) -> None:
    """Write the main table as numbers, a row for each scheme, task and measure, below how it was made."""
    rows = [
        {"scheme": scheme, "task": task, "measure": measure, **numbers}
        for scheme, tasks in comparison.summary().items()
        for task, told in tasks.items()
        for measure, numbers in told.items()
        if measure in (*COLUMNS, "falls") and numbers["mean"] is not None
    ]
    write_rows(file, rows)
    head = "".join(f"# {line}\n" for line in about)
    file.write_text(head + file.read_text(encoding="utf-8"), encoding="utf-8")


def overview(comparison: Comparison, measures: Sequence[str]) -> str:
    """Return a table of means for each measure as Markdown: a line a scheme, a column a task."""
    parts = []
    for name in measures:
        title, form = COLUMNS[name]
        lines = [
            f"| {title} | " + " | ".join(comparison.tasks) + " |",
            "|" + "---|" * (len(comparison.tasks) + 1),
        ]
        for scheme in comparison.schemes:
            means = [comparison.mean(scheme, task, name).mean for task in comparison.tasks]
            fell = [sum(r["fell"] == 1.0 for r in comparison.main(scheme, task)) for task in comparison.tasks]
            cells = [
                ("" if mean is None else form.format(mean)) + (f" ({n} fell)" if n else "")
                for mean, n in zip(means, fell, strict=True)
            ]
            lines.append(f"| {scheme.name} | " + " | ".join(cells) + " |")
        parts.append("\n".join(lines))
    return "\n\n".join(parts)


def main_table(comparison: Comparison) -> str:
    """Return the main table as Markdown: a section a task, a line a scheme."""
    head = "| scheme | runs | falls | " + " | ".join(title for title, _ in COLUMNS.values()) + " |"
    parts = []
    for task in comparison.tasks:
        lines = [f"### {task}", "", head, "|" + "---|" * (len(COLUMNS) + 3)]
        for scheme in comparison.schemes:
            runs = comparison.main(scheme, task)
            if not runs:
                continue
            cells = [text(comparison.mean(scheme, task, name), form) for name, (_, form) in COLUMNS.items()]
            fell, failed = sum(r["fell"] == 1.0 for r in runs), sum(r.failed for r in runs)
            falls = f"{fell}" + (f", {failed} failed" if failed else "")
            lines.append(f"| {scheme.name} | {len(runs)} | {falls} | " + " | ".join(cells) + " |")
        parts.append("\n".join(lines))
    return "\n\n".join(parts)


def text(estimate: Estimate, form: str) -> str:
    """Return mean and half width of the interval; nothing where there is no mean."""
    if estimate.mean is None:
        return ""
    half = "" if estimate.ci95 is None else f" ± {form.replace('+', '').format(estimate.ci95)}"
    return form.format(estimate.mean) + half
