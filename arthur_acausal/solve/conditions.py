"""Which initial conditions to use: all that are given if they fit, start values for states that have none.

n unknowns y and the derivatives of the s states stand against n equations F = 0; s initial conditions must come in
addition. A maximum matching, extended in order of preference, finds which fit. Where there is a choice among the
states that keep their start values, those are taken that the equations leave most free, in units of their nominals.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from arthur_acausal.graph import dulmage_mendelsohn, matching
from arthur_acausal.solve.consistent import DENSE_UP_TO, Entries
from arthur_acausal.solve.newton import Index
from arthur_acausal.solve.protocol import DAE, Attributes, Evaluator

Edges = list[list[int]]
GUESSED = 1e-6  # weight of a state whose start value nobody gave


@dataclass(frozen=True, slots=True)
class Conditions:
    """The chosen initial conditions.

    Attributes
    ----------
    pinned : states that keep the value y has (their start value, or what their own condition says).
    rows : rows of h to solve together with F.
    assumed : states among `pinned` that have no initial condition: their start value is taken.
    pinning : rows of h that say the values of the other states among `pinned`.
    surplus : rows of h that have no unknown left; they must hold all the same.
    conflict : for messages, rows of F and of h (from n on) that determine too much where there is surplus.
    undetermined : y and y' (from n on) that nothing determines; empty if all is well.
    """

    pinned: Index
    rows: Index
    assumed: Index
    pinning: list[int] = field(default_factory=list)
    surplus: list[int] = field(default_factory=list)
    conflict: list[int] = field(default_factory=list)
    undetermined: list[int] = field(default_factory=list)


def choose(dae: DAE, evaluator: Evaluator, attributes: Attributes) -> Conditions:
    """Choose initial conditions; the evaluator holds the start values.

    Linear conditions on one state each are solved here at once: y gets the value they say.
    """
    simple = _simple(dae, evaluator)
    rest = [k for k in range(dae.n_init) if k not in simple]
    _solve_simple(dae, evaluator, simple)
    states = set(np.flatnonzero(dae.differential).tolist())
    pinned = set(simple.values())
    if not rest:
        assumed = states - pinned
        return Conditions(_index(states), _index(()), _index(assumed), list(simple))
    return _match(dae, evaluator, attributes, pinned, rest, simple)


def _simple(dae: DAE, evaluator: Evaluator) -> dict[int, int]:
    """Rows of h in which one state stands alone and linearly, each state once."""
    if not dae.n_init:
        return {}
    colind, row = np.asarray(dae.init_sparsity.colind), np.asarray(dae.init_sparsity.row)
    column = np.repeat(np.arange(colind.size - 1), np.diff(colind))
    alone = np.bincount(row, minlength=dae.n_init)[row] == 1
    slope = evaluator.initial_jacobian().copy()
    y = evaluator.y.copy()
    evaluator.y[:] = y + 0.1 * (np.abs(y) + 1.0)
    linear = (evaluator.initial_jacobian() == slope) & (slope != 0.0)
    evaluator.y[:] = y
    found: dict[int, int] = {}
    taken: set[int] = set()
    for k, j in zip(row[alone & linear].tolist(), column[alone & linear].tolist(), strict=True):
        if j < dae.n and dae.differential[j] and j not in taken:
            found[k] = j
            taken.add(j)
    return found


def _solve_simple(dae: DAE, evaluator: Evaluator, simple: dict[int, int]) -> None:
    """Give y the values that the conditions say."""
    if not simple:
        return
    slopes = np.zeros(dae.n_init)
    slopes[np.asarray(dae.init_sparsity.row)] = evaluator.initial_jacobian()  # right for rows of one entry
    values = evaluator.initial()
    for k, j in simple.items():
        evaluator.y[j] -= values[k] / slopes[k]


def _match(
    dae: DAE,
    evaluator: Evaluator,
    attributes: Attributes,
    pinned: set[int],
    rest: list[int],
    simple: dict[int, int],
) -> Conditions:
    n = dae.n
    equations, initial = _edges(dae, evaluator, pinned)
    edges = equations + [initial[k] for k in rest]
    assignment = matching(equations, 2 * n)
    assignment = matching(edges, 2 * n, assignment)
    free = [j for j in np.flatnonzero(dae.differential).tolist() if j not in pinned]
    candidates: list[int] = []
    for wanted in (True, False):  # states whose start was given come first
        batch = [j for j in free if bool(attributes.start_given[j]) is wanted]
        edges += [[j] for j in batch]
        candidates += batch
        assignment = matching(edges, 2 * n, assignment)
    assumed = [j for j, v in zip(candidates, assignment[n + len(rest) :], strict=True) if v >= 0]
    chosen = [k for k, v in zip(rest, assignment[n:], strict=False) if v >= 0]
    if 0 < len(assumed) < len(candidates) and n <= DENSE_UP_TO:
        assumed = _freest(dae, evaluator, attributes, pinned, chosen, candidates, len(assumed)) or assumed
    surplus = [k for k, v in zip(rest, assignment[n:], strict=False) if v < 0]
    conflict: list[int] = []
    if surplus:
        part = dulmage_mendelsohn(edges[: n + len(rest)], 2 * n)
        conflict = [i if i < n else n + rest[i - n] for i in part.over_equations]
        conflict += [n + k for k in _pinning(dae, conflict, simple)]
    unknown = set(range(n)) - pinned | {n + j for j in np.flatnonzero(dae.differential).tolist()}
    undetermined = sorted(unknown - set(assignment))
    return Conditions(
        _index(pinned.union(assumed)),
        _index(chosen),
        _index(assumed),
        list(simple),
        surplus,
        conflict,
        undetermined,
    )


def _freest(
    dae: DAE,
    evaluator: Evaluator,
    attributes: Attributes,
    pinned: set[int],
    chosen: list[int],
    candidates: list[int],
    count: int,
) -> list[int]:
    """The states to hold, out of the candidates: together they move most, in nominals, along the null space.

    Pivoted QR picks them (Golub and Van Loan (2013), Matrix Computations, section 5.4.2), those with a start value
    first. None if the matrix at the start does not have the rank that the structure promises.
    """
    from scipy.linalg import null_space, qr

    n, entries = dae.n, Entries.of(dae)
    values = np.concatenate(
        [evaluator.jacobian_y().copy(), evaluator.jacobian_yp().copy(), evaluator.initial_jacobian()]
    )
    matrix = np.zeros((n + dae.n_init, 2 * n))
    matrix[entries.row, entries.column] = values
    nominal = np.abs(attributes.nominal)
    unknown = sorted(set(range(n)) - pinned) + (n + np.flatnonzero(dae.differential)).tolist()
    matrix = (matrix * np.tile(nominal, 2))[np.ix_([*range(n), *(n + k for k in chosen)], unknown)]
    if not np.isfinite(matrix).all():
        return []
    size = np.abs(matrix).max(axis=1)
    null = null_space(matrix / np.where(size > 0.0, size, 1.0)[:, None])
    if null.shape[1] != count:
        return []
    weight = np.where(attributes.start_given[candidates], 1.0, GUESSED)
    rows = null[[unknown.index(j) for j in candidates]] * weight[:, None]
    decomposed: Any = qr(rows.T, mode="economic", pivoting=True)  # its annotation is a union of all modes
    _, triangle, order = decomposed
    if abs(triangle[count - 1, count - 1]) < GUESSED**2:
        return []
    return [candidates[k] for k in order[:count].tolist()]


def _pinning(dae: DAE, conflict: list[int], simple: dict[int, int]) -> list[int]:
    """The conditions that say the values of the pinned states in the conflicting rows."""
    entries = Entries.of(dae)
    columns = set(entries.column[np.isin(entries.row, conflict)].tolist())
    return [k for k, state in simple.items() if state in columns]


def _edges(dae: DAE, evaluator: Evaluator, pinned: set[int]) -> tuple[Edges, Edges]:
    """Unknowns in each row of F and of h: y' and algebraic variables first, states last, pinned ones not at all."""
    n = dae.n
    entries = Entries.of(dae)
    present = _present(dae, evaluator, entries.row.size)
    edges: Edges = [[] for _ in range(n + dae.n_init)]
    state = np.concatenate([dae.differential, np.zeros(n, dtype=bool)])
    order = np.lexsort((state[entries.column], entries.row))
    for k in order[present[order]].tolist():
        column = int(entries.column[k])
        if column not in pinned:
            edges[int(entries.row[k])].append(column)
    return edges[:n], edges[n:]


def _present(dae: DAE, evaluator: Evaluator, size: int) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Entries that are really there: the two parts of the Jacobian share one pattern, each with zeros of its own.

    Found by evaluation at the start and at two points nearby, since an entry may vanish at one point by chance.
    """
    random = np.random.default_rng(0)
    y, yp = evaluator.y.copy(), evaluator.yp.copy()
    nonzero = np.zeros(2 * dae.sparsity.row.size, dtype=bool)
    for spread in (0.0, 1e-3, 1e-2):
        evaluator.y[:] = y + spread * random.random(dae.n) * (np.abs(y) + 1.0)
        evaluator.yp[:] = yp + spread * random.random(dae.n)
        values = np.concatenate([evaluator.jacobian_y().copy(), evaluator.jacobian_yp()])
        nonzero |= values != 0.0
    evaluator.y[:], evaluator.yp[:] = y, yp
    return np.concatenate([nonzero, np.ones(size - nonzero.size, dtype=bool)])


def _index(values: set[int] | list[int] | tuple[()]) -> Index:
    return np.array(sorted(values), dtype=np.intp)
