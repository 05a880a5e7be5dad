"""Which set of states is best for the numbers at hand, on small matrices worked out by hand and against LAPACK."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from casadi import SX
from scipy.linalg import qr

from arthur_acausal import Component, Equations, Real, der, parameter, variable
from arthur_acausal.flatten.flatten import flatten
from arthur_acausal.transform.rows import Ref
from arthur_acausal.transform.state_sets import StateSets, pivots
from arthur_acausal.transform.structured import StructuredDAE, transform
from tests.transform.test_index import Geared, Pendulum


def test_pivots_of_literal_matrices() -> None:
    order, diagonal = pivots(np.array([[3.0, 1.0, 0.0], [4.0, 0.0, 2.0]]))
    assert order == [0, 2, 1]  # lengths 5, 1, 2; then (0, 2) less its part along (3, 4)/5 has length 6/5
    np.testing.assert_allclose(diagonal, [5.0, 1.2])
    order, diagonal = pivots(np.array([[1.0, 2.0, 1.0], [2.0, 4.0, 2.0]]))
    assert order == [1, 0, 2]
    np.testing.assert_allclose(diagonal, [np.sqrt(20.0), 0.0], atol=1e-15)
    order, diagonal = pivots(np.zeros((0, 3)))
    assert (order, diagonal.tolist()) == ([0, 1, 2], [])
    order, diagonal = pivots(np.zeros((2, 3)))
    assert (order, diagonal.tolist()) == ([0, 1, 2], [0.0, 0.0])


def test_pivots_are_those_of_lapack() -> None:
    random = np.random.default_rng(3)
    for rows, columns in ((1, 4), (3, 3), (4, 7), (5, 2)):
        matrix = random.normal(size=(rows, columns))
        before = matrix.copy()
        order, diagonal = pivots(matrix)
        result: Any = qr(matrix, pivoting=True)
        _, triangle, expected = result
        assert order[: len(diagonal)] == expected.tolist()[: len(diagonal)]
        assert sorted(order) == list(range(columns))
        np.testing.assert_allclose(diagonal, np.abs(np.diag(triangle)), rtol=1e-12)
        np.testing.assert_array_equal(matrix, before, "the argument is left as it was")


# One constraint that was differentiated twice, on x'' = 10 and y'' = 11; x' = 8, y' = 9
ROD = StateSets([5], [10, 11], [(0, 0), (0, 1)], [2], [[10, 8], [11, 9]], np.ones(2))


def test_the_larger_slope_becomes_the_dummy_on_both_levels() -> None:
    assert ROD.choose(np.array([-0.8, 0.6])) == {10, 8}
    assert ROD.choose(np.array([0.6, -0.8])) == {11, 9}
    assert ROD.margin(np.array([-0.8, 0.6]), frozenset({10, 8})) == 1.0
    assert ROD.margin(np.array([-0.8, 0.6]), frozenset({11, 9})) == pytest.approx(0.75)
    assert ROD.margin(np.array([1.0, 0.0]), frozenset({11, 9})) == 0.0
    assert ROD.margin(np.array([0.0, 0.0]), frozenset({11, 9})) == 0.0
    assert ROD.margin(np.array([-0.8, 0.6]), frozenset({10})) == 0.0, "a dummy too few on the second level"


def test_a_weight_makes_a_column_a_dummy_more_gladly() -> None:
    gladly = StateSets([5], [10, 11], [(0, 0), (0, 1)], [2], [[10, 8], [11, 9]], np.array([1.0, 4.0]))
    assert gladly.choose(np.array([-0.8, 0.6])) == {11, 9}
    assert gladly.margin(np.array([-0.8, 0.6]), frozenset({10, 8})) == pytest.approx(1.0 / 3.0)


# Two constraints: the first, a + 2 b, differentiated twice; the second, b + 3 c, once, which determines c' at most.
LEVELS = StateSets(
    [6, 7],
    [10, 11, 12],
    [(0, 0), (0, 1), (1, 1), (1, 2)],
    [2, 1],
    [[10, 20], [11, 21], [12]],
    np.ones(3),
)
SLOPES = np.array([1.0, 2.0, 1.0, 3.0])


def test_levels_are_chosen_one_after_the_other() -> None:
    # rows over their largest entries: (1/2, 1, 0) and (0, 1/3, 1)
    assert LEVELS.choose(SLOPES) == {11, 12, 21}
    assert LEVELS.margin(SLOPES, frozenset({11, 12, 21})) == pytest.approx(1.0)
    assert LEVELS.margin(SLOPES, frozenset({10, 12, 20})) == pytest.approx(0.5)
    assert LEVELS.margin(SLOPES, frozenset({11, 12, 20})) == pytest.approx(0.5), "the second level is worse"
    assert LEVELS.margin(SLOPES, frozenset({10, 12, 21})) == pytest.approx(0.5), "the first level is worse"
    assert LEVELS.margin(SLOPES, frozenset({10, 11, 21})) == pytest.approx(1.0 / 6.0)


def names(dae: StructuredDAE, chains: list[list[int]]) -> list[list[str]]:
    return [[dae.nodes.name(n) for n in chain] for chain in chains]


def test_sets_of_the_pendulum() -> None:
    dae = transform(flatten(Pendulum(L=2.0)))
    sets, entries = dae.reduced.sets, dae.reduced.entries
    assert sets is not None
    assert sets.levels == [2]
    assert dae.reduced.rows[sets.rows[0]].text.count("der(") == 2
    assert names(dae, sets.chains) == [["der(vx)", "vx"], ["der(vy)", "vy"]]
    assert sets.columns == [chain[0] for chain in sets.chains]
    assert sets.weight.tolist() == [1.0, 1.0]
    values = {"x": 1.2, "y": -1.6}

    def look(ref: Ref) -> SX:
        return SX(values.get(dae.nodes.name(ref.number), np.nan))

    numbers = [float(dae.evaluator(row, look, entry)) for row, entry in entries]
    assert numbers == [2.4, -3.2], "d(x^2 + y^2)'' / dx'', dy''"
    assert {dae.nodes.name(n) for n in sets.choose(np.array(numbers))} == {"der(vy)", "vy"}


class Weighed(Component):
    """The pendulum, its speeds declared first, so that a derivative has the lowest number."""

    g: Real = parameter("m/s^2", default=9.81)
    L: Real = parameter("m", default=1.0)
    v: Real = variable("m/s", nominal=10.0, state_select="prefer")
    w: Real = variable("m/s", state_select="never")
    x: Real = variable("m")
    y: Real = variable("m")
    F: Real = variable("1/s^2")

    def equations(self) -> Equations:
        yield der(self.x) == self.v
        yield der(self.y) == self.w
        yield der(self.v) == -self.F * self.x
        yield der(self.w) == -self.F * self.y - self.g
        yield "rod", self.x**2 + self.y**2 == self.L**2


class WeighedOtherwise(Weighed):
    v: Real = variable("m/s", nominal=10.0, state_select="always")
    w: Real = variable("m/s", state_select="avoid")


def test_nominal_and_state_select_weigh_the_columns() -> None:
    for model, weights in ((Weighed(), [0.1, 1e6]), (WeighedOtherwise(), [1e-5, 1e2])):
        dae = transform(flatten(model))
        sets = dae.reduced.sets
        assert sets is not None
        assert names(dae, sets.chains) == [["der(v)", "v"], ["der(w)", "w"]]
        assert sets.weight.tolist() == pytest.approx(weights)
        assert sets.levels == [2]


class Mixture(Component):
    """Two tanks whose contents are in a fixed ratio: a constraint with constant slopes."""

    T: Real = parameter("s", default=1.0)
    a: Real = variable("kg", start=3.0, fixed=True, state_select="never")
    b: Real = variable("kg")
    q: Real = variable("kg/s")

    def equations(self) -> Equations:
        yield self.T * der(self.a) == self.T * self.q - self.a
        yield self.T * der(self.b) == -self.b - self.T * self.q
        yield "ratio", self.a == 3 * self.b


def test_a_constraint_of_constant_slopes_needs_no_other_sets() -> None:
    dae = transform(flatten(Mixture()))
    assert [dae.nodes.name(n) for n in dae.reduced.dummies] == ["der(a)"]
    assert (dae.reduced.sets, dae.reduced.entries) == (None, [])


def test_a_slope_that_a_parameter_may_make_zero_keeps_the_other_sets() -> None:
    dae = transform(flatten(Geared()))
    assert dae.reduced.sets is not None
    assert names(dae, dae.reduced.sets.chains) == [["der(w_1)", "w_1"], ["der(w_2)", "w_2"]]
