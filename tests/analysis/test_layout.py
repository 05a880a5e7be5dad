"""The layered layout, on literal graphs."""

from __future__ import annotations

import itertools

import pytest

from arthur_acausal.analysis.layout import GAP, crossings, heights, layers, neighbours


def test_a_chain_is_a_row() -> None:
    assert layers(4, [(2, 0), (0, 3), (3, 1)]) == [[1], [3], [0], [2]]


def test_edges_span_one_layer_at_most() -> None:
    ring = [(k, (k + 1) % 9) for k in range(9)] + [(0, 4), (2, 7)]
    order = layers(9, ring)
    column = {node: k for k, layer in enumerate(order) for node in layer}
    assert sorted(column) == list(range(9))
    assert all(abs(column[a] - column[b]) <= 1 for a, b in ring)


def test_unconnected_parts_share_the_layers() -> None:
    assert layers(4, [(0, 1), (2, 3)]) == [[0, 2], [1, 3]]
    assert layers(2, [(0, 0)]) == [[0, 1]]


def test_crossings_are_counted_and_removed() -> None:
    edges = [(0, 1), (0, 2), (1, 4), (2, 3), (3, 5), (4, 6)]
    near = neighbours(7, edges)
    assert crossings([1, 2], [3, 4], near) == 1 and crossings([1, 2], [4, 3], near) == 0
    order = layers(7, edges)
    assert sum(crossings(a, b, near) for a, b in itertools.pairwise(order)) == 0


def test_boxes_keep_their_distance() -> None:
    edges = [(0, k) for k in range(1, 6)] + [(k, 6) for k in range(1, 6)]
    sizes = [0.5, 0.4, 1.2, 0.4, 0.6, 0.4, 0.5]
    order = layers(7, edges)
    centre = heights(order, neighbours(7, edges), sizes)
    for layer in order:
        for a, b in itertools.pairwise(layer):
            assert centre[b] - centre[a] >= (sizes[a] + sizes[b]) / 2.0 + GAP - 1e-12
    assert centre[0] == pytest.approx(sum(centre[k] for k in range(1, 6)) / 5.0, abs=1e-6)
