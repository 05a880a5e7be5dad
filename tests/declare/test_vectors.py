"""Vectors of quantities: columns of symbols in equations, scalars with a path each everywhere else."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
import pytest
from casadi import SX

from arthur_acausal import (
    Component,
    ConnectError,
    Connector,
    DeclarationError,
    Equations,
    ParameterError,
    Real,
    Record,
    UnitError,
    connect,
    der,
    discrete,
    external,
    flow,
    if_else,
    parameter,
    potential,
    pre,
    real_input,
    real_output,
    reinit,
    sampled,
    simulate,
    start,
    time,
    translate,
    variable,
    when,
)
from arthur_acausal.declare.bind import bind_root
from arthur_acausal.declare.scope import Scope
from arthur_acausal.flatten.flatten import flatten


class Point(Connector):
    """A point in space: position and force."""

    r: Real = potential("m", shape=3)
    f: Real = flow("N", shape=3)

    def power(self) -> SX:
        return ca.dot(self.f, der(self.r))


class Ball(Component):
    """A point mass in a field of gravity."""

    point = Point()
    m: Real = parameter("kg", default=2.0)
    g: Real = parameter("m/s^2", shape=3, default=[0.0, 0.0, -9.81])
    v: Real = variable("m/s", shape=3, nominal=[1.0, 2.0, 3.0])

    def equations(self) -> Equations:
        yield "kinematics", der(self.point.r) == self.v
        yield "Newton", self.m * der(self.v) == self.point.f + self.m * self.g


class Tether(Component):
    """A linear spring between two points, of no length."""

    a = Point()
    b = Point()
    c: Real = parameter("N/m", default=8.0)

    def equations(self) -> Equations:
        yield self.a.f == self.c * (self.a.r - self.b.r)
        yield self.a.f + self.b.f == 0


class Anchor(Component):
    point = Point()
    r: Real = parameter("m", shape=3, default=0.0)

    def equations(self) -> Equations:
        yield self.point.r == self.r


class Swing(Component):
    """A ball on a spring in space: three oscillators that do not know of each other."""

    anchor: Anchor = Anchor(r=[0.1, 0.2, 0.3])
    tether = Tether()
    ball: Ball = Ball(v=start([1.0, 0.0, "-50 cm/s"], fixed=True))

    def equations(self) -> Equations:
        yield connect(self.anchor.point, self.tether.a)
        yield connect(self.tether.b, self.ball.point)

    def initial_equations(self) -> Equations:
        yield "from the anchor", self.ball.point.r == self.anchor.r


def test_a_vector_is_a_column_of_scalars_with_paths() -> None:
    scope = Scope()
    ball = bind_root(Ball(), scope)
    assert isinstance(ball, Ball)
    assert ball.v.shape == (3, 1)
    assert [d.path for d in scope.variable] == [
        f"{q}[{k}]" for q in ("v", "point.r", "point.f") for k in range(3)
    ]
    assert [d.path for d in scope.parameter] == ["m", "g[0]", "g[1]", "g[2]"]
    assert [d.quantity.nominal for d in scope.variable[:3]] == [1.0, 2.0, 3.0]
    assert [d.value for d in scope.parameter] == [2.0, 0.0, 0.0, -9.81]


def test_an_equation_of_columns_is_one_scalar_equation_each() -> None:
    flat = flatten(Ball())
    labels = [e.equation.label for e in flat.equations]
    assert labels[:6] == [f"{law}[{k}]" for law in ("kinematics", "Newton") for k in range(3)]
    assert labels[6:] == ["flow balance"] * 3, "an open connector: each element of the flow is zero"


def test_connected_vectors_swing_as_the_closed_form_says() -> None:
    """m r'' = -c (r - r_a) + m g from r_a with v_0, in each direction (Goldstein, Classical Mechanics, section 6)."""
    model = translate(Swing())
    wanted = {"ball.g[1]": 4.0, "ball.m": 2.0}
    solution = model.simulate(3.0, tolerance=1e-9, parameters=wanted)
    omega = np.sqrt(8.0 / 2.0)
    t = solution.t
    for k, (anchor, v_0, g) in enumerate(
        zip((0.1, 0.2, 0.3), (1.0, 0.0, -0.5), (0.0, 4.0, -9.81), strict=True)
    ):
        exact = anchor + v_0 / omega * np.sin(omega * t) + g / omega**2 * (1.0 - np.cos(omega * t))
        assert solution[f"ball.point.r[{k}]"] == pytest.approx(exact, abs=1e-7)
    whole = solution["ball.point.r"]
    assert whole.shape == (t.size, 3)
    assert np.array_equal(whole[:, 2], solution["ball.point.r[2]"])
    assert solution.power("ball.point") == pytest.approx(
        np.sum(solution["ball.point.f"] * solution["ball.v"], axis=1), abs=1e-9
    )
    assert model.verify(solution).largest < 1e-6


def test_flows_sum_element_by_element() -> None:
    class Pair(Component):
        """Two tethers hold one ball; it rests where their forces and its weight balance."""

        left: Anchor = Anchor(r=[-1.0, 0.0, 0.0])
        right: Anchor = Anchor(r=[1.0, 0.0, 0.0])
        one: Tether = Tether(c=10.0)
        two: Tether = Tether(c=30.0)
        ball = Ball()

        def equations(self) -> Equations:
            yield connect(self.left.point, self.one.a)
            yield connect(self.right.point, self.two.a)
            yield connect(self.one.b, self.ball.point)
            yield connect(self.two.b, self.ball.point)

    solution = translate(Pair()).simulate(0.1, steady=True)
    rest = [(30.0 - 10.0) / 40.0, 0.0, -2.0 * 9.81 / 40.0]
    assert [solution.initial(f"ball.point.r[{k}]") for k in range(3)] == pytest.approx(rest, abs=1e-9)


def test_shapes_of_structural_parameters() -> None:
    class Chain(Component):
        """n first-order lags, told as one vector: x' = A x + b u."""

        n: int = 2
        tau: Real = parameter("s", default=0.5)
        x: Real = variable("1", shape=lambda self: self.n, start=0.0, fixed=True)
        gain: Real = parameter("1", shape=lambda self: self.n, default=lambda self: [1.0] * self.n)

        def equations(self) -> Equations:
            before = ca.vertcat(1.0, self.x[: self.n - 1])
            yield "lag", self.tau * der(self.x) == self.gain * before - self.x

    final = {n: simulate(Chain(n=n), 1.0, tolerance=1e-9) for n in (2, 3)}
    s = 1.0 / 0.5
    assert final[2].final("x[1]") == pytest.approx(1.0 - np.exp(-s) * (1.0 + s), abs=1e-7)
    assert final[3].final("x[2]") == pytest.approx(1.0 - np.exp(-s) * (1.0 + s + s**2 / 2), abs=1e-7)
    given = simulate(Chain(n=2, gain=[2.0, 3.0]), 1.0, tolerance=1e-9)
    assert given.final("x[1]") == pytest.approx(6.0 * final[2].final("x[1]"), abs=1e-6)
    with pytest.raises(DeclarationError, match="gain has 2 elements, but 3 values are given"):
        flatten(Chain(gain=[1.0, 2.0, 3.0]))
    with pytest.raises(DeclarationError, match=r"the shape of x is -1"):
        flatten(Chain(n=-1))


