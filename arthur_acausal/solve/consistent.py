"""The equations that hold at one instant: F = 0 and initial conditions, for chosen unknowns among y and y'.

At an event the states are known, and the algebraic variables and all derivatives are solved for; at the start some
states may be unknown as well, with initial conditions in exchange.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from arthur_acausal.solve.newton import Index, Matrix, Solve, Solved, SparseMatrix, factorise, newton
from arthur_acausal.solve.protocol import DAE, Attributes, Evaluator, FloatArray, Pattern

DENSE_UP_TO = 200
SIGNS = 4  # choices of signs from which a spread is estimated


@dataclass(frozen=True, slots=True)
class Entries:
    """Rows and columns of all entries of [dF/dy | dF/dy'] over [dh/dy | dh/dy'], in the kernels' order."""

    row: Index
    column: Index  # y: 0 to n - 1; y': n to 2 n - 1

    @classmethod
    def of(cls, dae: DAE) -> Entries:
        """All entries of the model's two patterns."""
        row, column = _entries(dae.sparsity)
        rows, columns = [row, row], [column, column + dae.n]
        if dae.n_init:
            row, column = _entries(dae.init_sparsity)
            rows.append(row + dae.n)
            columns.append(column)
        return cls(np.concatenate(rows), np.concatenate(columns))


class ConsistentSystem:
    """The square system for the unknowns y[free] and y' of all states; rows: all of F and some of h.

    It works in place on the evaluator's y and y', which hold the solution afterwards.
    """

    def __init__(
        self, dae: DAE, evaluator: Evaluator, attributes: Attributes, free: Index, conditions: Index
    ) -> None:
        self._evaluator, self._pattern = evaluator, dae.sparsity
        self.free, self.states = free, np.flatnonzero(dae.differential)
        self.conditions = conditions
        self._signs = np.random.default_rng(0).choice([-1.0, 1.0], (SIGNS, self.states.size))
        self.size = free.size + self.states.size
        self._n, self._with_initial = dae.n, bool(dae.n_init) and conditions.size > 0
        self.nominal = np.abs(attributes.nominal)
        self._low = np.concatenate([attributes.min[free], np.full(self.states.size, -np.inf)])
        self._high = np.concatenate([attributes.max[free], np.full(self.states.size, np.inf)])
        self._arrange(Entries.of(dae))

    def _arrange(self, entries: Entries) -> None:
        """Where each value of the kernels goes in the matrix."""
        n = self._n
        row_of = np.full(n + int(entries.row.max(initial=-1)) + 1, -1, dtype=np.intp)
        row_of[:n] = np.arange(n)
        row_of[n + self.conditions] = n + np.arange(self.conditions.size)
        column_of = np.full(2 * n, -1, dtype=np.intp)
        column_of[self.free] = np.arange(self.free.size)
        column_of[n + self.states] = self.free.size + np.arange(self.states.size)
        row, column = row_of[entries.row], column_of[entries.column]
        taken = np.flatnonzero((row >= 0) & (column >= 0))
        order = taken[np.lexsort((row[taken], column[taken]))]
        self._source, self._row, self._column = order, row[order], column[order]
        self._colind = np.searchsorted(self._column, np.arange(self.size + 1)).astype(np.int32)

    def unknowns(self) -> FloatArray:
        """The unknowns as the evaluator holds them."""
        return np.concatenate([self._evaluator.y[self.free], self._evaluator.yp[self.states]])

    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """The unknowns' min and max."""
        return self._low, self._high

    def write(self, w: FloatArray) -> None:
        """Write the unknowns to the evaluator."""
        self._evaluator.y[self.free] = w[: self.free.size]
        self._evaluator.yp[self.states] = w[self.free.size :]

    def residual(self, w: FloatArray) -> FloatArray:
        """Write w to the evaluator; F and the conditions there."""
        evaluator = self._evaluator
        self.write(w)
        values = evaluator.residual()
        if self._with_initial:
            return np.concatenate([values, evaluator.initial()[self.conditions]])
        return values

    def matrix(self) -> Matrix:
        """The Jacobian where the evaluator stands."""
        evaluator = self._evaluator
        evaluator.cj[0] = 1.0
        parts = [evaluator.jacobian_y().copy(), evaluator.jacobian_yp().copy()]
        if self._with_initial:
            parts.append(evaluator.initial_jacobian())
        values = np.concatenate(parts)[self._source]
        if self.size > DENSE_UP_TO:
            return SparseMatrix(values, self._row, self._column, self._colind)
        dense = np.zeros((self.size, self.size))
        dense[self._row, self._column] = values
        return dense

    def scale(self) -> FloatArray:
        """Magnitudes of the unknowns: below these a value counts as small."""
        return np.concatenate([self.nominal[self.free], self.nominal[self.states]])

    def solve(self, tolerance: float, most: int) -> Solved:
        """Solve from where the evaluator stands, and leave the solution in it."""
        scale = self.scale()
        solved = newton(self, self.unknowns(), scale, self._low, self._high, tolerance, most)
        if (
            solved.reason in ("no progress", "iterations")
            and (np.isfinite(self._low) | np.isfinite(self._high)).any()
        ):
            # A bound may stand between the start and the solution: bounds are advice, equations are not.
            unbounded = np.full(self.size, np.inf)
            solved = newton(self, solved.w, scale, -unbounded, unbounded, tolerance, most)
        self.write(solved.w)
        return solved

    def spread(self, tolerance: FloatArray) -> FloatArray:
        """How far y[free] moves when each state is off by its tolerance, (n,): zero for all other unknowns.

        The root mean square over a few choices of signs, at the values that the evaluator holds.
        """
        evaluator, pattern = self._evaluator, self._pattern
        solve, singular = factorise(self.matrix(), np.maximum(np.abs(self.unknowns()), self.scale()))
        spread = np.zeros(self._n)
        if singular:
            return spread
        slope, row = evaluator.jacobian_y(), np.asarray(pattern.row)
        total = np.zeros(self.free.size)
        for signs in self._signs:
            change = np.zeros(self._n)
            change[self.states] = signs * tolerance[self.states]
            entries = slope * np.repeat(change, np.diff(pattern.colind))
            off = np.bincount(row, weights=entries, minlength=self.size).astype(np.float64)
            total += solve(off)[: self.free.size] ** 2
        spread[self.free] = np.nan_to_num(np.sqrt(total / SIGNS), nan=0.0, posinf=0.0)
        return spread

    def rates(self, solve: Solve, ahead: float, now: FloatArray) -> FloatArray:
        """Derivatives of the unknowns, by a forward difference of F along the solution over `ahead` seconds.

        `solve` solves with the matrix of the consistent values, which the evaluator holds. The states move with y',
        and what F then has changed by is what the unknowns must take back. The caller moves time and inputs along;
        `now` is F before, not zero where the values are IDA's, within its tolerance.
        """
        evaluator, states = self._evaluator, self.states
        y = evaluator.y[states]
        evaluator.y[states] += ahead * evaluator.yp[states]
        change = evaluator.residual() - now
        evaluator.y[states] = y
        return -solve(change) / ahead


def _entries(pattern: Pattern) -> tuple[Index, Index]:
    colind = np.asarray(pattern.colind, dtype=np.intp)
    column = np.repeat(np.arange(colind.size - 1), np.diff(colind))
    return np.asarray(pattern.row, dtype=np.intp), column
