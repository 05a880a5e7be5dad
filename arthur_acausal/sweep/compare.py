"""Two sweeps of the same runs side by side: what differs, and by how much."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from arthur_acausal.errors import UsageError
from arthur_acausal.sweep.opened import Sweep
from arthur_acausal.sweep.specification import differences


@dataclass(frozen=True, slots=True)
class Difference:
    """How a reduction differs over the runs that both sweeps have.

    ``largest`` and ``rms`` of b - a; ``range``: of a's values; ``run``: where it is largest.
    """

    name: str
    largest: float
    rms: float
    range: float
    run: int


@dataclass(frozen=True, slots=True)
class Comparison:
    """``specification``: keys that differ; ``only_a``, ``only_b``: runs that one has; ``status``: runs whose status
    differs; ``reductions``: of the runs that are good in both."""

    specification: list[str]
    common: int
    only_a: int
    only_b: int
    status: list[int]
    reductions: list[Difference]


def compare(a: Sweep, b: Sweep) -> Comparison:
    """Compare two sweeps run by run, which are paired by their factors' values where both have the same factors,
    else by number. Raises UsageError where they have no run in common.
    """
    factors = [name for name in a.factors if name in b.factors]
    key = factors if factors and a.factors == b.factors else ["run"]
    both: Any = a.table.merge(b.table, on=key, how="outer", suffixes=("_a", "_b"), indicator=True)
    found = both[both["_merge"] == "both"]
    if not len(found):
        raise UsageError(f"{a.folder} and {b.folder} have no run in common")
    number = "run" if key == ["run"] else "run_a"
    status = found.loc[found["status_a"] != found["status_b"], number].astype(int).tolist()
    good: Any = found[(found["status_a"] == found["status_b"]) & found["status_a"].isin(["ok", "terminated"])]
    results = []
    for name in (n for n in a.reductions if n in b.reductions):
        before, after = good[f"{name}_a"].to_numpy(float), good[f"{name}_b"].to_numpy(float)
        change = after - before
        known = np.isfinite(change)
        if not known.any():
            continue
        k = int(np.nanargmax(np.where(known, np.abs(change), -1.0)))
        rms = math.sqrt(float(np.mean(change[known] ** 2)))
        spread = float(np.ptp(before[known]))
        results.append(Difference(name, float(change[k]), rms, spread, int(good[number].iloc[k])))
    return Comparison(
        differences(a.about["specification"], b.about["specification"]),
        len(found),
        int((both["_merge"] == "left_only").sum()),
        int((both["_merge"] == "right_only").sum()),
        status,
        results,
    )