def test_instances_of_different_sizes_do_not_share_their_equations() -> None:
    class Sum(Component):
        n: int = 2
        u: Real = real_input("1", shape=lambda self: self.n, default=1.0)
        y: Real = real_output("1")

        def equations(self) -> Equations:
            yield self.y == ca.sum1(self.u)

    class Two(Component):
        small: Sum = Sum(n=2)
        large: Sum = Sum(n=5)

    solution = simulate(Two(), 1.0)
    assert (solution.final("small.y"), solution.final("large.y")) == (2.0, 5.0)


class Source(Component):
    y: Real = real_output("N", shape=2)

    def equations(self) -> Equations:
        yield self.y[0] == 1.0 * self.one
        yield self.y[1] == 2.0 * self.one

    one: Real = parameter("N", default=1.0)


class Scope3(Component):
    u: Real = real_input("N", shape=3, default=[7.0, 8.0, 9.0])


class Scope2(Component):
    u: Real = real_input("N", shape=2)


def test_vector_signals_connect_element_by_element() -> None:
    class Wired(Component):
        source = Source()
        whole = Scope2()
        part = Scope3()

        def equations(self) -> Equations:
            yield connect(self.source.y, self.whole.u)
            yield connect(self.source.y[1], self.part.u[2])

    solution = simulate(Wired(), 1.0)
    assert solution["whole.u"][-1].tolist() == [1.0, 2.0]
    assert solution["part.u"][-1].tolist() == [7.0, 8.0, 2.0]


