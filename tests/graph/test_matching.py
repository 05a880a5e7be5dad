"""Matching and the Dulmage-Mendelsohn parts, on literal graphs and against SciPy."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_array
from scipy.sparse.csgraph import maximum_bipartite_matching

from arthur_acausal.graph import (
    Conflict,
    augment,
    conflicts,
    dulmage_mendelsohn,
    inverse,
    matching,
    transpose,
)

graphs = st.integers(0, 12).flatmap(
    lambda n: st.tuples(
        st.just(n), st.lists(st.lists(st.integers(0, n - 1), max_size=4) if n else st.just([]), max_size=12)
    )
)


def size(edges: list[list[int]], n: int) -> int:
    incidence = np.zeros((len(edges), n))
    for equation, variables in enumerate(edges):
        incidence[equation, variables] = 1.0
    if not incidence.size:
        return 0
    return int((maximum_bipartite_matching(csr_array(incidence), perm_type="column") >= 0).sum())


def assert_matching(edges: list[list[int]], assignment: list[int]) -> None:
    taken = [v for v in assignment if v >= 0]
    assert len(taken) == len(set(taken))
    assert all(v in edges[e] for e, v in enumerate(assignment) if v >= 0)


def test_greedy_pass_honours_the_order_of_edges() -> None:
    assert matching([[2, 0], [1, 2], [0, 1]], 3) == [2, 1, 0]


def test_augmenting_path_through_all_equations() -> None:
    assert matching([[0, 1], [1, 2], [2, 3], [0]], 4) == [1, 2, 3, 0]


def test_singular_system_leaves_an_equation() -> None:
    assignment = matching([[0], [0], [0, 1, 2]], 3)
    assert assignment[2] in (1, 2)
    assert sorted(assignment[:2]) == [-1, 0]


def test_nothing_to_match() -> None:
    assert matching([], 0) == []
    assert matching([[], []], 2) == [-1, -1]


def test_initial_assignment_is_extended_not_dropped() -> None:
    edges = [[0, 1], [0, 1], [1, 2]]
    assert matching(edges, 3, [1]) == [1, 0, 2]
    assert matching([[0, 1], [0]], 2, [0]) == [1, 0]


def test_augment_leaves_closed_variables_alone_and_tells_what_it_reached() -> None:
    edges = [[0, 1], [0, 2], [0]]
    assignment = [0, -1, -1]
    owner = inverse(assignment, 3)
    free, reached = augment(edges, [1, 2], assignment, owner, [False, True, True])
    assert (free, reached) == ([1, 2], [0])
    assert assignment == [0, -1, -1]
    free, reached = augment(edges, [1, 2], assignment, owner)
    assert (free, reached) == ([], [])
    assert assignment == [1, 2, 0]


def test_long_path_needs_no_recursion() -> None:
    n = 50_000
    assert matching([[i, i + 1] for i in range(n - 1)] + [[0]], n) == [*range(1, n), 0]


def test_decomposition_of_a_literal_graph() -> None:
    edges = [[0], [0], [0, 1, 3], [1], [1, 2, 3, 4]]
    parts = dulmage_mendelsohn(edges, 5)
    assert (parts.over_equations, parts.over_variables) == ([0, 1], [0])
    assert (parts.under_equations, parts.under_variables) == ([4], [2, 4])
    assert (parts.well_equations, parts.well_variables) == ([2, 3], [1, 3])


def test_smallest_conflict_of_a_literal_graph() -> None:
    # 0-1-2: three equations for two variables; 3, 4 both of variable 2, with 5 beside them; nothing for 4 and 5.
    edges = [[0, 1], [0], [1], [2], [2], [2, 3, 4, 5]]
    too_many, too_few = conflicts(edges, 6, matching(edges, 6))
    assert too_many == Conflict([3, 4], [2], 1)
    assert too_few is not None and (too_few.columns, too_few.others) == ([5], 1)
    assert len(too_few.rows) == 2 and set(too_few.rows) < {3, 4, 5}
    assert conflicts([[0, 1], [1]], 2, [0, 1]) == (None, None)
    assert conflicts([[]], 1, [-1]) == (Conflict([0], [], 0), Conflict([0], [], 0))


@given(graphs)
def test_a_conflict_has_one_equation_more_than_variables_and_none_to_spare(
    graph: tuple[int, list[list[int]]],
) -> None:
    n, edges = graph
    too_many, too_few = conflicts(edges, n, matching(edges, n))
    deficiency = len(edges) - size(edges, n)
    for found, lists, missing in (
        (too_many, edges, deficiency),
        (too_few, transpose(edges, n), n - size(edges, n)),
    ):
        if found is None:
            assert missing == 0
            continue
        assert found.others == missing - 1
        assert len(found.rows) == len(found.columns) + 1
        assert {c for row in found.rows for c in lists[row]} == set(found.columns)
        width = max(len(edges), n)
        for left_out in found.rows:
            others = [lists[row] for row in found.rows if row != left_out]
            assert size(others, width) == len(others)


@given(graphs)
def test_matching_is_of_maximum_size(graph: tuple[int, list[list[int]]]) -> None:
    n, edges = graph
    assignment = matching(edges, n)
    assert_matching(edges, assignment)
    assert sum(v >= 0 for v in assignment) == size(edges, n)


@given(graphs, st.integers(0, 12))
def test_extension_keeps_equations_matched(graph: tuple[int, list[list[int]]], first: int) -> None:
    n, edges = graph
    begun = matching(edges[:first], n)
    assignment = matching(edges, n, begun)
    assert_matching(edges, assignment)
    assert sum(v >= 0 for v in assignment) == size(edges, n)
    assert all(assignment[e] >= 0 for e, v in enumerate(begun) if v >= 0)


@given(graphs)
def test_parts_are_what_they_claim(graph: tuple[int, list[list[int]]]) -> None:
    n, edges = graph
    parts = dulmage_mendelsohn(edges, n)
    equations = parts.over_equations + parts.under_equations + parts.well_equations
    variables = parts.over_variables + parts.under_variables + parts.well_variables
    assert sorted(equations) == list(range(len(edges)))
    assert sorted(variables) == list(range(n))
    assert len(parts.well_equations) == len(parts.well_variables)
    deficiency = len(edges) - size(edges, n)
    assert len(parts.over_equations) - len(parts.over_variables) == deficiency
    assert len(parts.under_variables) - len(parts.under_equations) == n - size(edges, n)
    assert all(v in parts.over_variables for e in parts.over_equations for v in edges[e])
    columns = transpose(edges, n)
    assert all(e in parts.under_equations for v in parts.under_variables for e in columns[v])
