"""Index reduction on literal systems, and the number of differentiations against the signature method."""

from __future__ import annotations

import itertools

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from arthur_acausal.graph import (
    Conflict,
    StructurallySingular,
    chains,
    matching,
    pantelides,
    select_dummies,
    select_states,
)

# Pendulum: x, y, u, v, T = 0..4; x', y', u', v' = 5..8
#   x' = u, y' = v, u' = T x, v' = T y - g, x^2 + y^2 = L^2
PENDULUM = [[5, 2], [6, 3], [7, 4, 0], [8, 4, 1], [0, 1]]
PENDULUM_DERIVATIVE = [5, 6, 7, 8, -1, -1, -1, -1, -1]


def order(derivative: list[int]) -> list[int]:
    """Return for each element of a chain its place in it."""
    result = [0] * len(derivative)
    for index, successor in enumerate(derivative):
        if successor > index:
            result[successor] = result[index] + 1
    return result


def test_pendulum_has_index_three() -> None:
    result = pantelides(PENDULUM, PENDULUM_DERIVATIVE)
    # as in Pantelides (1988), example 2: the constraint twice, x' = u and y' = v once
    assert result.equation_derivative == [6, 7, -1, -1, 5, 8, -1, -1, -1]
    assert result.edges[5] == [5, 6, 0, 1]
    assert result.derivative[5:7] == [9, 10]
    assert set(result.edges[6]) == {9, 7, 5, 2}
    highest = [e for e, successor in enumerate(result.equation_derivative) if successor < 0]
    assert sorted(result.assignment[e] for e in highest) == [4, 7, 8, 9, 10]
    assert all(result.assignment[e] == -1 for e in range(9) if e not in highest)


def test_pendulum_dummy_derivatives() -> None:
    result = pantelides(PENDULUM, PENDULUM_DERIVATIVE)
    selection = select_states(result.edges, result.derivative, result.equation_derivative, [2] * 9)
    assert len(selection.states) == 2  # one degree of freedom
    # x wanted, u too: y and v become algebraic, and so does the derivative of der(y)
    priority = [3, 2, 3, 2, 2, 2, 2, 2, 2]
    selection = select_states(result.edges, result.derivative, result.equation_derivative, priority)
    assert selection.states == [0, 2]
    assert selection.dummies == [6, 8, 9, 10]
    # the other way round, near the horizontal, where only y will do
    priority = [2, 3, 2, 3, 2, 2, 2, 2, 2]
    selection = select_states(result.edges, result.derivative, result.equation_derivative, priority)
    assert selection.states == [1, 3]
    assert selection.dummies == [5, 7, 9, 10]


def test_index_one_needs_no_differentiation() -> None:
    edges = [[1, 0, 2], [2, 0]]
    result = pantelides(edges, [1, -1, -1])
    assert result.edges == edges
    assert result.equation_derivative == [-1, -1]
    assert result.assignment == [1, 2]


def test_two_inertias_rigidly_coupled() -> None:
    # w1, w2, tau, w1', w2': J1 w1' = tau, J2 w2' = -tau, w1 = w2
    result = pantelides([[3, 2], [4, 2], [0, 1]], [3, 4, -1, -1, -1])
    assert result.equation_derivative == [-1, -1, 3, -1]
    assert result.edges[3] == [3, 4, 0, 1]
    assert select_states(
        result.edges, result.derivative, result.equation_derivative, [2, 3, 2, 2, 2]
    ).states == [1]
    assert select_states(
        result.edges, result.derivative, result.equation_derivative, [3, 2, 2, 2, 2]
    ).states == [0]


def test_derivative_of_an_algebraic_variable_is_appended() -> None:
    # y = u(t) [known], x' = y', where y' has no equation: y, y', x, x'
    result = pantelides([[0], [3, 1]], [1, -1, 3, -1])
    assert result.equation_derivative == [2, -1, -1]
    assert result.edges[2] == [1, 0]


def refused(edges: list[list[int]], derivative: list[int]) -> StructurallySingular:
    with pytest.raises(StructurallySingular) as caught:
        pantelides(edges, derivative)
    return caught.value


def test_too_many_equations_for_a_variable() -> None:
    singular = refused([[0], [0], [1, 2]], [-1, -1, -1])
    assert singular.too_many == Conflict([0, 1], [0], 0)
    assert singular.too_few == Conflict([1, 2], [2], 0)


def test_singular_although_derivatives_would_match() -> None:
    # x' = 1, x = 0 and nothing for y: x and x' are one unknown
    singular = refused([[1], [0]], [1, -1, -1])
    assert singular.too_many == Conflict([0, 1], [0], 0)
    assert singular.too_few == Conflict([2], [], 0)


def test_too_few_equations() -> None:
    singular = refused([[0, 2]], [1, -1, -1])  # one equation of x and y
    assert singular.too_many is None
    assert singular.too_few == Conflict([0, 2], [0], 0)


def test_more_equations_than_variables() -> None:
    singular = refused([[2], [0], [1]], [1, -1, -1])  # one of y, and both of x
    assert singular.too_many == Conflict([1, 2], [0], 0)
    assert singular.too_few is None


def test_long_chain_of_constraints() -> None:
    # x[i] = x[i + 1] for all, and J[i] x[i]' = torque[i] - torque[i + 1]
    n = 2000
    inertia = [[n + i, 2 * n + i - 1, 2 * n + i] for i in range(n)]
    inertia[0].remove(2 * n - 1)
    inertia[-1].remove(3 * n - 1)
    rigid = [[i, i + 1] for i in range(n - 1)]
    result = pantelides(inertia + rigid, [*range(n, 2 * n)] + [-1] * (2 * n - 1))
    assert len(result.edges) == 3 * n - 2
    selection = select_states(result.edges, result.derivative, result.equation_derivative, [2] * n)
    assert len(selection.states) == 1