def test_signals_of_different_lengths_do_not_connect() -> None:
    class Miswired(Component):
        source = Source()
        scope = Scope3()

        def equations(self) -> Equations:
            yield connect(self.source.y, self.scope.u)

    with pytest.raises(ConnectError, match=r"has 2 elements, but .* 3") as caught:
        flatten(Miswired())
    assert "test_vectors.py:" in caught.value.where


def test_connectors_of_different_lengths_do_not_connect() -> None:
    class Plane(Connector):
        r: Real = potential("m", shape=2)
        f: Real = flow("N", shape=2)

    class Pin(Component):
        point = Plane()

    class Mixed(Component):
        pin = Pin()
        ball = Ball()

        def equations(self) -> Equations:
            yield connect(self.pin.point, self.ball.point)

    with pytest.raises(ConnectError, match="does not fit"):
        flatten(Mixed())


def test_units_are_checked_in_each_element() -> None:
    class Wrong(Component):
        r: Real = variable("m", shape=2)
        v: Real = variable("m/s", shape=2)

        def equations(self) -> Equations:
            yield "position", self.r == self.v
            yield self.v == 0

    with pytest.raises(UnitError, match=r"m.*m/s"):
        flatten(Wrong())


def test_wrong_shapes_name_the_line() -> None:
    class Crooked(Component):
        r: Real = variable("m", shape=3)
        s: Real = variable("m", shape=2)

        def equations(self) -> Equations:
            yield self.r == self.s

    with pytest.raises(DeclarationError, match="the shapes 3x1 and 2x1 do not fit") as caught:
        flatten(Crooked())
    assert "test_vectors.py:" in caught.value.where

    class Square(Component):
        r: Real = variable("m", shape=2)
        A: Real = parameter("1", default=1.0)

        def equations(self) -> Equations:
            yield self.r @ self.r.T == self.r @ self.r.T + 1

    with pytest.raises(DeclarationError, match="2 x 2 equations at once"):
        flatten(Square())


@pytest.mark.parametrize("attributes", [{"start": [0.0, 0.0]}, {"nominal": [1.0] * 4}, {"min": np.zeros(2)}])
def test_as_many_values_as_elements(attributes: Any) -> None:
    with pytest.raises(DeclarationError, match="r has 3 elements, but"):
        type("Short", (Component,), {"r": variable("m", shape=3, **attributes)})


def test_several_values_are_of_vectors_only() -> None:
    with pytest.raises(DeclarationError, match="start has several values"):
        variable("m", start=[0.0, 1.0])
    with pytest.raises(DeclarationError, match="nominal must be positive"):
        type("Flat", (Component,), {"r": variable("m", shape=2, nominal=[1.0, 0.0])})
    with pytest.raises(DeclarationError, match=r"the shape of r is 2\.5"):
        type("Odd", (Component,), {"r": variable("m", shape=2.5)})  # type: ignore[arg-type]


def test_bounds_of_elements() -> None:
    class Bounded(Component):
        p: Real = parameter("1", shape=2, default=0.5, min=[0.0, 0.4])

    assert translate(Bounded(p=[0.1, 0.4])).simulate(1.0).final("p[0]") == 0.1
    with pytest.raises(ParameterError, match="outside") as caught:
        translate(Bounded()).simulate(1.0, parameters={"p[1]": 0.3})
    assert caught.value.path == "p[1]"
    with pytest.raises(ParameterError, match="needs the parameter"):
        flatten(type("Needy", (Component,), {"p": parameter("1", shape=2)})())


