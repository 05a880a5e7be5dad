"""Signed union-find against brute force over all signs."""

from __future__ import annotations

import itertools

from hypothesis import given
from hypothesis import strategies as st

from arthur_acausal.graph import Outcome, SignedUnion, Union

unions = st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5), st.sampled_from([1, -1])), max_size=12)


def test_signs_multiply_along_a_chain() -> None:
    sets = SignedUnion(4)
    assert sets.union(0, 1, -1) is Outcome.MERGED
    assert sets.union(1, 2, -1) is Outcome.MERGED
    assert sets.union(0, 2, 1) is Outcome.KNOWN
    assert sets.union(3, 2, -1) is Outcome.MERGED
    sets.prefer(lambda i: i)
    assert [sets.find(i) for i in range(4)] == [(0, 1), (0, -1), (0, 1), (0, -1)]


def test_contradiction_means_zero() -> None:
    sets = SignedUnion(3)
    sets.union(0, 1, 1)
    assert sets.union(1, 0, -1) is Outcome.ZERO
    assert [sets.is_zero(i) for i in range(3)] == [True, True, False]
    sets.union(2, 0, -1)
    sets.prefer(lambda i: -i)
    assert sets.find(0)[0] == 2
    assert sets.is_zero(2)


def test_a_variable_that_is_its_own_negative() -> None:
    sets = SignedUnion(1)
    assert sets.union(0, 0, -1) is Outcome.ZERO


@given(unions, st.permutations(range(6)))
def test_agrees_with_brute_force(facts: list[tuple[int, int, int]], key: list[int]) -> None:
    sets = SignedUnion(6)
    outcomes = [sets.union(*fact) for fact in facts]
    for preferred in (False, True):
        if preferred:
            sets.prefer(lambda i: key[i])
        # all vectors over {-1, 0, 1} that satisfy the facts
        solutions = [
            x for x in itertools.product((-1, 0, 1), repeat=6) if all(x[i] == s * x[j] for i, j, s in facts)
        ]
        for i in range(6):
            assert sets.is_zero(i) == all(x[i] == 0 for x in solutions)
            root, sign = sets.find(i)
            assert all(x[i] == sign * x[root] for x in solutions)
        for members in sets.sets():
            assert len({sets.find(i)[0] for i in members}) == 1
            if preferred:
                assert sets.find(members[0]) == (min(members, key=lambda i: key[i]), sets.find(members[0])[1])
    assert outcomes.count(Outcome.MERGED) == 6 - len(sets.sets())


def test_long_chains_stay_short() -> None:
    n = 100_000
    sets = SignedUnion(n)
    for i in range(n - 1):
        sets.union(i, i + 1, -1)
    root, sign = sets.find(0)
    assert sign == (-1) ** root


@given(st.lists(st.tuples(st.integers(0, 7), st.integers(0, 7)), max_size=12))
def test_plain_union(pairs: list[tuple[int, int]]) -> None:
    sets = Union(8)
    label = list(range(8))
    for i, j in pairs:
        assert sets.union(i, j) == (label[i] != label[j])
        label = [label[j] if x == label[i] else x for x in label]
    assert all((sets.find(i) == sets.find(j)) == (label[i] == label[j]) for i in range(8) for j in range(8))
    assert sets.add() == len(sets) - 1 == 8
    assert [8] in sets.sets()


def test_the_lower_tree_goes_below_the_higher_one() -> None:
    plain, signed = Union(5), SignedUnion(5)
    for i, j in ((0, 1), (2, 3), (1, 3), (4, 0)):
        plain.union(i, j)
        signed.union(i, j, 1)
    # equal heights: the second root stays; 4 alone goes below 3, whichever side it stands on
    assert [plain.find(i) for i in range(5)] == [3] * 5
    assert [signed.find(i) for i in range(5)] == [(3, 1)] * 5
    plain, signed = Union(3), SignedUnion(3)
    for i, j in ((0, 1), (1, 2)):
        plain.union(i, j)
        signed.union(i, j, -1)
    assert [plain.find(i) for i in range(3)] == [1] * 3
    assert [signed.find(i) for i in range(3)] == [(1, -1), (1, 1), (1, -1)]


def test_zero_is_kept_when_sets_merge() -> None:
    for first, second in ((0, 1), (1, 0)):
        sets = SignedUnion(3)
        sets.union(0, 0, -1)
        assert sets.union(first, second, 1) is Outcome.MERGED
        assert [sets.is_zero(i) for i in range(3)] == [True, True, False]
