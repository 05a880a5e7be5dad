"""Equations whose highest derivatives depend on each other by their coefficients, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm

from arthur_acausal import (
    Component,
    Equations,
    InitializationError,
    Real,
    StructureError,
    connect,
    der,
    parameter,
    start,
    translate,
    variable,
)
from tests.circuit import Ground, Inductor, Resistor, Voltage


class NodalCapacitor(Component):
    """A source U behind R_0, a capacitor C and a resistor R_1 to ground, as two node equations."""

    U: Real = parameter("V", default=2.0)
    R_0: Real = parameter("ohm", default=1.0)
    R_1: Real = parameter("ohm", default=3.0)
    C: Real = parameter("F", default=0.5)
    u: Real = variable("V")
    w: Real = variable("V", start=1.5, fixed=True)

    def equations(self) -> Equations:
        yield "left node", (self.u - self.U) / self.R_0 + self.C * (der(self.u) - der(self.w)) == 0
        yield "right node", self.w / self.R_1 + self.C * (der(self.w) - der(self.u)) == 0


def test_two_node_equations_of_one_capacitor() -> None:
    translation = translate(NodalCapacitor())
    assert len(translation.report.states) == 1
    assert any("left node" in m and "right node" in m for m in translation.report.messages)
    for values in {}, {"C": 2.0, "R_0": 5.0}:  # the same translation: what cancels does so for all parameters
        p = {"U": 2.0, "R_0": 1.0, "R_1": 3.0, "C": 0.5} | values
        solution = translation.simulate(1.0, tolerance=1e-9, parameters=values)
        decay = np.exp(-solution.t / ((p["R_0"] + p["R_1"]) * p["C"]))
        np.testing.assert_allclose(solution["w"], 1.5 * decay, rtol=1e-6)
        current = solution["w"] / p["R_1"]
        np.testing.assert_allclose(solution["u"], p["U"] - p["R_0"] * current, rtol=1e-12)
        assert translation.verify(solution).largest < 1e-9


class CutSet(Component):
    """Two inductors with a pair of resistors between them: node equations that are equal but for their sign."""

    source = Voltage(V=2.0)
    first = Inductor(L=1.0, i=start(0.0, fixed=True))
    left = Resistor(R=2.0)
    right = Resistor(R=2.0)
    second = Inductor(L=3.0)
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.first.p)
        yield connect(self.first.n, self.left.p)
        yield connect(self.first.n, self.right.p)
        yield connect(self.left.n, self.second.p)
        yield connect(self.right.n, self.second.p)
        yield connect(self.second.n, self.source.n)
        yield connect(self.source.n, self.ground.p)


def test_inductors_in_series_by_way_of_parallel_resistors() -> None:
    translation = translate(CutSet())
    assert len(translation.report.states) == 1
    solution = translation.simulate(3.0, tolerance=1e-9)
    np.testing.assert_allclose(solution["second.i"], 2.0 * (1.0 - np.exp(-solution.t / 4.0)), atol=1e-7)
    np.testing.assert_allclose(solution["left.i"], solution["second.i"] / 2.0, atol=1e-12)


class Joined(Component):
    """The sum of two speeds in one equation, the sum of the positions in another: no force is left."""

    m: Real = parameter("kg/s", default=2.0)
    k: Real = parameter("1/s", default=1.0)
    v: Real = parameter("m/s", default=1.0)
    x: Real = variable("m", start=0.0, fixed=True)
    y: Real = variable("m")
    f: Real = variable("N")

    def equations(self) -> Equations:
        yield "speed", der(self.x) == self.v - self.k * self.x
        yield "force", self.m * der(self.x) + self.m * der(self.y) == self.f
        yield "joined", self.x + self.y == 0


def test_a_sum_that_vanishes_by_a_differentiated_equation() -> None:
    solution = translate(Joined()).simulate(1.0, tolerance=1e-9)
    np.testing.assert_allclose(solution["x"], 1.0 - np.exp(-solution.t), atol=1e-8)
    np.testing.assert_allclose(solution["f"], 0.0, atol=1e-12)


def test_what_is_said_twice_by_numbers_is_named() -> None:
    class Twice(Component):
        x: Real = variable("1")
        y: Real = variable("1")

        def equations(self) -> Equations:
            yield "first", 2 * self.x + self.y == 1
            yield "second", 4 * self.x + 2 * self.y == 2

    with pytest.raises(StructureError) as caught:
        translate(Twice())
    assert "first" in str(caught.value) and "second" in str(caught.value)


def test_what_depends_for_some_parameters_only_is_left_to_the_run() -> None:
    class Coupled(Component):
        M: Real = parameter("1", default=0.5)
        x: Real = variable("1", start=1.0, fixed=True)
        y: Real = variable("1", start=0.0, fixed=True)
        T: Real = parameter("s", default=1.0)

        def equations(self) -> Equations:
            yield "first", self.T * (der(self.x) + self.M * der(self.y)) == -self.x
            yield "second", self.T * (self.M * der(self.x) + der(self.y)) == -self.y

    translation = translate(Coupled())
    assert len(translation.report.states) == 2
    exact = expm(-np.linalg.inv([[1.0, 0.5], [0.5, 1.0]]) * 0.1) @ [1.0, 0.0]
    assert translation.simulate(0.1).final("x") == pytest.approx(exact[0], rel=1e-5)
    with pytest.raises(InitializationError, match="singular") as caught:
        translation.simulate(0.1, parameters={"M": 1.0})
    assert "first" in str(caught.value) and "second" in str(caught.value)


def test_a_constraint_with_a_variable_that_is_zero_is_differentiated_as_without_it() -> None:
    class Shifted(Component):
        """a = 3 b, with a drift that is zero: 4 b' = -4 b."""

        T: Real = parameter("s", default=1.0)
        a: Real = variable("kg", start=3.0, fixed=True)
        b: Real = variable("kg")
        q: Real = variable("kg/s")
        drift: Real = variable("1")

        def equations(self) -> Equations:
            yield self.drift == 0
            yield self.T * der(self.a) == self.T * self.q - self.a
            yield self.T * der(self.b) == -self.b - self.T * self.q
            yield "ratio", self.a * (1 + self.drift) == 3 * self.b

    solution = translate(Shifted()).simulate(1.0, tolerance=1e-9)
    np.testing.assert_allclose(solution["b"], np.exp(-solution.t), rtol=1e-6)
    np.testing.assert_allclose(solution["q"], 0.0, atol=1e-9)


def test_derivatives_that_the_combination_leaves_in_no_equation_are_gone() -> None:
    class Held(Component):
        """x + 2 y = 0, so that the sum of their rates is zero and x = u."""

        T: Real = parameter("s", default=1.0)
        u: Real = parameter("1", default=3.0)
        x: Real = variable("1")
        y: Real = variable("1")
        z: Real = variable("1", start=0.0, fixed=True)

        def equations(self) -> Equations:
            yield "rates", self.T * (der(self.x) + 2 * der(self.y)) == self.u - self.x
            yield "sum", self.x + 2 * self.y == 0
            yield "follower", self.T * der(self.z) == self.y

    translation = translate(Held())
    assert translation.report.states == ["z"]
    assert translation.report.index == 1
    solution = translation.simulate(2.0)
    assert (solution.final("x"), solution.final("y")) == pytest.approx((3.0, -1.5))
    assert solution.final("z") == pytest.approx(-3.0)
    assert not any(path.startswith("der(x") for path in solution.variables)
