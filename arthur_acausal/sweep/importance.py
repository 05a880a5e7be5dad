"""Global sensitivity: which factor's variation causes how much of a result's variance.

Sobol indices by the estimators of Saltelli et al. (2010), Comput. Phys. Commun. 181, 259-270, as SciPy computes
them, on the runs of a sweep with ``method = "saltelli"``: two sets A and B of n samples, and for each factor A with
that factor's values out of B.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.errors import UsageError, nearest
from arthur_acausal.sweep.opened import Sweep

CONFIDENCE = 0.95


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
    from scipy.stats import sobol_indices

    specification = sweep.specification
    if specification.method != "saltelli" or specification.samples is None:
        raise UsageError(
            f"Sobol indices need the runs of the method saltelli, not {specification.method}",
            remedy="sweep with --method saltelli --samples 256",
        )
    if reduction not in sweep.reductions:
        raise UsageError(f"the sweep has no {reduction!r}", remedy=nearest(reduction, sweep.reductions))
    factors, n = list(specification.vary), specification.samples
    values = _values(sweep, reduction, n * (len(factors) + 2))
    blocks = values.reshape(len(factors) + 2, 1, n)
    found = sobol_indices(
        func={"f_A": blocks[0], "f_B": blocks[1], "f_AB": blocks[2:]}, n=n, rng=np.random.default_rng(0)
    )
    interval = found.bootstrap(confidence_level=CONFIDENCE)
    first, total = np.ravel(found.first_order), np.ravel(found.total_order)
    bounds = (
        *(np.ravel(getattr(interval.first_order.confidence_interval, side)) for side in ("low", "high")),
        *(np.ravel(getattr(interval.total_order.confidence_interval, side)) for side in ("low", "high")),
    )
    return [
        Importance(
            factor,
            float(first[k]),
            float(bounds[0][k]),
            float(bounds[1][k]),
            float(total[k]),
            float(bounds[2][k]),
            float(bounds[3][k]),
        )
        for k, factor in enumerate(factors)
    ]


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
