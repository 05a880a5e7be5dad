"""Ordering: explicit assignments, torn loops, parameter pivots; networks against a direct linear solution."""

from __future__ import annotations

import numpy as np
import pytest
from casadi import SX, exp, tanh
from hypothesis import given, settings
from hypothesis import strategies as st

from arthur_acausal import (
    Component,
    Equations,
    ParameterError,
    Real,
    StructureError,
    connect,
    der,
    parameter,
    real_input,
    real_output,
    start,
    translate,
    variable,
)
from arthur_acausal.graph import TearingResult
from arthur_acausal.transform.tear import _ordered, _shortened
from tests.circuit import Capacitor, Current, Ground, Resistor


class Sequence(Component):
    """Three equations in the wrong order, each explicit once the others are known."""

    u: Real = real_input("1", default=2.0)
    a: Real = variable("1")
    b: Real = variable("1")
    c: Real = variable("1")

    def equations(self) -> Equations:
        yield self.c == self.b**2 + self.a
        yield self.b == 3 * self.a
        yield self.a == self.u + 1


def test_explicit_equations_leave_nothing_to_solve() -> None:
    translation = translate(Sequence())
    assert translation.dae.n == 0
    assert translation.report.blocks == []
    assert translation.report.n_blocks == 3
    solution = translation.simulate(1.0)
    assert [solution.final(x) for x in "abc"] == [3.0, 9.0, 84.0]


def test_a_linear_loop_is_torn_to_one_unknown() -> None:
    class Loop(Component):
        u: Real = real_input("1", default=1.0)
        a: Real = variable("1")
        b: Real = variable("1")
        c: Real = variable("1")
        d: Real = variable("1")

        def equations(self) -> Equations:
            yield self.a == self.u - 0.5 * self.d
            yield self.b == 2 * self.a
            yield self.c == self.b + self.a
            yield self.d == self.c - self.b

    translation = translate(Loop())
    assert translation.report.blocks == [(4, 1)]
    assert translation.dae.n == 1
    solution = translation.simulate(1.0)
    assert solution.final("a") == pytest.approx(1 / 1.5)  # d = a
    assert solution.final("c") == pytest.approx(2.0)


def test_a_nonlinear_loop_keeps_what_cannot_be_solved_for() -> None:
    class Diode(Component):
        """v + R I_s (exp(v / V_T) - 1) = u."""

        R: Real = parameter("ohm", default=100.0)
        I_s: Real = parameter("A", default=1e-12)
        V_T: Real = parameter("V", default=0.025)
        u: Real = real_input("V", default=5.0)
        v: Real = variable("V", start=0.6)
        i: Real = variable("A")

        def equations(self) -> Equations:
            yield self.u - self.v == self.R * self.i
            yield self.i == self.I_s * (exp(self.v / self.V_T) - 1)

    translation = translate(Diode())
    assert translation.report.torn == ["v"]
    solution = translation.simulate(1.0)
    v = solution.final("v")
    assert v + 100.0 * 1e-12 * (np.exp(v / 0.025) - 1) == pytest.approx(5.0, rel=1e-9)
    assert solution.final("i") == pytest.approx((5.0 - v) / 100.0)


class Pivot(Component):
    """y is found by its coefficient k, a parameter; unless k is zero."""

    k: Real = parameter("1", default=2.0)
    u: Real = real_input("1", default=6.0)
    y: Real = variable("1")

    def equations(self) -> Equations:
        yield "pivot", self.k * self.y == self.u


def test_parameters_divide_and_are_checked_for_every_run() -> None:
    translation = translate(Pivot())
    assert translation.dae.n == 0
    for k, y in ((2.0, 3.0), (-0.5, -12.0)):
        assert translation.simulate(1.0, parameters={"k": k}).final("y") == y
    with pytest.raises(ParameterError, match=r'"pivot".*solved for y: its coefficient is 0'):
        translation.simulate(1.0, parameters={"k": 0.0})


def test_the_coefficient_of_a_variable_is_never_divided_by() -> None:
    class Product(Component):
        T: Real = parameter("s", default=1.0)
        x: Real = variable("1", start=0.0, fixed=True)
        y: Real = variable("1", start=0.5)

        def equations(self) -> Equations:
            yield self.T * der(self.x) == 1.0
            yield self.x * self.y + self.y == 1.0 + tanh(self.x) * 0

    translation = translate(Product())
    assert translation.report.torn == ["y"]
    solution = translation.simulate(2.0)
    np.testing.assert_allclose(solution["y"], 1 / (1 + solution.t), rtol=1e-6)