def smallest_offsets(sigma: list[list[int | None]]) -> list[int]:
    """Return how often each equation is differentiated: Pryce (2001), BIT 41, 364-394, algorithm 3.1."""
    n = len(sigma)
    best = max(
        (p for p in itertools.permutations(range(n)) if all(sigma[i][p[i]] is not None for i in range(n))),
        key=lambda p: sum(sigma[i][p[i]] or 0 for i in range(n)),
    )
    c = [0] * n
    while True:
        d = [max((s + c[i] for i in range(n) if (s := sigma[i][j]) is not None), default=0) for j in range(n)]
        new = [d[best[i]] - (sigma[i][best[i]] or 0) for i in range(n)]
        if new == c:
            return c
        c = new


@settings(max_examples=200)
@given(
    st.integers(1, 5).flatmap(
        lambda n: st.lists(
            st.lists(st.sampled_from([None, None, 0, 0, 1, 2]), min_size=n, max_size=n),
            min_size=n,
            max_size=n,
        )
    )
)
def test_differentiates_as_often_as_the_signature_matrix_says(sigma: list[list[int | None]]) -> None:
    n = len(sigma)
    highest = [max((s for row in sigma if (s := row[j]) is not None), default=0) for j in range(n)]
    first = list(itertools.accumulate((h + 1 for h in highest), initial=0))
    derivative = [v + 1 if v + 1 not in first else -1 for v in range(first[-1])]
    edges = [[first[j] + s for j in range(n) if (s := row[j]) is not None] for row in sigma]
    merged = [[j for j in range(n) if row[j] is not None] for row in sigma]
    if -1 in matching(merged, n):
        with pytest.raises(StructurallySingular):
            pantelides(edges, derivative)
        return
    result = pantelides(edges, derivative)
    counts = [0] * n
    for equation in range(n):
        successor = result.equation_derivative[equation]
        while successor >= 0:
            counts[equation] += 1
            successor = result.equation_derivative[successor]
    assert counts == smallest_offsets(sigma)
    remaining = [e for e, successor in enumerate(result.equation_derivative) if successor < 0]
    taken = [result.assignment[e] for e in remaining]
    assert len(set(taken)) == n
    assert all(
        v in result.edges[e] and result.derivative[v] < 0 for e, v in zip(remaining, taken, strict=True)
    )
    assert sorted({chains(result.derivative)[v] for v in taken}) == sorted(first[:-1])
    selection = select_states(result.edges, result.derivative, result.equation_derivative, [2] * first[-1])
    degrees = sum(result.derivative[v] >= 0 for v in range(len(result.derivative)))
    assert len(selection.dummies) == sum(counts)
    assert len(selection.states) == degrees - sum(counts)


def test_dummies_of_lowest_priority() -> None:
    assert select_dummies([[0, 1, 2], [1, 2]], 3, [4, 2, 0]) == [1, 2]
    assert select_dummies([[0, 1], [2]], 3, [2, 0, 4]) == [1, 2]
    with pytest.raises(StructurallySingular) as caught:
        select_dummies([[0], [0]], 2, [2, 2])
    assert (caught.value.too_many, caught.value.too_few) == (Conflict([0, 1], [0], 0), None)


def test_states_that_cannot_be_chosen_are_named_by_their_numbers() -> None:
    # x + y = 0 and x - y = 0 say that both are 0; without the entries of y one derivative cannot serve both.
    edges, derivative = [[0], [0], [1, 0], [1, 0]], [1, -1, 3, -1]
    with pytest.raises(StructurallySingular) as caught:
        select_states(edges, derivative, [2, 3, -1, -1], [2, 2, 2, 2])
    assert caught.value.too_many == Conflict([2, 3], [1], 0)


def test_numbers_of_variables_mean_nothing() -> None:
    # variable 0 is the derivative of 1, and that the derivative of 2
    assert chains([-1, 0, 1, -1]) == [2, 2, 2, 3]
    # x = 0 for x = 1, x' = 0: one differentiation determines x', whatever its number
    result = pantelides([[1]], [-1, 0])
    assert result.edges == [[1], [0, 1]]
    assert (result.derivative, result.equation_derivative, result.assignment) == ([-1, 0], [1, -1], [-1, 0])
    assert select_states(result.edges, result.derivative, result.equation_derivative, [2, 2]).dummies == [0]


def test_a_highest_derivative_may_have_the_lowest_number() -> None:
    # x'' = 0, x' = 1, x = 2; x = u differentiated twice; x, whose derivative is gladly a dummy, is no candidate early
    selection = select_states([[2], [1], [1, 0]], [-1, 0, 1], [1, 2, -1], [2, 3, 0])
    assert (selection.dummies, selection.states) == ([0, 1], [])


def test_a_constraint_of_index_three_by_hand() -> None:
    # x' = v, v' = F, x = 0 with x, x', v, v', F = 0 .. 4: x = 0 and x' = v are differentiated, twice and once.
    result = pantelides([[1, 2], [3, 4], [0]], [1, -1, 3, -1, -1])
    assert result.derivative == [1, 5, 3, -1, -1, -1]
    assert result.equation_derivative == [4, -1, 3, 5, -1, -1]
    assert [sorted(e) for e in result.edges[3:]] == [[0, 1], [1, 2, 3, 5], [0, 1, 5]]
    assert result.assignment == [-1, 4, -1, -1, 3, 5]
    selection = select_states(result.edges, result.derivative, result.equation_derivative, [2] * 6)
    assert (selection.dummies, selection.states) == ([1, 3, 5], [])
