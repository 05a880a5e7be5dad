"""What the runs gave: carried out by sweeps that can be resumed, and brought together."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import nan
from pathlib import Path
from typing import Any

from arthur_acausal import Solution, SolverOptions, translate
from arthur_acausal.models.arthur.demand import Demand
from arthur_acausal.models.arthur.displaced import start_of
from arthur_acausal.models.arthur.study.design import (
    PARTS,
    TOLERANCE,
    Case,
    Size,
    specification,
)
from arthur_acausal.models.arthur.study.schemes import PRESENT, Scheme, scheme_named
from arthur_acausal.models.arthur.study.tasks import TASKS
from arthur_acausal.models.arthur.study.trial import Trial

Sweeping = Callable[[str, Mapping[str, Any]], Mapping[str, Sequence[Any]]]
"""Carries out a sweep of `Trial`, given a name and what `arthur_acausal.sweep.sweep` takes; returns its table."""
PREFIX = "measures."
NET = "net_W"
"""Power less what is stored meanwhile in rotor, accumulator and chambers: that differs with where a stride is cut."""


@dataclass(frozen=True, slots=True)
class Result:
    """What came of a case: ``status`` and ``error`` of the sweep's row, ``values`` of `measures`."""

    scheme: Scheme
    case: Case
    status: str
    error: str
    values: Mapping[str, float]

    @property
    def failed(self) -> bool:
        """Whether the run did not get to its end, nor to a fall."""
        return self.status not in ("ok", "terminated")

    @property
    def own(self) -> bool:
        """Whether it is of the main table: nothing about the scheme was changed."""
        return self.case == Case(self.case.task, self.case.seed, self.scheme.set_point.values[0])

    def __getitem__(self, name: str) -> float:
        """Return a measure; NaN where it has none."""
        return self.values.get(name, nan)


def results(schemes: Sequence[Scheme], size: Size, sweep: Sweeping, folder: Path) -> list[Result]:
    """Carry out all runs of the schemes; what ``folder`` holds of an earlier call is not run again."""
    found: list[Result] = []
    for scheme in schemes:
        for part, cases_of in PARTS.items():
            if cases := cases_of(scheme, size):
                demands = [str(recorded(case, folder / "demand")) for case in cases] if scheme.knows else []
                table = sweep(
                    f"{scheme.name.replace(' ', '-')}-{part}", specification(scheme, cases, demands)
                )
                found += _rows(scheme, cases, table)
    return found


def _rows(scheme: Scheme, cases: Sequence[Case], table: Mapping[str, Sequence[Any]]) -> Iterator[Result]:
    names = [name for name in table if name.startswith(PREFIX)]
    for k, number in enumerate(table["run"]):
        values = {name.removeprefix(PREFIX): float(table[name][k]) for name in names}
        kept = {name: value for name, value in values.items() if value == value}
        if "stored_W" in kept:
            kept[NET] = kept["electrical_W"] - kept["stored_W"]
        yield Result(scheme, cases[int(number)], str(table["status"][k]), str(table["error"][k]), kept)


def recorded(case: Case, folder: Path) -> Path:
    """Return the file with the demand of a case by the scheme PRESENT, made where it is not there yet."""
    file = folder / f"{case.task.name.replace(' ', '-')}-{case.seed}.npz"
    if not file.exists():
        folder.mkdir(parents=True, exist_ok=True)
        part = file.with_suffix(".part.npz")
        Demand.of(run(case)).save(part)
        part.replace(file)
    return file


def run(case: Case) -> Solution:
    """Return the run of a case by the scheme PRESENT."""
    task = case.task
    model = translate(Trial(scheme=PRESENT, terrain="slope" if task.slope else "flat"))
    chosen = {"task": TASKS.index(task), "noise": case.seed, "duration": task.end, "shove.F": task.push}
    chosen |= scheme_named(PRESENT).tuning(accumulator=True)
    options = SolverOptions(rtol=TOLERANCE, output_interval=0.001)
    return model.simulate(task.end + 0.1, parameters=chosen, start=start_of(case.seed), options=options)