def test_a_derivative_in_two_equations_is_solved_implicitly() -> None:
    class Coupled(Component):
        """Two inductors with mutual inductance, shorted: (L + M) (i_1 + i_2)' = -R (i_1 + i_2)."""

        L: Real = parameter("H", default=2.0)
        M: Real = parameter("H", default=1.0)
        R: Real = parameter("ohm", default=3.0)
        i_1: Real = variable("A", start=1.0, fixed=True)
        i_2: Real = variable("A", start=0.5, fixed=True)

        def equations(self) -> Equations:
            yield self.L * der(self.i_1) + self.M * der(self.i_2) == -self.R * self.i_1
            yield self.M * der(self.i_1) + self.L * der(self.i_2) == -self.R * self.i_2

    solution = translate(Coupled()).simulate(1.0, tolerance=1e-8)
    t = solution.t
    total, difference = 1.5 * np.exp(-t), 0.5 * np.exp(-3 * t)
    np.testing.assert_allclose(solution["i_1"], (total + difference) / 2, atol=1e-6)
    np.testing.assert_allclose(solution["i_2"], (total - difference) / 2, atol=1e-6)


class Network(Component):
    """Resistors between numbered nodes, a current of 1 A into node 0 and out of the last, which is grounded."""

    edges: tuple[tuple[int, int, float], ...] = ()
    nodes: int = 2
    ground = Ground()
    source = Current(I=-1.0)

    def build(self) -> None:
        self.items = [Resistor(R=R) for _, _, R in self.edges]

    def equations(self) -> Equations:
        meeting: dict[int, list[object]] = {k: [] for k in range(self.nodes)}
        meeting[0].append(self.source.p)
        meeting[self.nodes - 1] += [self.source.n, self.ground.p]
        for (a, b, _), item in zip(self.edges, self.items, strict=True):
            meeting[a].append(item.p)
            meeting[b].append(item.n)
        for pins in meeting.values():
            for pin in pins[1:]:
                yield connect(pins[0], pin)


@st.composite
def networks(draw: st.DrawFn) -> tuple[int, tuple[tuple[int, int, float], ...]]:
    """A connected network: a path through all nodes, and further resistors."""
    n = draw(st.integers(2, 6))
    ohms = st.floats(0.1, 10.0)
    path = [(k, k + 1, draw(ohms)) for k in range(n - 1)]
    pairs = st.tuples(st.integers(0, n - 1), st.integers(0, n - 1)).filter(lambda p: p[0] != p[1])
    more = draw(st.lists(st.tuples(pairs, ohms), max_size=6))
    return n, tuple(path + [(a, b, R) for (a, b), R in more])


@settings(max_examples=25)
@given(networks())
def test_random_networks_have_the_potentials_of_their_laplacian(
    network: tuple[int, tuple[tuple[int, int, float], ...]],
) -> None:
    n, edges = network
    solution = translate(Network(nodes=n, edges=edges), compile="never").simulate(1.0)
    laplacian = np.zeros((n, n))
    for a, b, R in edges:
        laplacian[[a, b], [a, b]] += 1 / R
        laplacian[[a, b], [b, a]] -= 1 / R
    right = np.zeros(n)
    right[0] = 1.0
    potential = np.append(np.linalg.solve(laplacian[:-1, :-1], right[:-1]), 0.0)
    for k, (a, b, R) in enumerate(edges):
        assert solution.final(f"items[{k}].p.v") == pytest.approx(potential[a], rel=1e-8, abs=1e-12)
        assert solution.final(f"items[{k}].i") == pytest.approx((potential[a] - potential[b]) / R, abs=1e-9)


def test_the_report_counts() -> None:
    class Circuit(Component):
        store = Capacitor(C=1.0, v=start(1.0, fixed=True))
        load = Resistor(R=1.0)
        ground = Ground()

        def equations(self) -> Equations:
            yield connect(self.store.p, self.load.p)
            yield connect(self.store.n, self.load.n)
            yield connect(self.store.n, self.ground.p)

    translation = translate(Circuit())
    report = translation.report
    assert report.equations == report.unknowns == 14, "6 of each element, 2 of the ground"
    assert report.states == ["store.v"]
    kept = report.equations - report.aliases
    assert kept == report.assigned + len(report.torn) + len(report.states), "one row for each"
    assert (report.index, report.differentiated, report.inputs) == (1, [], [])
    assert report.parameters == 2


