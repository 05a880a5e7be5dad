"""A small layered layout of an undirected graph: layers by distance, order by barycentres, heights by least squares.

Sugiyama, Tagawa and Toda (1981), IEEE Trans. Syst. Man Cybern. 11, 109-125. Layers are the distances from one end of
the graph, so that no edge spans more than one layer and none has to be led around boxes.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

SWEEPS = 12
GAP = 0.35  # between boxes above each other, in the unit of the heights

Edge = tuple[int, int]


def layers(n: int, edges: Sequence[Edge]) -> list[list[int]]:
    """Return the nodes by layers, the parts of an unconnected graph below each other in the same layers."""
    near = neighbours(n, edges)
    found: list[list[int]] = []
    seen: set[int] = set()
    for start in range(n):
        if start in seen:
            continue
        distance = _distances(_end(start, near), near)
        seen |= distance.keys()
        own: list[list[int]] = [[] for _ in range(max(distance.values()) + 1)]
        for node, d in distance.items():
            own[d].append(node)
        own = _ordered(own, near)
        for k, layer in enumerate(own):
            if k == len(found):
                found.append([])
            found[k] += layer
    return found


def neighbours(n: int, edges: Sequence[Edge]) -> list[list[int]]:
    """Return each node's neighbours, itself left out."""
    near: list[list[int]] = [[] for _ in range(n)]
    for a, b in edges:
        if a != b:
            near[a].append(b)
            near[b].append(a)
    return near


def _distances(start: int, near: list[list[int]]) -> dict[int, int]:
    distance = {start: 0}
    queue = [start]
    for node in queue:
        for other in near[node]:
            if other not in distance:
                distance[other] = distance[node] + 1
                queue.append(other)
    return distance


def _end(start: int, near: list[list[int]]) -> int:
    """Return a node at one end of the part of the graph that holds ``start``: one with the longest distances."""
    reached = _distances(start, near)
    spans = {node: max(_distances(node, near).values()) for node in reached}
    longest = max(spans.values())
    return min(node for node in reached if spans[node] == longest)


def crossings(upper: list[int], lower: list[int], near: list[list[int]]) -> int:
    """Count the crossings of the edges between two neighbouring layers."""
    place = {node: k for k, node in enumerate(lower)}
    ends = [sorted(place[v] for v in near[u] if v in place) for u in upper]
    total = 0
    for i, first in enumerate(ends):
        for second in ends[i + 1 :]:
            total += sum(a > b for a in first for b in second)
    return total


def _ordered(own: list[list[int]], near: list[list[int]]) -> list[list[int]]:
    """Reorder each layer by the mean place of its neighbours, to and fro; return the order with fewest crossings."""

    def total(order: list[list[int]]) -> int:
        return sum(crossings(a, b, near) for a, b in pairwise(order))

    best, least = [list(layer) for layer in own], total(own)
    now = [list(layer) for layer in own]
    for sweep in range(SWEEPS):
        forward = sweep % 2 == 0
        for k in range(1, len(now)) if forward else range(len(now) - 2, -1, -1):
            fixed = {node: i for i, node in enumerate(now[k - 1 if forward else k + 1])}
            mean = {}
            for i, node in enumerate(now[k]):
                places = [fixed[v] for v in near[node] if v in fixed]
                mean[node] = sum(places) / len(places) if places else float(i)
            now[k] = sorted(now[k], key=lambda node: mean[node])
        if (count := total(now)) < least:
            best, least = [list(layer) for layer in now], count
    return best


def heights(order: list[list[int]], near: list[list[int]], sizes: Sequence[float]) -> dict[int, float]:
    """Return the vertical centre of each node, downwards: near those of its neighbours, no two boxes too close."""
    centre: dict[int, float] = {}
    for layer in order:
        top = -sum(sizes[node] + GAP for node in layer) / 2.0
        for node in layer:
            centre[node] = top + (sizes[node] + GAP) / 2.0
            top += sizes[node] + GAP
    for sweep in range(2 * SWEEPS):
        for layer in order if sweep % 2 == 0 else reversed(order):
            wanted = [
                sum(centre[v] for v in near[node]) / len(near[node]) if near[node] else centre[node]
                for node in layer
            ]
            for node, y in zip(layer, _spread(wanted, [sizes[node] for node in layer]), strict=True):
                centre[node] = y
    return centre


def _spread(wanted: Sequence[float], sizes: Sequence[float]) -> list[float]:
    """Return the places nearest to those wanted (least squares) that keep the order and the gaps.

    With the gaps taken off it is isotonic regression: pools of neighbours that get their mean.
    """
    offset = [0.0]
    for a, b in pairwise(sizes):
        offset.append(offset[-1] + (a + b) / 2.0 + GAP)
    pools: list[tuple[float, int]] = []
    for y, o in zip(wanted, offset, strict=True):
        mean, count = y - o, 1
        while pools and pools[-1][0] > mean:
            other, n = pools.pop()
            mean, count = (mean * count + other * n) / (count + n), count + n
        pools.append((mean, count))
    means = [mean for mean, count in pools for _ in range(count)]
    return [mean + o for mean, o in zip(means, offset, strict=True)]
