"""Relations of derivatives: the integrator only interpolates y', so it is solved anew from y first."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from arthur_acausal.codegen.compiled import CompiledDAE, Evaluator

FloatArray = NDArray[np.float64]

ITERATIONS = 3


class RootsWithRates:
    """Root functions evaluated with the y' and the algebraic unknowns that fulfil F = 0 for the states."""

    def __init__(self, dae: CompiledDAE, evaluator: Evaluator, roots: Callable[[], FloatArray]) -> None:
        self._evaluator, self._roots = evaluator, roots
        self._states = dae.differential
        self._row = dae.sparsity.row
        self._column = np.repeat(np.arange(dae.n), np.diff(dae.sparsity.colind))
        self._rates = dae.differential[self._column]
        self._matrix = np.zeros((dae.n, dae.n))

    def __call__(self) -> FloatArray:
        """Return the values, always in the same array; the evaluator's arguments stay as they are."""
        evaluator = self._evaluator
        y, yp = evaluator.y.copy(), evaluator.yp.copy()
        self._solve()
        values = self._roots()
        evaluator.y[:], evaluator.yp[:] = y, yp
        return values

    def _solve(self) -> None:
        evaluator, matrix = self._evaluator, self._matrix
        for _ in range(ITERATIONS):
            residual = evaluator.residual()
            dy, dyp = evaluator.jacobian_y(), evaluator.jacobian_yp()
            matrix[self._row, self._column] = np.where(self._rates, dyp, dy)
            try:
                step = np.linalg.solve(matrix, residual)
            except np.linalg.LinAlgError:
                return  # a singular point: the integrator's values serve
            if not np.isfinite(step).all():
                return
            evaluator.yp[self._states] -= step[self._states]
            evaluator.y[~self._states] -= step[~self._states]
            size = np.abs(evaluator.yp) + np.abs(evaluator.y)
            if np.all(np.abs(step) <= 1e-12 * size):
                return
