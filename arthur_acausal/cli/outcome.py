"""What `arthur simulate` tells of a run."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from arthur_acausal.cli.table import count, duration, number, table
from arthur_acausal.result.display import display_unit, pretty_unit
from arthur_acausal.result.run import plain

if TYPE_CHECKING:
    from arthur_acausal.result.energy import Energy
    from arthur_acausal.result.solution import Solution

FINAL_VALUES = 12  # more would push the rest off the screen; --json has all


def as_object(solution: Solution, extras: Mapping[str, Any]) -> dict[str, Any]:
    """The object that --json prints."""
    run = solution.run
    result = {
        "model": run.model,
        "status": run.status,
        "message": run.message,
        "start_time": run.start_time,
        "stop_time": float(solution.t[-1]),
        "statistics": run.statistics,
        "events": len(run.events),
        "final": solution.final_values(),
    }
    if run.audit:
        result["energy"] = solution.energy().as_dict()
    return dict(plain(result | dict(extras)))


def as_text(solution: Solution, translation_s: float) -> str:
    """What people read: how the run went, where the energy went, where the model is at the end."""
    run = solution.run
    end = "" if run.status == "finished" else f", {run.status}: {run.message}"
    parts = [
        f"{run.model}: {solution.t[0]:g} to {solution.t[-1]:g} s{end}",
        statistics(solution, translation_s),
    ]
    if run.audit:
        parts.append(energy(solution.energy()))
    parts.append(final_values(solution))
    return "\n\n".join(part for part in parts if part)


def statistics(solution: Solution, translation_s: float) -> str:
    """Counts and times of the run."""
    s: dict[str, Any] = plain(solution.statistics)
    per_call = f"{s['us_per_residual_call']:.3g} µs each, IDA included"
    times = [
        f"{duration(s[f'{phase}_s'])} {name}"
        for phase, name in (
            ("initialize", "initialisation"),
            ("integrate", "integration"),
            ("events", "events"),
            ("output", "output"),
        )
    ]
    rows = [
        ["unknowns", count(s["unknowns"]), f"{s['linear_solver']} linear solver"],
        ["steps", count(s["steps"]), f"and {count(s['rejected_steps'])} rejected"],
        ["residual calls", count(s["residual_evaluations"]), per_call],
        ["Jacobians", count(s["jacobian_evaluations"]), "each factorised once"],
        [
            "events",
            count(s["events"]),
            f"{s['state_events']} state, {s['time_events']} time, {count(s['restarts'], 'restart')}",
        ],
        ["simulation", duration(s["total_s"]), ", ".join(times)],
        ["translation", duration(translation_s)],
    ]
    if s["non_finite_residuals"]:
        rows.insert(3, ["not finite", count(s["non_finite_residuals"]), "residual calls: the step was cut"])
    text = "statistics\n" + table(rows, "lrw")
    messages = [["note:", message] for message in s["messages"]]
    return f"{text}\n{table(messages, 'lw')}" if messages else text


def energy(audit: Energy) -> str:
    """The energy audit, each term in J and as a part of the input."""
    whole = audit.input_J or 1.0

    def row(name: str, value: float) -> list[str]:
        return [name, f"{value:.3f}", f"{100.0 * value / whole:.2f}"]

    losses = sorted(audit.losses_J.items(), key=lambda item: -abs(item[1]))
    rows = [
        ["", "J", "%"],
        row("input", audit.input_J),
        row("losses", sum(audit.losses_J.values())),
        *(row(f"  {name}", value) for name, value in losses),
        row("work on the loads", audit.work_J),
        row("stored", audit.stored_J),
    ]
    closure = f"  closure: {audit.closure:.1e} of the input"
    return "energy\n" + table(rows, "lrr") + "\n" + closure


def final_values(solution: Solution) -> str:
    """The states at the end, in the units that people read."""
    states = [variable for variable in solution.variables.values() if variable.kind == "state"]
    rows = []
    for variable in states[:FINAL_VALUES]:
        value = solution.final(variable.path)
        unit = display_unit(variable.unit, variable.display, abs(value))
        rows.append(
            [variable.path, number(unit.from_si(value), 6), pretty_unit(unit.text), variable.description]
        )
    if not rows:
        return ""
    more = len(states) - len(rows)
    rest = f"\n  and {count(more, 'more state')}; --json lists every variable" if more else ""
    return "states at the end\n" + table(rows, "lrlw") + rest
