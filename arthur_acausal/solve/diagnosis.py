"""Which equations and unknowns to name when a system of equations cannot be solved."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from arthur_acausal.solve.newton import equilibrated
from arthur_acausal.solve.protocol import FloatArray

SHOWN = 6  # names in one message
PART = 0.1  # a component counts as part of a null vector from this part of the largest on
PERTURBATION = 1e-12


def null_vectors(matrix: Any, scale: FloatArray) -> tuple[list[int], list[int]]:
    """Unknowns that a singular matrix leaves free and rows that depend on each other, the most involved first.

    One step of inverse iteration with a slightly perturbed diagonal: its result lies in the null space up to the
    size of the perturbation (Golub and Van Loan (2013), Matrix Computations, section 7.6.1).
    """
    from scipy.sparse import csc_matrix, diags_array
    from scipy.sparse.linalg import splu

    dense = matrix if isinstance(matrix, np.ndarray) else None
    if dense is not None:
        scaled: Any = csc_matrix(equilibrated(dense, scale)[0])
    else:
        scaled = matrix @ diags_array(scale)
        rows = abs(scaled).max(axis=1).toarray().ravel()
        rows[rows == 0.0] = 1.0
        scaled = diags_array(1.0 / rows) @ scaled
    random = np.random.default_rng(0)
    size = scaled.shape[0]
    try:
        factors = splu((scaled + diags_array(PERTURBATION * (1.0 + random.random(size)))).tocsc())
    except RuntimeError:
        return [], []
    start = random.random(size) - 0.5
    return _parts(factors.solve(start)), _parts(factors.solve(start, trans="T"))


def _parts(vector: FloatArray) -> list[int]:
    size = np.abs(vector)
    order = np.argsort(-size, kind="stable")
    return [int(i) for i in order if size[i] > PART * size[order[0]]]


def scaled_rows(matrix: Any, residual: FloatArray, scale: FloatArray) -> FloatArray:
    """Residuals over the change that the unknowns' magnitudes make in each row: 1 is as wrong as can be."""
    if isinstance(matrix, np.ndarray):
        rows = np.max(np.abs(matrix) * scale, axis=1, initial=0.0)
    else:
        rows = np.asarray(abs(matrix).multiply(scale).max(axis=1).toarray()).ravel()
    rows[~(rows > 0.0)] = 1.0
    return residual / rows


def listed(names: Sequence[str], separator: str = ", ") -> str:
    """The first names, and how many more there are."""
    more = len(names) - SHOWN
    return separator.join(names[:SHOWN]) + (f" and {more} more" if more > 0 else "")
