"""Block lower triangular form: the order in which equations can be solved, and the loops among them.

Tarjan (1972), SIAM J. Comput. 1, 146-160; Duff and Reid (1978), ACM Trans. Math. Softw. 4, 137-147.
"""

from __future__ import annotations

from collections.abc import Sequence

from arthur_acausal.graph.matching import Edges


def strongly_connected(successors: Edges) -> list[list[int]]:
    """Return the strongly connected components of a directed graph, successors before their predecessors.

    ``successors[node]`` lists the nodes that ``node`` depends on. The nodes of a component are in ascending
    order.
    """
    n = len(successors)
    number = [0] * n  # order of discovery from 1; 0: not yet; n + 1: its component is complete
    low = [0] * n  # the smallest number that is known to be reachable within the component
    pending: list[int] = []  # discovered nodes without a complete component
    components: list[list[int]] = []
    discovered = 0
    for start in range(n):
        if number[start]:
            continue
        discovered += 1
        number[start] = low[start] = discovered
        pending.append(start)
        path = [start]
        scans = [iter(successors[start])]
        while path:
            node = path[-1]
            for successor in scans[-1]:
                if not number[successor]:
                    discovered += 1
                    number[successor] = low[successor] = discovered
                    pending.append(successor)
                    path.append(successor)
                    scans.append(iter(successors[successor]))
                    break
                if number[successor] < low[node]:
                    low[node] = number[successor]
            else:
                path.pop()
                scans.pop()
                if path and low[node] < low[path[-1]]:
                    low[path[-1]] = low[node]
                if low[node] == number[node]:
                    components.append(_pop_component(pending, node, number))
    return components


def _pop_component(pending: list[int], root: int, number: list[int]) -> list[int]:
    """Take the nodes from ``root`` on off the stack and mark them complete."""
    component = []
    while True:
        node = pending.pop()
        number[node] = len(number) + 1
        component.append(node)
        if node == root:
            component.sort()
            return component


def blt(edges: Edges, assignment: Sequence[int]) -> list[list[int]]:
    """Return the blocks of equations in solution order: a block needs only variables of the blocks before it.

    Each equation determines the variable it is assigned to. Variables that no equation is assigned to are
    known. Equations without a variable (-1) are in no block.
    """
    matched = [equation for equation, variable in enumerate(assignment) if variable >= 0]
    position = {assignment[equation]: index for index, equation in enumerate(matched)}
    successors = [
        [position[variable] for variable in edges[equation] if variable in position] for equation in matched
    ]
    return [[matched[index] for index in block] for block in strongly_connected(successors)]
