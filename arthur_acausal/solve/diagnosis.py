"""Which equations and unknowns to name when a system of equations cannot be solved."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from arthur_acausal.solve.newton import Matrix, as_sparse, equilibrated, sparse, superlu
from arthur_acausal.solve.protocol import FloatArray

SHOWN = 6  # names in one message
PART = 0.1  # a component counts as part of a null vector from this part of the largest on
PERTURBATION = 1e-12


def null_vectors(matrix: Matrix, scale: FloatArray) -> tuple[list[int], list[int]]:
    """Unknowns that a singular matrix leaves free and rows that depend on each other, the most involved first.

    One step of inverse iteration with a slightly perturbed diagonal: its result lies in the null space up to the
    size of the perturbation (Golub and Van Loan (2013), Matrix Computations, section 7.6.1).
    """
    scaled = as_sparse(equilibrated(matrix, scale)[0])
    random = np.random.default_rng(0)
    diagonal = np.arange(scaled.size)
    perturbed = np.concatenate([scaled.values, PERTURBATION * (1.0 + random.random(scaled.size))])
    row, column = np.concatenate([scaled.row, diagonal]), np.concatenate([scaled.column, diagonal])
    factors = superlu(sparse(perturbed, row, column, scaled.size))
    if factors is None:
        return [], []
    start = random.random(scaled.size) - 0.5
    return _parts(factors.solve(start)), _parts(factors.solve(start, trans="T"))


def _parts(vector: FloatArray) -> list[int]:
    size = np.abs(vector)
    order: list[int] = np.argsort(-size, kind="stable").tolist()
    return [i for i in order if size[i] > PART * size[order[0]]]


def scaled_rows(matrix: Matrix, residual: FloatArray, scale: FloatArray) -> FloatArray:
    """Residuals over the largest change that `scale` of an unknown makes in each row."""
    return residual / equilibrated(matrix, scale)[1]


def listed(names: Sequence[str], separator: str = ", ") -> str:
    """The first names, and how many more there are."""
    more = len(names) - SHOWN
    return separator.join(names[:SHOWN]) + (f" and {more} more" if more > 0 else "")
