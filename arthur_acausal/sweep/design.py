"""The table of runs of a sweep: every combination, or samples; the same for the same seed, whatever comes later."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.errors import UsageError
from arthur_acausal.sweep.factor import Factor, Value, parse_factor
from arthur_acausal.sweep.specification import RANDOM, Specification

MODEL = "model"  # the column that tells models apart


@dataclass(frozen=True, slots=True)
class Run:
    """One run: its number, the model, the values of what varies, and which repetition it is."""

    number: int
    model: str
    values: Mapping[str, Value]
    replicate: int = 0


def runs(specification: Specification, folder: Path) -> list[Run]:
    """Return all runs in order: models, then the design, then replicates fastest.

    ``folder``: where the files that factors name stand. Raises UsageError where factors do not fit the method.
    """
    factors = {name: parse_factor(name, given, folder) for name, given in specification.vary.items()}
    rows = list(design(specification, factors))
    replicates = specification.replicates
    found: list[Run] = []
    for model, values, replicate in itertools.product(specification.models, rows, range(replicates.count)):
        seeded = dict(values)
        if replicates.parameter:
            seeded[replicates.parameter] = float(specification.seed + replicate)
        found.append(Run(len(found), model, seeded, replicate))
    return found


def design(specification: Specification, factors: Mapping[str, Factor]) -> Iterator[dict[str, Value]]:
    """Yield the values of each run by path."""
    if specification.method in RANDOM:
        yield from _samples(specification, factors)
        return
    for name, factor in factors.items():
        if factor.distribution:
            raise UsageError(
                f"{name} is a distribution, and the method is {specification.method}",
                remedy="give a count (low:high:count), or a method of random, lhs and sobol with samples",
            )
    if specification.method == "zip":
        yield from _together(list(factors), factors)
        return
    grouped = {name for group in specification.zip for name in group}
    axes = [list(_together(group, factors)) for group in specification.zip]
    axes += [[{name: v} for v in factor.values] for name, factor in factors.items() if name not in grouped]
    for parts in itertools.product(*axes):
        merged = {name: value for part in parts for name, value in part.items()}
        yield {name: merged[name] for name in factors}


def _together(names: Sequence[str], factors: Mapping[str, Factor]) -> Iterator[dict[str, Value]]:
    """Yield the first value of each factor, then the second of each."""
    lengths = {name: len(factors[name].values) for name in names}
    if len(set(lengths.values())) > 1:
        told = ", ".join(f"{name} has {length}" for name, length in lengths.items())
        raise UsageError(f"factors that vary together need as many values: {told}")
    for row in zip(*(factors[name].values for name in names), strict=True):
        yield dict(zip(names, row, strict=True))


def _samples(specification: Specification, factors: Mapping[str, Factor]) -> Iterator[dict[str, Value]]:
    assert specification.samples is not None  # the schema asks for it
    method, count, seed = specification.method, specification.samples, specification.seed
    points = (
        saltelli(len(factors), count, seed)
        if method == "saltelli"
        else unit_samples(method, len(factors), count, seed)
    )
    columns = [factor.at(points[:, k]) for k, factor in enumerate(factors.values())]
    for row in zip(*columns, strict=True):
        yield dict(zip(factors, row, strict=True))


def unit_samples(method: str, dimensions: int, count: int, seed: int) -> NDArray[np.float64]:
    """Return points of the unit cube (count, dimensions).

    Those of "random" and "sobol" begin alike whatever the count, so that samples can be added later.
    """
    if dimensions == 0:
        return np.zeros((count, 0))
    if method == "random":
        return np.random.default_rng(seed).random((count, dimensions))
    from scipy.stats import qmc  # takes a second to import

    if method == "lhs":
        return np.asarray(qmc.LatinHypercube(dimensions, rng=np.random.default_rng(seed)).random(count))
    sampler = qmc.Sobol(dimensions, scramble=True, rng=np.random.default_rng(seed))
    power = math.ceil(math.log2(count)) if count > 1 else 0
    return np.asarray(sampler.random_base2(power)[:count])


def saltelli(dimensions: int, count: int, seed: int) -> NDArray[np.float64]:
    """Return the points (count (dimensions + 2), dimensions) of Sobol indices: A, B, and A with each column of B."""
    if count & (count - 1):
        raise UsageError(
            f"saltelli with {count} samples", remedy="a power of two: Sobol points are balanced only then"
        )
    both = unit_samples("sobol", 2 * dimensions, count, seed)
    a, b = both[:, :dimensions], both[:, dimensions:]
    mixed = []
    for k in range(dimensions):
        one = a.copy()
        one[:, k] = b[:, k]
        mixed.append(one)
    return np.vstack([a, b, *mixed])
