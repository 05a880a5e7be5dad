"""What `arthur simulate` tells of a run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from arthur_acausal.cli.alike import alike
from arthur_acausal.cli.table import count, duration, number, table
from arthur_acausal.result.display import display_unit, pretty_unit
from arthur_acausal.result.run import plain

if TYPE_CHECKING:
    from arthur_acausal.result.energy import Energy
    from arthur_acausal.result.power import PowerBalance
    from arthur_acausal.result.solution import Solution
    from arthur_acausal.result.verify import Verification

WORST = 3  # equations that a verification shows
FINAL_VALUES = 20  # more would push the rest off the screen; --json has all


def as_object(solution: Solution, extras: Mapping[str, Any]) -> dict[str, Any]:
    """The object that --json prints."""
    run = solution.run
    result = {
        "model": run.model,
        "status": run.status,
        "message": run.message,
        "start_time": run.start_time,
        "stop_time": run.stop_time,
        "end_time": float(solution.t[-1]),
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
    kinds = f"{s['state_events']} state, {s['time_events']} time, {count(s['restarts'], 'restart')}"
    other_s = s["total_s"] - s["initialize_s"] - s["integrate_s"]  # events, output, loading the solver
    times = (
        f"{duration(s['initialize_s'])} initialise, {duration(s['integrate_s'])} integrate, "
        f"{duration(other_s)} other"
    )
    rows = [
        ["unknowns", count(s["unknowns"]), f"{s['linear_solver']} linear solver"],
        ["steps", count(s["steps"]), f"and {count(s['rejected_steps'])} rejected"],
        [
            "residual calls",
            count(s["residual_evaluations"]),
            f"{s['us_per_residual_call']:.3g} µs each, all included",
        ],
        ["Jacobians", count(s["jacobian_evaluations"]), "each factorised once"],
        ["events", count(s["events"]), kinds] if s["events"] else ["events", "0"],
        ["simulation", duration(s["total_s"]), times],
        ["translation", duration(translation_s)],
    ]
    if s["non_finite_residuals"]:
        rows.insert(3, ["not finite", count(s["non_finite_residuals"]), "residual calls: the step was cut"])
    text = "statistics\n" + table(rows, "lrw")
    messages = [["note:", message] for message in s["messages"]]
    return f"{text}\n{table(messages, 'lw')}" if messages else text


def energy(audit: Energy) -> str:
    """The energy audit, each term in J and as a part of the input; losses of an array's members are summed."""
    whole = audit.input_J or 1.0

    def row(name: str, value: float) -> list[str]:
        return [name, f"{value:.3f}", f"{100.0 * value / whole:.2f}"]

    losses = [(name, sum(members)) for name, members in alike(audit.losses_J.items())]
    rows = [
        ["", "J", "%"],
        row("input", audit.input_J),
        row("losses", sum(audit.losses_J.values())),
        *(row(f"  {name}", value) for name, value in sorted(losses, key=lambda item: -abs(item[1]))),
        row("work on the loads", audit.work_J),
        row("stored", audit.stored_J),
    ]
    closure = f"  closure: {audit.closure:.1e} of the input"
    return "energy\n" + table(rows, "lrr") + "\n" + closure


def final_values(solution: Solution) -> str:
    """The states at the end, in the units that people read; those of an array's members as a range."""
    summed = set(audited(solution.run.audit))
    states = [v for v in solution.variables.values() if v.kind == "state" and v.path not in summed]
    groups = alike((variable.path, variable) for variable in states)
    rows = []
    for name, members in groups[:FINAL_VALUES]:
        values = [solution.final(variable.path) for variable in members]
        first = members[0]
        unit = display_unit(first.unit, first.display, max(map(abs, values)))
        ends = [number(unit.from_si(value), 5) for value in (min(values), max(values))]
        text = ends[0] if ends[0] == ends[1] else f"{ends[0]} … {ends[1]}"
        rows.append([name, text, pretty_unit(unit.text), first.description])
    if not rows:
        return ""
    more = sum(len(members) for _, members in groups[FINAL_VALUES:])
    rest = f"\n  and {count(more, 'more state')}; --json lists every variable" if more else ""
    return "states at the end\n" + table(rows, "lrlw") + rest


def verification(found: Verification) -> str:
    """How well the raw equations hold, and which hold worst."""
    rows = [[f"{item.scaled:.1e}", f"at {item.time:.4g} s", item.equation] for item in found.worst[:WORST]]
    title = f"verification: {count(found.equations, 'raw equation')}, residuals relative to their terms"
    return f"{title}\n{table(rows, 'rlw')}"


def balances(solution: Solution) -> dict[str, PowerBalance]:
    """The power balance of each of the model's own parts that has connectors with a power."""
    assert solution.powers is not None
    found = {path: solution.power_balance(path) for path in solution.powers.parts()}
    return {path: balance for path, balance in found.items() if balance.powers}


def powers(solution: Solution) -> str:
    """The energy [J] that enters each part by its connectors, and by all together; those of an array are summed."""
    rows = [["", "J"]]
    found = balances(solution)
    for name, members in alike(found.items()):
        ports: dict[str, float] = {}
        for balance in members:
            for path, amount in balance.energies.items():
                port = path.rpartition(".")[2]
                ports[port] = ports.get(port, 0.0) + amount
        rows.append([name, f"{sum(ports.values()):.3f}"])
        rows += [[f"  {port}", f"{amount:.3f}"] for port, amount in ports.items()]
    together = round(sum(b.energy for b in found.values()), 3) + 0.0  # no minus before a zero
    rows.append(["all together", f"{together:.3f}"])
    return "energy into each part by its connectors\n" + table(rows, "lr")


def audited(terms: Any) -> Iterator[str]:
    """All paths that an energy audit names."""
    if isinstance(terms, Mapping):
        for value in terms.values():
            yield from audited(value)
    else:
        yield from ([terms] if isinstance(terms, str) else terms)
