"""Tearing of literal loops, and what must hold for any."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from arthur_acausal.graph import matching, tear


def test_explicit_chain_needs_no_tearing() -> None:
    edges = [[0, 1], [1, 2], [2]]
    result = tear([0, 1, 2], [0, 1, 2], edges, edges)
    assert result.sequence == [(2, 2), (1, 1), (0, 0)]
    assert result.torn_variables == result.residual_equations == []


def test_ring_is_cut_once() -> None:
    edges = [[i, (i + 1) % 5] for i in range(5)]
    result = tear(range(5), range(5), edges, edges)
    assert len(result.torn_variables) == len(result.residual_equations) == 1
    assert len(result.sequence) == 4


def test_ladder_of_resistors_is_cut_once() -> None:
    # v[k] - v[k+1] = R i[k]; i[k-1] = i[k] + G v[k]: unknown v[1..n], i[0..n-1], the source v[0] known
    n = 50
    voltage, current = list(range(n + 1)), list(range(n + 1, 2 * n + 2))
    edges = [[voltage[k], voltage[k + 1], current[k]] for k in range(n)]
    edges += [[current[k - 1], voltage[k], current[k]] for k in range(1, n)] + [[current[n - 1], voltage[n]]]
    result = tear(range(2 * n), voltage[1:] + current[:-1], edges, edges)
    assert len(result.torn_variables) < n / 4


def test_variables_that_cannot_be_solved_for_are_torn() -> None:
    # 0 = f(x, y), y = g(x): x is in no equation explicitly
    result = tear([7, 8], [3, 4], {7: [3, 4], 8: [4, 3]}, {7: [], 8: [4]})  # type: ignore[arg-type]
    assert result.sequence == [(8, 4)]
    assert (result.torn_variables, result.residual_equations) == ([3], [7])


def test_preferred_variable_is_torn() -> None:
    edges = [[0, 1], [1, 2], [2, 0]]
    for wanted in range(3):
        preference = [int(v == wanted) for v in range(3)]
        assert tear(range(3), range(3), edges, edges, preference).torn_variables == [wanted]


def test_the_choice_of_a_literal_block() -> None:
    # Variable 2 is in four equations, each other one in two: it is torn; the rest follows in order.
    edges = [[0, 2], [0, 1, 2], [1, 2, 3], [2, 3]]
    result = tear(range(4), range(4), edges, edges)
    assert result.torn_variables == [2]
    assert result.sequence == [(0, 0), (3, 3), (1, 1)]
    assert result.residual_equations == [2]


def test_of_equals_the_one_that_makes_most_equations_explicit_is_torn() -> None:
    # each variable is in two equations; with 2 known two of them are explicit, with 0 or 1 known one
    result = tear(range(3), range(3), [[1, 2], [0, 2], [0, 1]], [{1, 2}, {0}, {1}])
    assert result.torn_variables == [2]
    assert result.sequence == [(0, 1), (1, 0)]
    assert result.residual_equations == [2]


def test_what_becomes_more_useful_on_the_way_is_torn_sooner() -> None:
    # 2 is in all three; then 0 makes the first equation explicit, and 1 does so, too: the lower number
    result = tear(range(3), range(3), [[0, 1, 2], [1, 2], [0, 2]], [{0, 1, 2}, {2}, set()])
    assert result.torn_variables == [2, 0]
    assert result.sequence == [(0, 1)]
    assert result.residual_equations == [1, 2]


def test_known_variables_and_repeated_edges_do_not_count() -> None:
    result = tear([0], [1], [[0, 1, 1, 2]], [[0, 1, 2]])
    assert result.sequence == [(0, 1)]


@given(
    st.integers(1, 12).flatmap(
        lambda n: st.lists(
            st.lists(st.tuples(st.integers(0, n - 1), st.booleans()), max_size=4), min_size=n, max_size=n
        )
    )
)
def test_sequence_is_explicit_and_nothing_is_lost(rows: list[list[tuple[int, bool]]]) -> None:
    n = len(rows)
    edges = [[v for v, _ in row] for row in rows]
    solvable = [[v for v, explicit in row if explicit] for row in rows]
    result = tear(range(n), range(n), edges, solvable)
    known = set(result.torn_variables)
    for equation, variable in result.sequence:
        assert variable in solvable[equation]
        assert variable not in known
        known.add(variable)
        assert known.issuperset(edges[equation])
    assert known == set(range(n))
    assert len(result.torn_variables) == len(result.residual_equations)
    assert sorted([e for e, _ in result.sequence] + result.residual_equations) == list(range(n))
    assert result == tear(range(n), range(n), edges, solvable)
    if -1 not in matching(edges, n):
        assert len(result.sequence) + len(result.torn_variables) == n
