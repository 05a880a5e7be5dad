"""Equations whose highest derivatives depend on each other, though structure does not show it.

Two node equations ``C (u1' - u2') = ...`` and ``C (u2' - u1') = ...`` hold a third one without derivatives; so do the
node equations at both ends of resistors that join two inductors. Pantelides' algorithm sees only which unknowns stand
where, and takes such equations for independent. Here one of them is replaced by the combination in which the highest
derivatives cancel (linear combination method: Tan, Nedialkov and Pryce, 2017, BIT Numer. Math. 57, 845-865).

Only what cancels for all values of the parameters counts: coefficients are compared with random numbers for the
parameters, and the combination is made of the symbols. What is singular for some values only is told at the start of
a run.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from random import Random

import casadi as ca
import numpy as np
from casadi import SX

from arthur_acausal.graph import Echelon, PantelidesResult, SparseRow, blt
from arthur_acausal.transform.derive import Lookup, combination, differentiated
from arthur_acausal.transform.linear import Coefficient
from arthur_acausal.transform.rows import Evaluator, Nodes, Ref, Row
from arthur_acausal.transform.state_sets import pivots

Edges = Sequence[dict[int, Coefficient]]


def combine_dependent(
    rows: Sequence[Row], edges: Edges, result: PantelidesResult, nodes: Nodes, evaluator: Evaluator
) -> dict[int, Row]:
    """Return the rows to replace by combinations that lack their highest derivatives; none if there are none.

    ``result``: what Pantelides' algorithm says of the rows. New derivatives may be appended to ``nodes``.
    """
    top, height = _tops(result.derivative)
    depth, assignment = _highest(result, len(rows))
    leading = [{n: c for n, c in e.items() if height[n] == depth[i]} for i, e in enumerate(edges)]
    blocks = blt([[top[n] for n in e] for e in leading], assignment)
    if all(len(block) == 1 for block in blocks):
        return {}

    def numbers(i: int) -> SparseRow | None:
        if rows[i].expression.through is not None:
            return None
        values = {top[n]: _number(rows[i], c, evaluator) for n, c in leading[i].items()}
        return values if all(math.isfinite(v) and v for v in values.values()) else None

    replaced: dict[int, Row] = {}
    for factors in Echelon(blocks, assignment, numbers).dependent():
        twice, *others = (
            factors  # the least differentiated row gives way, of several the one that is said twice
        )
        target = min([twice, *sorted(others)], key=lambda i: depth[i])
        if target != twice and replaced:
            continue  # two combinations must not take the place of one row: the next round finds it again
        chosen = [target, *(i for i in sorted(factors) if i != target)]
        times = [depth[i] - depth[target] for i in chosen]
        raised = [_raised(rows[i], k, nodes, evaluator) for i, k in zip(chosen, times, strict=True)]
        gone = {
            Ref("node", _risen(n, k, nodes)) for i, k in zip(chosen, times, strict=True) for n in leading[i]
        }
        columns = [{top[n]: c for n, c in leading[i].items()} for i in chosen]
        factor = _factors([rows[i] for i in chosen], columns, [numbers(i) or {} for i in chosen], evaluator)
        replaced[target] = combination(raised, factor, gone, nodes, evaluator)
        if target != twice:
            break
    return replaced


def _raised(row: Row, times: int, nodes: Nodes, evaluator: Evaluator) -> Row:
    for _ in range(times):
        row = differentiated(row, nodes, evaluator)
    return row


def _risen(node: int, times: int, nodes: Nodes) -> int:
    for _ in range(times):
        node = nodes.derivative_of(node)
    return node


def _tops(derivative: Sequence[int]) -> tuple[list[int], list[int]]:
    """Return for each unknown the highest derivative of its chain, and how many steps below it stands."""
    top, height = [], []
    for end in range(len(derivative)):
        steps = 0
        while derivative[end] >= 0:
            end, steps = derivative[end], steps + 1
        top.append(end)
        height.append(steps)
    return top, height


def _highest(result: PantelidesResult, count: int) -> tuple[list[int], list[int]]:
    """Return for each of the given rows how often it is differentiated, and the unknown that it then determines."""
    depth, assignment = [], []
    for i in range(count):
        steps = 0
        while result.equation_derivative[i] >= 0:
            i, steps = result.equation_derivative[i], steps + 1
        depth.append(steps)
        assignment.append(result.assignment[i])
    return depth, assignment


def _number(row: Row, coefficient: Coefficient, evaluator: Evaluator) -> float:
    """Return a coefficient with random values for the parameters in it, each always with the same."""
    if not isinstance(coefficient, SX):
        return math.nan if coefficient is None else coefficient

    def value(ref: Ref) -> SX:
        return SX(Random(ref.number).uniform(0.5, 1.5) if ref.kind == "parameter" else math.nan)

    return float(evaluator(row, value, coefficient))


def _factors(
    rows: Sequence[Row],
    columns: Sequence[dict[int, Coefficient]],
    numbers: Sequence[SparseRow],
    evaluator: Evaluator,
) -> Callable[[Lookup], list[SX]]:
    """Return what gives the factors, the first 1, of rows whose sum has no entry in any column."""
    places = {column: k for k, column in enumerate(dict.fromkeys(c for row in columns for c in row))}
    values = np.zeros((len(rows), len(places)))
    for i, entries in enumerate(numbers):
        for column, value in entries.items():
            values[i, places[column]] = value
    chosen = set(pivots(values[1:])[0][: len(rows) - 1])

    def factors(look: Lookup) -> list[SX]:
        matrix = SX(len(rows), len(places))
        for i, entries in enumerate(columns):
            for column, c in entries.items():
                if places[column] in chosen:
                    value = evaluator(rows[i], look, c) if isinstance(c, SX) else SX(float(c or 0.0))
                    matrix[i, places[column]] = value
        square = matrix[:, sorted(chosen)]
        return [SX(1.0), *ca.vertsplit(ca.solve(square[1:, :].T, -square[0, :].T))]

    return factors
