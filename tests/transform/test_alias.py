"""Alias elimination: equal, opposite and zero variables, chains of derivatives, and what says nothing new."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from arthur_acausal import (
    Component,
    Equations,
    Real,
    StructureError,
    connect,
    der,
    parameter,
    real_input,
    translate,
    variable,
)
from arthur_acausal.flatten.flatten import flatten
from arthur_acausal.transform.alias import Aliases, eliminate_aliases
from arthur_acausal.transform.linear import LinearAnalysis
from tests.circuit import Ground, Pin, Resistor, Voltage

Law = Callable[[Any], Iterator[Any]]


def model(law: Law) -> Component:
    """A component whose equations the test gives."""

    class Given(Component):
        a: Real = variable("1", start=0.5)
        b: Real = variable("1")
        c: Real = variable("1")
        d: Real = variable("1")
        v: Real = variable("1/s")
        w: Real = variable("1/s")
        u: Real = real_input("1", default=0.0)
        k: Real = parameter("1", default=1.0)
        T: Real = parameter("s", default=1.0)

        def equations(self) -> Equations:
            yield from law(self)

    return Given()


def aliases(law: Law, count: int = 6) -> tuple[dict[str, tuple[str, int]], Aliases]:
    """Path -> (path of the root, sign) for a law of six equations; the others are filled up by x == 1."""

    def filled(s: Any) -> Iterator[Any]:
        given = list(law(s))
        yield from given
        for _ in range(count - len(given)):
            yield s.a**2 == 1  # no alias

    flat = flatten(model(filled))
    found = eliminate_aliases(flat, LinearAnalysis())
    paths = [d.path for d in flat.variables]
    return {p: (paths[r], s) for p, r, s in zip(paths, found.root, found.sign, strict=True)}, found


# equations -> pairs (x, y, sign) with x = sign y, and zeros
SHAPES: list[tuple[str, Law, list[tuple[str, str, int]], set[str]]] = [
    ("equal", lambda s: iter([s.a == s.b]), [("a", "b", 1)], set()),
    ("opposite", lambda s: iter([s.a == -s.b]), [("a", "b", -1)], set()),
    ("sum", lambda s: iter([s.a + s.b == 0]), [("a", "b", -1)], set()),
    ("difference", lambda s: iter([0 == s.a - s.b]), [("a", "b", 1)], set()),
    ("scaled alike", lambda s: iter([3 * s.a == 3 * s.b]), [("a", "b", 1)], set()),
    ("scaled, opposite", lambda s: iter([-2 * s.a - 2 * s.b == 0]), [("a", "b", -1)], set()),
    ("cancelling", lambda s: iter([s.a + s.c - s.c == s.b]), [("a", "b", 1)], set()),
    ("zero", lambda s: iter([s.a == 0]), [], {"a"}),
    ("zero times a number", lambda s: iter([5 * s.a == 0]), [], {"a"}),
    ("twice itself", lambda s: iter([s.a == 2 * s.a]), [], {"a"}),
    (
        "chain",
        lambda s: iter([s.a == -s.b, s.b == -s.c, s.c == -s.d]),
        [("a", "b", -1), ("a", "c", 1), ("a", "d", -1)],
        set(),
    ),
    ("zero by contradiction", lambda s: iter([s.a == s.b, s.b == -s.a]), [("a", "b", 1)], {"a", "b"}),
    (
        "zero through a chain",
        lambda s: iter([s.a == s.b, s.c == s.b, s.c == 0]),
        [("a", "c", 1)],
        {"a", "b", "c"},
    ),
    ("input", lambda s: iter([s.a == s.u]), [("a", "u", 1)], set()),
    ("derivatives of one", lambda s: iter([s.v == der(s.a), s.w == der(s.a)]), [("v", "w", 1)], set()),
    (
        "of opposite ones",
        lambda s: iter([s.a == -s.b, s.v == der(s.a), s.w == der(s.b)]),
        [("a", "b", -1), ("v", "w", -1)],
        set(),
    ),
]


@pytest.mark.parametrize(("law", "pairs", "zeros"), [s[1:] for s in SHAPES], ids=[s[0] for s in SHAPES])
def test_shapes(law: Law, pairs: list[tuple[str, str, int]], zeros: set[str]) -> None:
    found, result = aliases(law)
    for x, y, sign in pairs:
        assert found[x][0] == found[y][0]
        assert found[x][1] * found[y][1] == sign
    names = list(found)
    assert {p for p in found if names.index(found[p][0]) in result.zero} == zeros
    together = {x for pair in pairs for x in pair[:2]} | zeros
    assert all(found[p] == (p, 1) for p in found if p not in together), "nothing else was joined"


NO_ALIAS: list[tuple[str, Law]] = [
    ("parameter factor", lambda s: iter([s.a == s.k * s.b])),
    ("number factor", lambda s: iter([s.a == 2 * s.b])),
    ("offset", lambda s: iter([s.a == s.b + 1])),
    ("parameter offset", lambda s: iter([s.a == s.b + s.k])),
    ("square", lambda s: iter([s.a**2 == s.b**2])),
    ("absolute value", lambda s: iter([(s.a**2) ** 0.5 == s.b])),
    ("three of them", lambda s: iter([s.a + s.b + s.c == 0])),
    ("derivative of zero", lambda s: iter([der(s.a) == 0])),
]


@pytest.mark.parametrize("law", [n[1] for n in NO_ALIAS], ids=[n[0] for n in NO_ALIAS])
def test_what_is_no_alias(law: Law) -> None:
    found, result = aliases(law)
    assert all(found[p] == (p, 1) for p in found)
    assert not result.zero
    assert result.count == 0


REDUNDANT: list[tuple[str, Law]] = [
    ("said twice", lambda s: iter([s.a == s.b, s.b == s.a, s.c == 1, s.d == 1])),
    ("around a loop", lambda s: iter([s.a == s.b, s.b == s.c, s.c == s.a, s.d == 1])),
    ("zero twice", lambda s: iter([s.a == 0, 2 * s.a == 0, s.c == 1, s.d == 1])),
    ("zero of an alias", lambda s: iter([s.a == 0, s.b == 0, s.a == -s.b, s.d == 1])),
    ("zero of an input", lambda s: iter([s.a == s.u, s.a == 0, s.c == 1, s.d == 1])),
]


@pytest.mark.parametrize("law", [r[1] for r in REDUNDANT], ids=[r[0] for r in REDUNDANT])
def test_what_says_nothing_new_is_named_with_what_is_then_missing(law: Law) -> None:
    def square(s: Any) -> Iterator[Any]:
        yield from law(s)
        yield s.T * s.v == 1
        yield s.T * s.w == 1

    with pytest.raises(StructureError, match="more than their unknowns") as caught:
        translate(model(square))
    assert "not determined: " in caught.value.message
    assert caught.value.message.count("test_alias.py:") >= 1


@settings(max_examples=40)
@given(st.lists(st.tuples(st.integers(0, 7), st.integers(0, 7), st.sampled_from([1, -1])), max_size=7))
def test_random_aliases_are_the_solution_of_the_equations(pairs: list[tuple[int, int, int]]) -> None:
    class Cells(Component):
        def equations(self) -> Equations:
            x = [getattr(self, f"x{k}") for k in range(8)]
            for i, j, sign in pairs:
                yield 2 * x[i] == 2 * sign * x[j] + 0 * x[0]
            for _ in range(8 - len(pairs)):
                yield x[0] ** 2 == 1

    names = [f"x{k}" for k in range(8)]
    cls = type("Random", (Cells,), {name: variable("1") for name in names})
    pairs = [p for p in pairs if p[0] != p[1] or p[2] < 0]  # x == x is refused at once
    flat = flatten(cls())
    found = eliminate_aliases(flat, LinearAnalysis())
    # the null space of x_i - sign x_j = 0 by linear algebra
    matrix = np.zeros((len(pairs), 8))
    for row, (i, j, sign) in enumerate(pairs):
        matrix[row, i] += 1
        matrix[row, j] -= sign
    _, singular, vectors = np.linalg.svd(np.vstack([matrix, np.zeros((8, 8))]))
    null = vectors[singular < 1e-9]
    for k in range(8):
        root, sign = found.root[k], found.sign[k]
        np.testing.assert_allclose(null[:, k], sign * null[:, root], atol=1e-9)
        assert (root in found.zero) == bool(np.allclose(null[:, k], 0.0, atol=1e-9))
    free = {r for r in found.root if r not in found.zero}
    assert len(free) == len(null), "and nothing more is joined"


def test_the_variable_that_stands_for_a_set() -> None:
    class Chosen(Component):
        a: Real = variable("1")
        b: Real = variable("1", start=2.0)
        c: Real = variable("1")
        d: Real = variable("1")
        T: Real = parameter("s", default=1.0)

        def equations(self) -> Equations:
            yield self.a == self.b
            yield self.T * der(self.c) == -self.c
            yield self.c == self.d
            yield self.b == self.d + 1

    flat = flatten(Chosen())
    found = eliminate_aliases(flat, LinearAnalysis())
    paths = [flat.variables[r].path for r in found.root]
    assert paths == ["b", "b", "c", "c"], "the one with a start value; the one that is differentiated"


def test_the_keenest_to_be_a_state_stands_for_its_set() -> None:
    class Wanted(Component):
        a: Real = variable("1", start=2.0, state_select="avoid")
        b: Real = variable("1", state_select="prefer")
        c: Real = variable("1", start=1.0)
        T: Real = parameter("s", default=1.0)

        def equations(self) -> Equations:
            yield self.a == self.b
            yield self.T * der(self.a) == -self.a
            yield self.c == -self.b

    flat = flatten(Wanted())
    found = eliminate_aliases(flat, LinearAnalysis())
    assert [flat.variables[r].path for r in found.root] == ["b", "b", "b"]
    assert found.sign == [1, 1, -1]
    assert found.count == 2


def test_a_loop_of_connections_through_a_component_is_named() -> None:
    class Shunt(Component):
        p = Pin()
        n = Pin()
        idle = Ground()

        def equations(self) -> Equations:
            yield connect(self.p, self.n)

    class Loop(Component):
        shunt = Shunt()
        ground = Ground()

        def equations(self) -> Equations:
            yield connect(self.shunt.p, self.ground.p)
            yield connect(self.shunt.n, self.ground.p)  # around

    with pytest.raises(StructureError, match="connected already") as caught:
        translate(Loop())
    assert "shunt.p.v" in caught.value.message
    assert "shunt.n.v" in caught.value.message
    assert caught.value.where.startswith("test_alias.py:")


def test_two_grounds_leave_a_current_undetermined() -> None:
    class Twice(Component):
        source = Voltage()
        load = Resistor()
        ground = Ground()
        other = Ground()

        def equations(self) -> Equations:
            yield connect(self.source.p, self.load.p)
            yield connect(self.source.n, self.load.n)
            yield connect(self.source.n, self.ground.p)
            yield connect(self.source.n, self.other.p)

    with pytest.raises(StructureError, match=r"ground\.p\.i.*other\.p\.i|other\.p\.i.*ground\.p\.i"):
        translate(Twice())
