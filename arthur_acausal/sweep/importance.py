"""Global sensitivity: which factor's variation causes how much of a result's variance.

Sobol indices by the estimators of Saltelli et al. (2010), Comput. Phys. Commun. 181, 259-270, on the runs of a
sweep with ``method = "saltelli"``: two sets A and B of n samples, and for each factor A with
that factor's values out of B.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.errors import UsageError, nearest
from arthur_acausal.sweep.opened import Sweep

CONFIDENCE = 0.95
RESAMPLES = 500  # of the bootstrap


@dataclass(frozen=True, slots=True)
class Importance:
    """Sobol indices of one factor: the part of the variance that it causes alone (``first``) and with all its
    interactions (``total``), each with the limits of a bootstrap interval of 95 %.
    """

    factor: str
    first: float
    first_low: float
    first_high: float
    total: float
    total_low: float
    total_high: float


def importance(sweep: Sweep, reduction: str) -> list[Importance]:
    """Return the Sobol indices of every factor for one reduction.

    Raises UsageError for another method than "saltelli", an unknown reduction, and where runs are missing or failed:
    the estimators need all of them.
    """
    specification = sweep.specification
    if specification.method != "saltelli" or specification.samples is None:
        raise UsageError(
            f"Sobol indices need the runs of the method saltelli, not {specification.method}",
            remedy="sweep with --method saltelli --samples 256",
        )
    if reduction not in sweep.reductions:
        raise UsageError(f"the sweep has no {reduction!r}", remedy=nearest(reduction, sweep.reductions))
    factors, n = list(specification.vary), specification.samples
    blocks = _values(sweep, reduction, n * (len(factors) + 2)).reshape(len(factors) + 2, n)
    found = _indices(blocks)
    chance = np.random.default_rng(0)
    drawn = np.array([_indices(blocks[:, chance.integers(0, n, n)]) for _ in range(RESAMPLES)])
    outside = 0.5 * (1.0 - CONFIDENCE)
    low, high = np.quantile(drawn, [outside, 1.0 - outside], axis=0)
    return [
        Importance(factor, *(float(x[i, k]) for i in (0, 1) for x in (found, low, high)))
        for k, factor in enumerate(factors)
    ]


def _indices(blocks: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return [first order, total] of each factor from the values (factors + 2, n) at A, B, and A with columns of B.

    Table 2 of Saltelli et al. (2010): first order by (b), total by (f), after Jansen.
    """
    a, b, mixed = blocks[0], blocks[1], blocks[2:]
    variance = np.var(blocks[:2])
    if variance == 0.0:
        return np.zeros((2, len(mixed)))
    first = np.mean((b - np.mean(blocks[:2])) * (mixed - a), axis=1)
    total = 0.5 * np.mean((a - mixed) ** 2, axis=1)
    return np.asarray(np.array([first, total]) / variance)


def _values(sweep: Sweep, reduction: str, expected: int) -> NDArray[np.float64]:
    frame = sweep.table.sort_values("run")
    values = frame[reduction].to_numpy(float)
    good = np.isfinite(values)
    if len(frame) != expected or not good.all():
        raise UsageError(
            f"{expected - int(good.sum())} of {expected} runs have no value of {reduction}",
            cause="Sobol indices need every run of the design",
            remedy="finish the sweep with --resume, and choose ranges in which no run fails",
        )
    return np.asarray(values)
