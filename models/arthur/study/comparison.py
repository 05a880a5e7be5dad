"""The numbers of the study: by scheme and task, differences paired by seed, points of the fronts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from arthur_acausal.models.arthur.study.design import VARIED, Case
from arthur_acausal.models.arthur.study.results import NET, Result
from arthur_acausal.models.arthur.study.schemes import BASELINE, PRESENT, Scheme
from arthur_acausal.models.arthur.study.statistics import Estimate, at_equal, estimate, front, paired, share

COMPARED = ("electrical_W", NET, "relief_W", "undershoot_bar_rms", "undershoot_bar_max", "force_error_rms")
"""Measures whose differences are told."""
FRONTS = ("undershoot_bar_rms", "force_error_rms")
"""What stands against the electrical power in the pictures of the fronts."""
TRIED = VARIED


@dataclass(frozen=True)
class Comparison:
    """All results of a study, and what is computed from them."""

    results: Sequence[Result]

    @cached_property
    def schemes(self) -> list[Scheme]:
        """The schemes that were run."""
        return list(dict.fromkeys(r.scheme for r in self.results))

    @cached_property
    def tasks(self) -> list[str]:
        """The tasks of the main table."""
        return list(dict.fromkeys(r.case.task.name for r in self.results if r.own))

    @cached_property
    def measures(self) -> list[str]:
        """Names of what was measured."""
        return list(dict.fromkeys(name for r in self.results for name in r.values if name != "fell"))

    def main(self, scheme: Scheme | str, task: str = "") -> list[Result]:
        """Return the runs of the main table of a scheme, at a task or at all."""
        name = scheme if isinstance(scheme, str) else scheme.name
        return [r for r in self.results if r.own and r.scheme.name == name and task in ("", r.case.task.name)]

    def mean(self, scheme: Scheme | str, task: str, measure: str) -> Estimate:
        """Return the estimate of a measure; runs that fell or failed have none."""
        return estimate(r[measure] for r in self.main(scheme, task))

    def summary(self) -> dict[str, dict[str, dict[str, Any]]]:
        """Return scheme -> task -> measure -> estimate; ``falls`` is a share of the runs, ``failures`` a number."""
        found: dict[str, dict[str, dict[str, Any]]] = {}
        for scheme in self.schemes:
            for task in self.tasks:
                if runs := self.main(scheme, task):
                    told: dict[str, Any] = {
                        name: self.mean(scheme, task, name).as_data() for name in self.measures
                    }
                    told["falls"] = share([bool(r["fell"]) for r in runs if not r.failed]).as_data()
                    told["failures"] = sum(r.failed for r in runs)
                    found.setdefault(scheme.name, {})[task] = told
        return found

    def differences(self) -> list[dict[str, Any]]:
        """Return each scheme less BASELINE and less PRESENT at each task, paired by seed."""
        rows = []
        for other in (BASELINE, PRESENT):
            for scheme in self.schemes:
                for task in self.tasks:
                    these, those = self.main(scheme, task), self.main(other, task)
                    if scheme.name == other or not these or not those:
                        continue
                    told = {name: paired(these, those, name).as_data() for name in COMPARED}
                    saved = paired(these, those, NET, relative=True).as_data()
                    rows.append(
                        {"scheme": scheme.name, "less": other, "task": task, "relative_W": saved} | told
                    )
        return rows

    def equal(self, measure: str) -> list[dict[str, Any]]:
        """Return what schemes with foresight take more than those without, their set points moved to equal measure."""
        rows = []
        for task in self.moved:
            for scheme in (s for s in self.schemes if s.foresees or s.knows):
                for other in (s for s in self.schemes if not (s.foresees or s.knows)):
                    found = at_equal(self.main(scheme, task), self.at_set_points(other, task), measure)
                    row = {"task": task, "scheme": scheme.name, "than": other.name}
                    rows.append(row | {"relative_W": found.as_data()})
        return rows

    @property
    def moved(self) -> list[str]:
        """The tasks at which set points were varied."""
        changed = (r for r in self.results if r.case.set_point != r.scheme.set_point.values[0])
        return list(dict.fromkeys(r.case.task.name for r in changed))

    def at_set_points(self, scheme: Scheme, task: str) -> list[Result]:
        """Return the runs of a scheme at a task at all its set points, otherwise unchanged."""
        found = (self.changed(scheme, "set_point", value, task) for value in scheme.set_point.values)
        return [r for runs in found for r in runs]

    def changed(self, scheme: Scheme, name: str, value: Any, task: str = TRIED) -> list[Result]:
        """Return the runs at a task where one thing of the cases has a value, all others being the scheme's own."""
        given = {"set_point": scheme.set_point.values[0], name: value}
        runs = (r for r in self.results if r.scheme is scheme and r.case.task.name == task)
        return [r for r in runs if r.case == Case(r.case.task, r.case.seed, **given)]

    def points(self) -> list[dict[str, Any]]:
        """Return the points of the fronts: each scheme at each set point, whether none is better in both."""
        return [row for task in self.moved for row in self._points(task)]

    def _points(self, task: str) -> list[dict[str, Any]]:
        rows: list[dict[str, Any]] = []
        for scheme in self.schemes:
            for value in scheme.set_point.values:
                if at := self.changed(scheme, "set_point", value, task):
                    row: dict[str, Any] = {"task": task, "scheme": scheme.name, "set_point": value}
                    row |= {"unit": scheme.set_point.name, "runs": len(at)}
                    row["falls"] = sum(r["fell"] == 1.0 or r.failed for r in at)
                    for name in ("electrical_W", *FRONTS):
                        told = estimate(r[name] for r in at)
                        row |= {name: told.mean, f"{name}_ci95": told.ci95}
                    rows.append(row)
        for name in FRONTS:
            upright = {
                k: (row["electrical_W"], row[name])
                for k, row in enumerate(rows)
                if row["electrical_W"] is not None and not row["falls"]
            }
            best = front(upright)
            for k, row in enumerate(rows):
                row[f"front_{name}"] = k in best
        return rows

    @property
    def closure(self) -> float:
        """The worst closure of the energy, of all runs."""
        return max((abs(r["closure"]) for r in self.results if "closure" in r.values), default=float("nan"))

    @property
    def failures(self) -> list[dict[str, Any]]:
        """Runs that fell or failed, every one."""
        return [
            {"scheme": r.scheme.name, "case": describe(r.case), "status": "fell" if r["fell"] == 1.0 else r.status}
            | {"error": r.error}
            for r in self.results
            if r.failed or r["fell"] == 1.0
        ]  # fmt: skip


def describe(case: Case) -> Mapping[str, Any]:
    """Return a case in terms of JSON."""
    told = {name: getattr(case, name) for name in ("seed", "set_point", "accumulator", "horizon", "error")}
    return {"task": case.task.name, **told}