class Stage(Component):
    """Half of what comes in, and ``c`` of its own."""

    u: Real = real_input("1")
    y: Real = real_output("1")
    c: Real = parameter("1", default=0.0)

    def equations(self) -> Equations:
        yield self.y == 0.5 * self.u + self.c


class Ring(Component):
    """Stages in a ring, the first with c = 1: x_1 = 1 / (1 - 2^-n). From the torn one on they are solved both ways."""

    n: int = 2

    def build(self) -> None:
        self.stages = [Stage(c=float(k == 0)) for k in range(self.n)]

    def equations(self) -> Equations:
        for before, after in zip(self.stages, self.stages[1:] + self.stages[:1], strict=True):
            yield connect(before.y, after.u)


@pytest.mark.parametrize(("n", "torn"), [(2, 1), (17, 1), (18, 2), (19, 3), (35, 3), (36, 4)])
def test_a_chain_in_a_torn_block_has_eight_links_at_most(n: int, torn: int) -> None:
    translation = translate(Ring(n=n), compile="never")
    assert translation.report.blocks == [(n, torn)]
    assert len(translation.report.torn) == torn
    solution = translation.simulate(1.0)
    for k in range(n):
        assert solution.final(f"stages[{k}].y") == pytest.approx(0.5**k / (1 - 0.5**n), rel=1e-9)


def test_a_chain_that_begins_with_what_is_known_has_eight_links_behind_its_first() -> None:
    chain = TearingResult([(k, k) for k in range(11)], [], [])
    edges = [[0], *([k - 1, k] for k in range(1, 11))]
    result = _shortened(chain, edges)
    assert (result.torn_variables, result.residual_equations) == ([9], [9])
    assert result.sequence == [(k, k) for k in range(11) if k != 9]


class Loop(Component):
    """Two unknowns of one block, each of which can be torn: a = b / 2, b = 1 - a."""

    a: Real = variable("1")
    b: Real = variable("1")

    def equations(self) -> Equations:
        yield self.a == 0.5 * self.b
        yield self.b == 1 - self.a


@pytest.mark.parametrize("given", ["a", "b"])
def test_the_variable_with_a_given_start_is_torn(given: str) -> None:
    translation = translate(Loop(a=start(0.1)) if given == "a" else Loop(b=start(0.1)))
    assert translation.report.torn == [given]
    assert translation.report.assigned == 1
    assert translation.simulate(1.0).final("b") == pytest.approx(2.0 / 3.0)


def test_an_equation_determines_first_what_it_can_be_divided_by() -> None:
    symbol = SX.sym("k")
    place = {n: 10 + n for n in range(5)}
    edges = {0: None, 1: symbol, 2: 2.0, 3: None, 4: -1.0, 9: 1.0}
    assert _ordered(edges, place, rates={3}) == [13, 12, 14, 11, 10], "9 is a state, and known"
    assert _ordered(edges, place, rates=set()) == [12, 14, 11, 10, 13]


def test_terms_that_cancel_by_their_numbers_are_none() -> None:
    class Cancelling(Component):
        x: Real = variable("1")
        y: Real = variable("1")
        z: Real = variable("1")

        def equations(self) -> Equations:
            yield "same", self.z == self.x
            yield "sum", self.x + self.y == self.z + 1
            yield "other", self.x + 2 * self.y == 3 * self.z

    report = translate(Cancelling()).report
    assert (report.n_blocks, report.blocks) == (2, []), "the sum holds y only"

    class Undetermined(Cancelling):
        def equations(self) -> Equations:
            yield "same", self.z == self.x
            yield "sum", self.x + self.y == self.z + 1
            yield "twice", 2 * self.x + self.y == 2 * self.z + 1

    with pytest.raises(
        StructureError, match=r'more than their unknowns: "sum".*"twice".*not determined: x'
    ) as caught:
        translate(Undetermined())
    assert "which hold only y" in str(caught.value)
