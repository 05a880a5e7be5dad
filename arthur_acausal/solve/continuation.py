"""Ways to consistent initial values where Newton's method fails from the start values: by easier equations.

Pseudo-transient: what an initial equation der(x) == 0 lets rest begins at its start value and moves towards the rest
by implicit Euler with growing steps h, der(x) == (x - x_before) / h (Kelley and Keyes (1998), SIAM J. Numer. Anal. 35,
508-523). Homotopy: from the model's simplified expressions to the actual ones, in steps as long as Newton's method
bears them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from arthur_acausal.solve.consistent import ConsistentSystem
from arthur_acausal.solve.modes import Modes
from arthur_acausal.solve.newton import Index, Matrix, Solved, SparseMatrix, newton, sparse
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.protocol import DAE, Evaluator, FloatArray

FIRST, GROWTH, SHRINK = (
    1e-4,
    4.0,
    0.1,
)  # of the pseudo-transient: s; factors of h after a success and a failure
STEPS = 80
LONG = 1e2  # s: from this h on the rest itself is tried
FEW = 15  # Newton iterations in a step: where it takes more, a shorter one is better
FIRST_PART, SMALLEST_PART = 0.25, 1e-5  # of the way of the homotopy

Attempt = Callable[[], Solved]


@dataclass(slots=True)
class Point:
    """A copy of the values in an evaluator."""

    arrays: list[FloatArray]

    @classmethod
    def of(cls, evaluator: Evaluator) -> Point:
        """The present values."""
        return cls([a.copy() for a in _values(evaluator)])

    def restore(self, evaluator: Evaluator) -> None:
        """Put the values back."""
        for array, kept in zip(_values(evaluator), self.arrays, strict=True):
            array[:] = kept


def _values(e: Evaluator) -> list[FloatArray]:
    return [e.y, e.yp, e.z, e.zp, e.m]


def homotopy(evaluator: Evaluator, attempt: Attempt) -> Solved:
    """Lead the last entry of p from 0 to 1; every step is an attempt from the solution of the one before."""
    part = evaluator.p[-1:]
    part[0] = 0.0
    solved = attempt()
    iterations, done, step = solved.iterations, 0.0, FIRST_PART
    while not solved.reason and done < 1.0:
        before = Point.of(evaluator)
        part[0] = min(done + step, 1.0)
        trial = attempt()
        iterations += trial.iterations
        if not trial.reason:
            done, step, solved = float(part[0]), 2.0 * step, trial
            continue
        before.restore(evaluator)
        step *= 0.5
        if step < SMALLEST_PART:
            solved = replace(trial, reason=f"stopped at {done:.3g} of the way")
    part[0] = 1.0
    return replace(solved, iterations=iterations)


@dataclass(slots=True)
class _Moving:
    """The initial system with der(x) == (x - before) / h in place of der(x) == 0."""

    system: ConsistentSystem
    rows: Index
    columns: Index
    slope: FloatArray
    before: FloatArray
    h: float

    def residual(self, w: FloatArray) -> FloatArray:
        """The rows, those of the resting states moved."""
        residual = self.system.residual(w).copy()
        residual[self.rows] -= self.slope * (w[self.columns] - self.before) / self.h
        return residual

    def matrix(self) -> Matrix:
        """The Jacobian."""
        matrix, entries = self.system.matrix(), -self.slope / self.h
        if isinstance(matrix, SparseMatrix):
            return sparse(
                np.concatenate([matrix.values, entries]),
                np.concatenate([matrix.row, self.rows]),
                np.concatenate([matrix.column, self.columns]),
                matrix.size,
            )
        matrix[self.rows, self.columns] += entries
        return matrix


def resting(dae: DAE, evaluator: Evaluator, system: ConsistentSystem) -> tuple[Index, Index, FloatArray]:
    """The rows of the system that say der(x) == 0 of a free state, the places of x among the unknowns, the slopes."""
    n, place = dae.n, {j: k for k, j in enumerate(system.free.tolist())}
    row = np.asarray(dae.init_sparsity.row)
    column = np.repeat(np.arange(2 * n), np.diff(dae.init_sparsity.colind))
    alone = np.bincount(row, minlength=dae.n_init) == 1
    slopes = evaluator.initial_jacobian().copy() if dae.n_init else np.zeros(0)
    entry = {int(r): k for k, r in enumerate(row.tolist()) if alone[r]}
    found = []
    for number, condition in enumerate(system.conditions.tolist()):
        k = entry.get(condition)
        if k is not None and column[k] >= n and int(column[k]) - n in place:
            found.append((n + number, place[int(column[k]) - n], float(slopes[k])))
    rows, columns, values = zip(*found, strict=True) if found else ((), (), ())
    return np.array(rows, np.intp), np.array(columns, np.intp), np.array(values, float)


def pseudo_transient(
    evaluator: Evaluator,
    system: ConsistentSystem,
    rest: tuple[Index, Index, FloatArray],
    modes: Modes,
    options: SolverOptions,
    attempt: Attempt,
) -> Solved:
    """Move towards the rest, and solve for it when the steps are long."""
    rows, columns, slope = rest
    low, high = system.bounds()
    iterations, h = 0, FIRST
    for _ in range(STEPS):
        w = system.unknowns()
        moving = _Moving(system, rows, columns, slope, w[columns].copy(), h)
        solved = newton(moving, w, system.scale(), low, high, options.newton_tolerance, FEW)
        iterations += solved.iterations
        if solved.reason:
            system.write(w)
            h *= SHRINK
            continue
        system.write(solved.w)
        modes.assign_discrete()
        modes.update()
        h *= GROWTH
        if h >= LONG:
            kept = Point.of(evaluator)
            final = attempt()
            iterations += final.iterations
            if not final.reason:
                return replace(final, iterations=iterations)
            kept.restore(evaluator)
    return Solved(system.unknowns(), "no rest was reached", iterations, np.inf)
