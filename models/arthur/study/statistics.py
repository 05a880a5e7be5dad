"""Means with confidence intervals, differences paired by seed, and the front of what is not dominated."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite, sqrt
from typing import Any

import numpy as np

from arthur_acausal.models.arthur.study.results import NET, Result

LEVEL = 0.95


@dataclass(frozen=True, slots=True)
class Estimate:
    """A mean over ``n`` seeds with the half width ``ci95`` of its confidence interval; None below two seeds."""

    mean: float | None
    ci95: float | None
    n: int

    @property
    def certain(self) -> bool:
        """Whether the interval leaves out 0."""
        return self.mean is not None and self.ci95 is not None and abs(self.mean) > self.ci95

    def as_data(self) -> dict[str, Any]:
        """Return it in terms of JSON."""
        return {"mean": self.mean, "ci95": self.ci95, "n": self.n}


def estimate(values: Iterable[float]) -> Estimate:
    """Return mean and Student's interval of what is finite."""
    from scipy.stats import t

    kept = [x for x in values if isfinite(x)]
    n = len(kept)
    if n < 2:
        return Estimate(kept[0] if kept else None, None, n)
    half = t.ppf((1 + LEVEL) / 2, n - 1) * np.std(kept, ddof=1) / sqrt(n)
    return Estimate(float(np.mean(kept)), float(half), n)


def share(happened: Sequence[bool]) -> Estimate:
    """Return how often something happened; ``ci95`` is the farther end of Wilson's interval (1927), so not 0 of 0."""
    from scipy.stats import norm

    n = len(happened)
    if not n:
        return Estimate(None, None, 0)
    z, p = norm.ppf((1 + LEVEL) / 2), sum(happened) / n
    centre = (p + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z / (1 + z**2 / n) * sqrt(p * (1 - p) / n + z**2 / (4 * n**2))
    return Estimate(p, float(max(centre + half - p, p - centre + half)), n)


def paired(
    these: Iterable[Result], those: Iterable[Result], measure: str, relative: bool = False
) -> Estimate:
    """Return the difference of a measure, these less those, of the same task and seed; or as a share of those."""
    before = {(r.case.task.name, r.case.seed): r[measure] for r in those}
    differences = []
    for r in these:
        other = before.get((r.case.task.name, r.case.seed))
        if other is not None:
            scale = other if relative else 1.0
            differences.append((r[measure] - other) / scale if scale else float("nan"))
    return estimate(differences)


def at_equal(these: Iterable[Result], curve: Sequence[Result], measure: str) -> Estimate:
    """Return the difference of net power where a measure is equal, as a share, paired by seed.

    ``curve``: the runs of another scheme at several set points, linear in between; a seed at which the curve does not
    reach the measure of these is left out.
    """
    differences = []
    for r in these:
        points = sorted(
            (c[measure], c[NET]) for c in curve if c.case.seed == r.case.seed and isfinite(c[measure])
        )
        if len(points) > 1 and points[0][0] <= r[measure] <= points[-1][0]:
            x, y = zip(*points, strict=True)
            there = float(np.interp(r[measure], x, y))
            differences.append(r[NET] / there - 1.0)
    return estimate(differences)


def front(points: Mapping[Any, tuple[float, float]]) -> set[Any]:
    """Return the keys of the points that no other is below in both: smaller is better."""
    return {
        key
        for key, (x, y) in points.items()
        if not any(a <= x and b <= y and (a, b) != (x, y) for a, b in points.values())
    }
