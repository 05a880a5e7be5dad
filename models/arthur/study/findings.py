"""What the numbers of the study say, in words; every figure and every verdict in the text is computed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from arthur_acausal.models.arthur.study.comparison import TRIED, Comparison
from arthur_acausal.models.arthur.study.design import ERRORS, HORIZONS
from arthur_acausal.models.arthur.study.measures import WANTED
from arthur_acausal.models.arthur.study.results import NET, Result
from arthur_acausal.models.arthur.study.schemes import BASELINE, PRESENT, Scheme
from arthur_acausal.models.arthur.study.statistics import Estimate, paired
from arthur_acausal.models.arthur.study.tables import main_table, text

EXPECTED = {
    "relief, moving": (0.55, 0.95),
    "relief, standing": (0.95, 1.0),
    "electrical": (0.20, 0.50),
    "accumulator": (1 / 3, 1 / 2),
}
"""Savings that a reduced-order study had led to expect, as shares: to be confirmed or refuted."""


def findings(comparison: Comparison) -> str:
    """Return the findings as Markdown."""
    foreseeing = [s for s in comparison.schemes if s.foresees or s.knows]
    parts = [
        "# Does foresight pay? What the numbers say",
        _sound(comparison),
        "## Against constant speed\n\n" + _against_baseline(comparison),
        "## Against control by what is measured now\n\n" + _against_present(comparison, foreseeing),
        "## At equal sag\n\n" + _equal(comparison),
        "## Lower pressure without foresight\n\n" + _set_points(comparison),
        _accumulator(comparison),
        _varied(comparison, "horizon", HORIZONS, "Horizon", "{:.0f} ms", 1e3),
        _varied(comparison, "error", ERRORS, "Error of the model", "{:+.0f} %", 100.0),
        "## Main table\n\n± is half of the 95 % interval over the seeds.\n\n" + main_table(comparison),
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def _sound(comparison: Comparison) -> str:
    fell = sum(r["fell"] == 1.0 for r in comparison.results)
    failed = sum(r.failed for r in comparison.results)
    return (
        f"{len(comparison.results)} runs; {fell} fell, {failed} failed. In the worst run the energy's balance leaves "
        f"{comparison.closure:.1e} of the input. Sag is the depth of the supply pressure below {WANTED:g} bar, for all "
        "schemes alike. Differences of power are of what is taken less what is stored meanwhile."
    )


def _against_baseline(comparison: Comparison) -> str:
    """Compare savings with what was expected, for each scheme and task."""
    lines = [
        f"| scheme | task | relief loss less {BASELINE} | expected | | electrical | expected | |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for scheme in comparison.schemes:
        for task in comparison.tasks:
            these, those = comparison.main(scheme, task), comparison.main(BASELINE, task)
            if scheme.name == BASELINE or not these or not those:
                continue
            kind = "relief, standing" if task == "stand" else "relief, moving"
            relief, power = (paired(these, those, name, relative=True) for name in ("relief_W", NET))
            cells = [*_judged(relief, EXPECTED[kind]), *_judged(power, EXPECTED["electrical"])]
            lines.append(f"| {scheme.name} | {task} | " + " | ".join(cells) + " |")
    if len(lines) == 2:
        return "Not run."
    return "\n".join(lines) + (
        "\n\nThe expectations are those of foresight; the other schemes stand beside it because they save, too."
    )


def _judged(saving: Estimate, expected: tuple[float, float]) -> list[str]:
    """Return the saving, what was expected, and whether it was right."""
    low, high = expected
    if saving.mean is None:
        return ["", f"{low:.0%} to {high:.0%}", "open"]
    saved, half = -saving.mean, saving.ci95 or 0.0
    within = low <= saved + half and saved - half <= high
    verdict = "confirmed" if within else "less" if saved < low else "more"
    return [text(Estimate(saved, saving.ci95, saving.n), "{:.1%}"), f"{low:.0%} to {high:.0%}", verdict]


def _against_present(comparison: Comparison, foreseeing: Sequence[Scheme]) -> str:
    """Say for each scheme with foresight and each task whether it takes less power, and sags less."""
    lines = []
    for scheme in foreseeing:
        for task in comparison.tasks:
            these, those = comparison.main(scheme, task), comparison.main(PRESENT, task)
            if not these or not those:
                continue
            power = paired(these, those, NET, relative=True)
            sag, force = (paired(these, those, name) for name in ("undershoot_bar_rms", "force_error_rms"))
            lines.append(
                f"- {scheme.name}, {task}: {_verdict(power, sag)}. Power {text(power, '{:+.2%}')}, sag "
                f"{text(sag, '{:+.2f}')} bar, force error {text(force, '{:+.2f}')} N, of {power.n} seeds."
            )
    if not lines:
        return "Not run."
    return f"Differences to {PRESENT}, paired by seed:\n\n" + "\n".join(lines)


def _verdict(power: Estimate, sag: Estimate) -> str:
    """Return what two differences mean."""
    less, more = (
        (e.certain and (e.mean or 0.0) < 0.0 for e in (power, sag)),
        (e.certain and (e.mean or 0.0) > 0.0 for e in (power, sag)),
    )
    (power_less, sag_less), (power_more, sag_more) = tuple(less), tuple(more)
    if power_less and not sag_more:
        return "it pays"
    if sag_less and not power_more:
        return "it pays by less sag"
    if power_less or sag_less:
        return (
            "it takes more power for less sag" if sag_less else "it saves power by letting the pressure sag"
        )
    if power_more or sag_more:
        return "it does not pay"
    return "no difference is certain"


def _equal(comparison: Comparison) -> str:
    """Say what foresight takes where the sag is that of a scheme without it, whose set point is moved to that."""
    lines = []
    for row in comparison.equal("undershoot_bar_rms"):
        found = Estimate(**row["relative_W"])
        told = f"{text(found, '{:+.2%}')} power, of {found.n} seeds" + (
            "" if found.certain else ": not certain"
        )
        if found.mean is None:
            told = "its set points do not reach that sag"
        lines.append(f"- {row['task']}, {row['scheme']} against {row['than']}: {told}.")
    return "The other's set point moved to the same rms sag, linear in between:\n\n" + "\n".join(lines)


def _set_points(comparison: Comparison) -> str:
    """Tell of each scheme at each set point: it may be the pressure that saves, not the foresight."""
    lines = [
        "| task | scheme | set point | falls | battery W | sag rms bar | force error N |",
        "|---|---|---|---|---|---|---|",
    ]
    for p in comparison.points():
        power, sag, force = (
            text(Estimate(p[name], p[f"{name}_ci95"], p["runs"]), form)
            for name, form in (
                ("electrical_W", "{:.0f}"),
                ("undershoot_bar_rms", "{:.2f}"),
                ("force_error_rms", "{:.2f}"),
            )
        )
        lines.append(
            f"| {p['task']} | {p['scheme']} | {p['set_point']:g} {p['unit']} | {p['falls']} of {p['runs']} "
            f"| {power} | {sag} | {force} |"
        )
    return "\n".join(lines)


def _accumulator(comparison: Comparison) -> str:
    lines = []
    for scheme in comparison.schemes:
        for task in comparison.tasks:
            bare = comparison.changed(scheme, "accumulator", False, task)
            if not bare:
                continue
            those = comparison.main(scheme, task)
            relief, power, sag = (
                paired(those, bare, name, relative=name != "undershoot_bar_rms")
                for name in ("relief_W", NET, "undershoot_bar_rms")
            )
            judged = ""
            if scheme.name == "pressure" and task != "stand" and relief.mean is not None:
                _, expected, verdict = _judged(relief, EXPECTED["accumulator"])
                judged = f" (expected {expected} less: {verdict})"
            lines.append(
                f"- {scheme.name}, {task}: relief loss {text(relief, '{:+.1%}') or 'none without it either'}{judged}, "
                f"power {text(power, '{:+.1%}')}, sag {text(sag, '{:+.2f}')} bar; {_fallen(bare)}."
            )
    return "## What the accumulator of 10 cc does\n\n" + "\n".join(lines) if lines else ""


def _fallen(runs: Sequence[Result]) -> str:
    fell = sum(r["fell"] == 1.0 for r in runs)
    return f"without it {fell} of {len(runs)} fell"


def _varied(
    comparison: Comparison, name: str, values: Sequence[float], title: str, form: str, unit: float
) -> str:
    """Tell what a change of horizon or model does, against the scheme's own value."""
    own, *others = values
    lines = []
    for scheme in comparison.schemes:
        base = comparison.changed(scheme, name, own)
        cells: list[Any] = []
        for value in sorted(others):
            if runs := comparison.changed(scheme, name, value):
                power = paired(runs, base, NET, relative=True)
                sag = paired(runs, base, "undershoot_bar_rms")
                cells.append(
                    f"{form.format(value * unit)}: {text(power, '{:+.2%}')} power, {text(sag, '{:+.2f}')} bar sag"
                )
        if cells:
            lines.append(f"- {scheme.name}: " + "; ".join(cells) + ".")
    if not lines:
        return ""
    return f"## {title}\n\nAt {TRIED} m/s, against {form.format(own * unit)}:\n\n" + "\n".join(lines)
