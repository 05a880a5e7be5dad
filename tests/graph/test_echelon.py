"""Dependent rows of small matrices, block by block."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal.graph import Echelon, SparseRow, blt


def dependent(rows: list[SparseRow | None], assignment: list[int]) -> list[SparseRow]:
    edges = [list(row or {v: 1.0}) for row, v in zip(rows, assignment, strict=True)]
    return Echelon(blt(edges, assignment), assignment, lambda e: rows[e]).dependent()


def test_two_rows_that_are_multiples() -> None:
    assert dependent([{0: 2.0, 1: -2.0}, {0: -3.0, 1: 3.0}], [0, 1]) == [{1: 1.0, 0: 1.5}]


def test_regular_rows() -> None:
    assert dependent([{0: 1.0, 1: 1.0}, {0: 1.0, 1: -1.0}], [0, 1]) == []


def test_a_ring_of_node_equations_is_dependent_as_a_whole() -> None:
    ring: list[SparseRow | None] = [
        {0: 1.0, 3: -1.0},
        {1: 1.0, 0: -1.0},
        {2: 1.0, 1: -1.0},
        {3: 1.0, 2: -1.0},
    ]
    (found,) = dependent(ring, [0, 1, 2, 3])
    assert {e: pytest.approx(f) for e, f in found.items()} == dict.fromkeys(range(4), 1.0)


def test_a_row_that_says_something_new_of_an_earlier_block_is_none() -> None:
    # the second pair is dependent in its own unknowns, but determines what the first pair leaves open
    rows: list[SparseRow | None] = [
        {0: 1.0, 1: 1.0},
        {0: 1.0, 1: 1.0},
        {0: 5.0, 2: 1.0, 3: -1.0},
        {1: 7.0, 2: 1.0, 3: -1.0},
    ]
    (found,) = dependent(rows, [0, 1, 2, 3])
    assert set(found) == {0, 1}


def test_a_dependence_by_way_of_an_earlier_block() -> None:
    rows: list[SparseRow | None] = [{0: 4.0}, {0: 1.0, 1: 1.0, 2: 2.0}, {0: 3.0, 1: 1.0, 2: 2.0}]
    (found,) = dependent(rows, [0, 1, 2])
    total = np.zeros(3)
    for e, f in found.items():
        for v, a in (rows[e] or {}).items():
            total[v] += f * a
    np.testing.assert_allclose(total, 0.0, atol=1e-15)
    assert set(found) == {0, 1, 2}


def test_a_row_without_numbers_takes_no_part() -> None:
    assert dependent([None, {0: 1.0, 1: 1.0}, {0: 3.0, 1: 1.0, 2: 2.0}], [0, 1, 2]) == []
    assert dependent([None, {0: 1.0, 1: 1.0, 2: 2.0}, {0: 3.0, 1: 1.0, 2: 2.0}], [0, 1, 2]) == []