def test_events_change_vectors() -> None:
    class Bouncing(Component):
        """Both states jump back by half at t = 1, and both counters count."""

        k: Real = parameter("1/s", default=1.0)
        x: Real = variable("1", shape=2, start=[1.0, 2.0], fixed=True, state_select="always")
        n: Real = discrete("1", shape=2, start=[0.0, 5.0])
        level: Real = variable("1", shape=2)

        def equations(self) -> Equations:
            yield der(self.x) == self.k
            yield self.level == if_else(self.x > 2.5, 1.0, 0.0)
            yield when(self.k * time() > 1.0, reinit(self.x, 0.5 * self.x), self.n == pre(self.n) + 1)
            yield when(self.k * time() > 2.0, reinit(self.x, 0.0))

    solution = simulate(Bouncing(), 2.5)
    assert solution.at(1.5, "x[0]") == pytest.approx(1.5, abs=1e-6)
    assert solution.at(1.5, "x[1]") == pytest.approx(2.0, abs=1e-6)
    assert solution.at([0.3, 0.8], "level[1]").tolist() == [0.0, 1.0], "each element has its own event"
    assert solution.at(0.8, "level[0]") == 0.0
    assert solution["n"][-1].tolist() == [1.0, 6.0]
    assert solution["x"][-1] == pytest.approx([0.5, 0.5], abs=1e-6)


@pytest.mark.parametrize("what", ["condition", "reinit"])
def test_wrong_shapes_in_events(what: str) -> None:
    class Wrong(Component):
        x: Real = variable("1", shape=2, start=1.0, fixed=True)
        z: Real = variable("1", shape=3, start=1.0, fixed=True)

        def equations(self) -> Equations:
            yield der(self.x) == 0
            yield der(self.z) == 0
            if what == "condition":
                yield when(self.x > 1.0, reinit(self.x, 0.0))
            else:
                yield when(time() > 1.0, reinit(self.x, self.z))

    with pytest.raises(
        DeclarationError, match="column of 2" if what == "condition" else "2 states to 3 values"
    ):
        flatten(Wrong())


class Doubling:
    name, n_inputs, n_outputs = "Doubling", 2, 2

    def fresh(self) -> Doubling:
        return Doubling()

    def evaluate(self, inputs: Any, outputs: Any) -> None:
        outputs[:] = 2.0 * inputs

    def derivative(self, inputs: Any, jacobian: Any) -> None:
        jacobian[:] = 2.0 * np.eye(2)


def test_functions_take_and_give_vectors() -> None:
    class Called(Component):
        x: Real = variable("1", shape=2, start=[1.0, 2.0], fixed=True)
        y: Real = variable("1", shape=2)
        k: Real = parameter("1/s", default=1.0)
        held: Real = discrete("1", shape=2)

        def equations(self) -> Equations:
            yield der(self.x) == -self.k * self.x
            yield external(Doubling(), inputs=[self.x], outputs=[self.y])
            yield sampled(
                lambda t, inputs: inputs + 1.0, period=10.0 / self.k, inputs=[self.x], outputs=[self.held]
            )

    solution = simulate(Called(), 1.0)
    assert solution["y"][-1] == pytest.approx(2.0 * np.exp(-1.0) * np.array([1.0, 2.0]), abs=1e-5)
    assert solution["held"][-1].tolist() == [2.0, 3.0]


def test_records_hold_vectors_and_share_them() -> None:
    class Shape(Record):
        c: Real = parameter("1", shape=2, default=[1.0, 2.0])

        @property
        def total(self) -> SX:
            return ca.sum1(self.c)

    class User(Component):
        shape: Shape = Shape()
        y: Real = real_output("1")

        def equations(self) -> Equations:
            yield self.y == self.shape.total

    class Owner(Component):
        shape: Shape = Shape(c=[3.0, 4.0])

        def build(self) -> None:
            self.one = User(shape=self.shape)
            self.two = User(shape=Shape(c=2.0 * self.shape.c))

    solution = translate(Owner()).simulate(1.0, parameters={"shape.c[1]": 10.0})
    assert (solution.final("one.y"), solution.final("two.y")) == (13.0, 26.0)
    assert [float(x) for x in ca.vertsplit(Shape(c=[5.0, 6.0]).c)] == [5.0, 6.0], "numbers, in no model"
