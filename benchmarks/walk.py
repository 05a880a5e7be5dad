"""The whole robot walks: the scenarios of the locomotion stack in the coupled model, battery to ground.

Each runs through hydraulics, rigid bodies and controller in one system of equations. A seed gives the sensors' noise
and displaces the joints at the start by up to 0.02 rad. What is required is that of `benchmarks.locomotion`, and that
the forces follow their demand, as the actuators receive it, within 10 % rms in an undisturbed trot.

The first seed goes through all scenarios, then the second. With ``--log`` each run is kept as it ends, and a run that
is kept, by another call before, is not done again: the list may be cut off and gone on with.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import asdict, fields, replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from benchmarks.coupled import Walked, run
from benchmarks.locomotion import CALM, SCENARIOS, Scenario
from benchmarks.measure import parser, show

QUICK, QUICK_PUSH = 3.0, 1.2
"""With --quick: duration, and beginning of a push [s]."""

Job = tuple[Scenario, int, float]
"""A scenario, a seed, rtol."""


def shortened(scenario: Scenario, seconds: float | None, quick: bool) -> Scenario:
    """Return a scenario that lasts no longer than asked; a push then comes early, with the time that it needs."""
    if quick:
        seconds = QUICK
    if seconds is None:
        return scenario
    if scenario.push is None:
        return replace(scenario, duration=min(seconds, scenario.duration))
    push = replace(scenario.push, start=QUICK_PUSH)
    return replace(scenario, push=push, duration=max(seconds, push.start + push.duration + CALM + 0.3))


def key(job: Job) -> list[Any]:
    """Return by what a kept run is known."""
    scenario, seed, rtol = job
    return [scenario.name, scenario.duration, seed, rtol]


def kept(log: Path | None) -> list[tuple[list[Any], Walked]]:
    """Return the runs of a log, with their keys; a line that was cut off is left out."""
    if log is None or not log.exists():
        return []
    names = {field.name for field in fields(Walked)}
    found = []
    for line in log.read_text().splitlines():
        try:
            row = json.loads(line)
        except ValueError:
            continue
        found.append((row["key"], Walked(**{name: row[name] for name in names})))
    return found


def ended(jobs: Sequence[Job], workers: int) -> Iterator[tuple[Job, Walked]]:
    """Yield the runs as they end."""
    if workers == 1:
        yield from ((job, run(*job)) for job in jobs)
        return
    with ProcessPoolExecutor(workers, get_context("spawn")) as pool:
        waiting = {pool.submit(run, *job): job for job in jobs}
        for done in as_completed(waiting):
            yield waiting[done], done.result()


def measure(jobs: Sequence[Job], workers: int, log: Path | None) -> list[Walked]:
    """Return all runs in the order of the jobs; each is told, and kept, as it ends."""
    found = {json.dumps(k): row for k, row in kept(log)}
    for job, row in ended([job for job in jobs if json.dumps(key(job)) not in found], workers):
        found[json.dumps(key(job))] = row
        print(row, file=sys.stderr, flush=True)
        if log is not None:
            with log.open("a") as file:  # the line before may have been cut off
                file.write("\n" + json.dumps({"key": key(job)} | asdict(row)))
    return [found[json.dumps(key(job))] for job in jobs]


def worst(runs: Sequence[Walked]) -> dict[str, Any]:
    """Return the worst figures of a scenario's runs, and how many of them met what is required."""
    rows = [asdict(row) for row in runs]
    found: dict[str, Any] = {"runs": len(runs), "met": sum(row.met for row in runs)}
    found["falls"] = sum(row.fell for row in runs)
    found["seconds"] = min(row.seconds for row in runs)
    for name in ("speed_error", "max_roll_deg", "max_pitch_deg", "slip_share", "v_y", "force_tracking_rms"):
        values = [row[name] for row in rows if row[name] is not None]
        found[name] = max(values) if values else None
    found["closure"] = max(abs(row.closure) for row in runs)
    found["cost_of_transport"] = max((r.cost_of_transport for r in runs if r.cost_of_transport), default=None)
    found["trouble"] = {name: max(row.trouble.get(name, 0) for row in runs) for name in runs[0].trouble}
    found["cpu_s_per_s"] = max(row.cpu_s_per_s for row in runs)
    return found


def main() -> None:
    """Measure and print."""
    command_line = parser("The whole robot, battery to ground: gaits and disturbances in the coupled model.")
    command_line.add_argument("--quick", action="store_true", help=f"{QUICK:g} s each")
    command_line.add_argument("--seconds", type=float, help="longest duration of each scenario")
    command_line.add_argument("--seeds", type=int, default=1, help="of noise and start, 1 by default")
    command_line.add_argument("--first-seed", type=int, default=0, metavar="N")
    command_line.add_argument("--rtol", type=float, default=1e-4)
    command_line.add_argument("--workers", type=int, default=1, help="processes")
    command_line.add_argument("--log", type=Path, metavar="FILE", help="keep runs in it, do none again")
    command_line.add_argument(
        "--only", nargs="+", default=[""], metavar="TEXT", help="scenarios whose name contains one of these"
    )
    arguments = command_line.parse_args()
    chosen = [s for s in SCENARIOS if not s.lag and any(text in s.name for text in arguments.only)]
    chosen = [shortened(scenario, arguments.seconds, arguments.quick) for scenario in chosen]
    seeds = range(arguments.first_seed, arguments.first_seed + arguments.seeds)
    jobs = [(scenario, seed, arguments.rtol) for seed in seeds for scenario in chosen]
    rows = measure(jobs, arguments.workers, arguments.log)
    if arguments.json:
        found = [asdict(row) | {"met": row.met} for row in rows]
        print(json.dumps({"rtol": arguments.rtol, "seeds": list(seeds), "runs": found}))
    else:
        show_all([[row for row in rows if row.scenario == s.name] for s in chosen], arguments.rtol)


def show_all(groups: Sequence[Sequence[Walked]], rtol: float) -> None:
    """Print the worst figures of each scenario as a table."""

    def text(form: str, value: float | None, scale: float = 1.0) -> str:
        return "" if value is None else form.format(scale * value)

    table = []
    for group in groups:
        row = worst(group)
        table.append(
            [
                group[0].scenario,
                f"{row['seconds']:.1f}",
                str(row["falls"]),
                text("{:.1f}", row["speed_error"], 100.0),
                f"{row['max_roll_deg']:.1f} / {row['max_pitch_deg']:.1f}",
                f"{100.0 * row['slip_share']:.1f}",
                text("{:.3f}", row["v_y"]),
                f"{100.0 * row['force_tracking_rms']:.1f}",
                f"{row['closure']:.0e}",
                text("{:.1f}", row["cost_of_transport"]),
                " ".join(str(n) for n in row["trouble"].values()),
                f"{row['cpu_s_per_s']:.1f}",
                f"{row['met']} of {row['runs']}" + ("" if group[0].required else " (told)"),
            ]
        )
    heads = ["s", "fell", "speed %", "roll/pitch", "slip %", "v_y", "force %", "closure", "CoT", "trouble"]
    show(
        f"The worst of the seeds, rtol {rtol:g}; trouble: stops, cavitation, valves, bus voltage, motor current",
        ["", *heads, "CPU", "met"],
        table,
    )


if __name__ == "__main__":
    main()
