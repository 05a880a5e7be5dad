"""Strong components and solution order, on literal graphs and against SciPy."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from arthur_acausal.graph import blt, matching, strongly_connected

digraphs = st.integers(1, 15).flatmap(
    lambda n: st.lists(st.lists(st.integers(0, n - 1), max_size=4), min_size=n, max_size=n)
)


def test_components_of_a_literal_graph() -> None:
    # Tarjan's order: what is depended on comes first
    assert strongly_connected([[1], [2], [0, 3], [4], [3], [2]]) == [[3, 4], [0, 1, 2], [5]]
    assert strongly_connected([]) == []
    assert strongly_connected([[0]]) == [[0]]


def test_blocks_come_in_solution_order() -> None:
    # x0 = f(x1), x1 + x2 = 0 with x1 - x2 = x3, x3 = 1
    edges = [[0, 1], [1, 2], [1, 2, 3], [3]]
    assert blt(edges, [0, 1, 2, 3]) == [[3], [1, 2], [0]]


def test_unassigned_variables_are_known_and_unassigned_equations_absent() -> None:
    assert blt([[0, 1], [1, 2], [2]], [0, 1, -1]) == [[1], [0]]


def test_deep_chain_needs_no_recursion() -> None:
    n = 50_000
    assert strongly_connected([[i + 1] for i in range(n - 1)] + [[]]) == [[i] for i in reversed(range(n))]
    assert strongly_connected([[(i + 1) % n] for i in range(n)]) == [list(range(n))]


@given(digraphs)
def test_components_agree_with_scipy(successors: list[list[int]]) -> None:
    adjacency = np.zeros((len(successors), len(successors)))
    for node, targets in enumerate(successors):
        adjacency[node, targets] = 1.0
    _, label = connected_components(csr_array(adjacency), directed=True, connection="strong")
    components = strongly_connected(successors)
    assert sorted(components) == sorted(np.flatnonzero(label == k).tolist() for k in set(label.tolist()))
    place = {node: index for index, component in enumerate(components) for node in component}
    assert all(place[j] <= place[i] for i, targets in enumerate(successors) for j in targets)


@given(digraphs)
def test_blocks_are_lower_triangular(edges: list[list[int]]) -> None:
    assignment = matching(edges, len(edges))
    known = {v for v in range(len(edges)) if v not in assignment}
    for block in blt(edges, assignment):
        known.update(assignment[e] for e in block)
        assert all(v in known for e in block for v in edges[e])
    assert sorted(e for block in blt(edges, assignment) for e in block) == [
        e for e, v in enumerate(assignment) if v >= 0
    ]
