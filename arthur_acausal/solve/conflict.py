"""The initial conditions that were left out: whether they hold, and with which equations they are in conflict."""

from __future__ import annotations

import numpy as np

from arthur_acausal.errors import InitializationError
from arthur_acausal.solve.conditions import Conditions
from arthur_acausal.solve.consistent import Entries
from arthur_acausal.solve.diagnosis import listed
from arthur_acausal.solve.newton import SparseMatrix, equilibrated, sparse, superlu
from arthur_acausal.solve.protocol import DAE, Attributes, Evaluator, FloatArray

CONSISTENT = 1e-6  # scaled residual up to which a surplus initial condition counts as fulfilled
PART = 1e-6  # a row takes part in a linear combination from this part of its largest coefficient on


def check_surplus(dae: DAE, evaluator: Evaluator, attributes: Attributes, conditions: Conditions) -> None:
    """Raise InitializationError unless the initial conditions that were left out hold in the solution."""
    if not conditions.surplus:
        return
    values = evaluator.initial().copy()
    scale = _initial_scale(dae, evaluator, attributes)
    wrong = [k for k in conditions.surplus if not abs(values[k]) <= CONSISTENT * scale[k]]
    if wrong:
        told = "; ".join(f"{dae.init_labels[k]} (off by {values[k]:.6g})" for k in wrong)
        rows = conflicting(dae, evaluator, attributes, conditions, wrong[0])
        names = [dae.row_labels[i] if i < dae.n else dae.init_labels[i - dae.n] for i in rows]
        raise InitializationError(
            f"the initial conditions contradict each other: not fulfilled: {told}",
            cause=f"together these determine more than there is: {listed(names, '; ')}",
            remedy="remove one of them, or replace a fixed start value by a guess",
        )


def _initial_scale(dae: DAE, evaluator: Evaluator, attributes: Attributes) -> FloatArray:
    """Largest change that the unknowns' magnitudes make in each initial condition."""
    row = np.asarray(dae.init_sparsity.row)
    column = np.repeat(np.arange(2 * dae.n), np.diff(dae.init_sparsity.colind))
    magnitude = np.maximum(np.abs(attributes.nominal), np.abs(evaluator.y))
    scale = np.zeros(dae.n_init)
    np.maximum.at(scale, row, np.abs(evaluator.initial_jacobian()) * np.tile(magnitude, 2)[column])
    return scale


def conflicting(
    dae: DAE, evaluator: Evaluator, attributes: Attributes, conditions: Conditions, surplus: int
) -> list[int]:
    """The rows of F and of h (from n on) that alone contradict each other with one surplus row of h, itself first.

    Its gradient is a combination of those of the rows that determine everything; the others have no share in it, so
    that without any one of these the contradiction is gone. If there is no such combination, as the structure says.
    """
    n, states = dae.n, np.flatnonzero(dae.differential)
    chosen = [*range(n), *(n + k for k in (*conditions.rows.tolist(), *conditions.pinning))]
    assumed = conditions.assumed
    place = np.full(n + dae.n_init, -1, dtype=np.intp)
    place[chosen] = np.arange(len(chosen))
    column_of = np.full(2 * n, -1, dtype=np.intp)
    column_of[:n], column_of[n + states] = np.arange(n), n + np.arange(states.size)
    entries, size = Entries.of(dae), n + states.size
    values = np.concatenate(
        [evaluator.jacobian_y().copy(), evaluator.jacobian_yp().copy(), evaluator.initial_jacobian()]
    )
    row, column = place[entries.row], column_of[entries.column]
    taken = (row >= 0) & (column >= 0)
    matrix = sparse(
        np.concatenate([values[taken], np.ones(assumed.size)]),
        np.concatenate([row[taken], len(chosen) + np.arange(assumed.size)]),
        np.concatenate([column[taken], assumed]),
        size,
    )
    scale = np.maximum(np.abs(attributes.nominal), np.abs(evaluator.y))
    scale = np.concatenate([scale, scale[states]])
    own = (entries.row == n + surplus) & (column >= 0)
    gradient = np.zeros(size)
    gradient[column[own]] = values[own] * scale[column[own]]
    scaled, _ = equilibrated(matrix, scale)
    assert isinstance(scaled, SparseMatrix)
    factors = superlu(scaled)
    if factors is None:
        return [n + surplus, *(i for i in conditions.conflict if i != n + surplus)]
    share = np.abs(factors.solve(gradient, trans="T"))[: len(chosen)]
    involved = [chosen[i] for i in np.flatnonzero(share > PART * share.max(initial=0.0)).tolist()]
    return [n + surplus, *sorted(involved, key=lambda i: (i < n, i))]
