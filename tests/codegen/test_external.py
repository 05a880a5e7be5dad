"""External functions as equations, against the same laws written as equations, and in every place of a model."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from arthur_acausal import (
    Component,
    DeclarationError,
    Equations,
    Real,
    SolverOptions,
    StructureError,
    UnitError,
    UsageError,
    der,
    discrete,
    external,
    if_else,
    parameter,
    pre,
    real_input,
    sampled,
    time,
    translate,
    variable,
    when,
)
from arthur_acausal.codegen.portable import from_bytes
from tests.codegen.external_functions import Drag, FloatArray, Numeric

RTOL = 1e-8


def lorenz(v: FloatArray) -> list[float]:
    x, y, z, sigma = v
    return [sigma * (y - x), x * (28.0 - z) - y, x * y - 8.0 / 3.0 * z]


class Lorenz(Component):
    """Lorenz (1963), the law outside of the equations unless ``inside``."""

    inside: bool = False
    stale: bool = False
    x: Real = variable("1", start=1.0)
    y: Real = variable("1", start=1.0)
    z: Real = variable("1", start=1.0)
    a: Real = variable("1/s")
    T: Real = parameter("s", default=1.0)
    sigma: Real = parameter("1", default=10.0)

    def equations(self) -> Equations:
        x, y, z = self.x, self.y, self.z
        rates = [self.T * self.a, self.T * der(y), self.T * der(z)]
        yield der(x) == self.a
        if self.inside:
            law = [self.sigma * (y - x), x * (28.0 - z) - y, x * y - 8.0 / 3.0 * z]
            for rate, right in zip(rates, law, strict=True):
                yield rate == right
        else:
            function = Numeric(lorenz, 4, 3, stale=self.stale, sparsity=SPARSE)
            yield "Lorenz' law", external(function, inputs=[ca.vertcat(x, y, z), self.sigma], outputs=rates)


SPARSE = [[True, True, False, True], [True, True, True, False], [True, True, True, False]]


class Arm(Component):
    """Two masses on a massless two-link arm, accelerations by NumPy; an inertia is bolted to the first joint.

    Joint torques are the reaction of that inertia, -J der(w): an algebraic loop through the function.
    """

    inside: bool = False
    J: Real = parameter("kg*m^2", default=0.3)
    q_1: Real = variable("rad", start=0.5, fixed=True)
    q_2: Real = variable("rad", start=-0.3, fixed=True)
    w_1: Real = variable("rad/s", start=0.0, fixed=True)
    w_2: Real = variable("rad/s", start=0.0, fixed=True)
    tau: Real = variable("N*m")

    def equations(self) -> Equations:
        yield der(self.q_1) == self.w_1
        yield der(self.q_2) == self.w_2
        yield "bolted", self.tau == -self.J * der(self.w_1)
        law = Numeric(arm, 5, 2, units=(("rad", "rad", "rad/s", "rad/s", "N*m"), ("rad/s^2", "rad/s^2")))
        inputs = [self.q_1, self.q_2, self.w_1, self.w_2, self.tau]
        yield "arm", external(law, inputs=inputs, outputs=[der(self.w_1), der(self.w_2)])


def arm(v: FloatArray) -> FloatArray:
    """Double pendulum, m = l = 1, g = 9.81, absolute angles, torque on the first link."""
    q1, q2, w1, w2, tau = v
    c, s = np.cos(q1 - q2), np.sin(q1 - q2)
    mass = np.array([[2.0, c], [c, 1.0]])
    force = np.array([tau - s * w2**2 - 19.62 * np.sin(q1), s * w1**2 - 9.81 * np.sin(q2)])
    return np.linalg.solve(mass, force)


def test_the_same_as_equations() -> None:
    outside, inside = (translate(Lorenz(inside=inside)) for inside in (False, True))
    assert outside.dae.y_paths == ["x", "y", "z"]  # a is computed, no unknown
    ours, theirs = (m.simulate(5.0, tolerance=RTOL) for m in (outside, inside))
    assert np.max(np.abs(ours["x"] - theirs["x"])) < 1e-5  # chaos: errors grow by e^(0.9 t)
    assert outside.verify(ours).largest < 1e-10
    assert np.allclose(ours["a"] * 1.0, 10.0 * (ours["y"] - ours["x"]), rtol=0, atol=1e-9)


def test_called_once_a_residual() -> None:
    solution = translate(Lorenz()).simulate(1.0)
    counts = solution.statistics
    assert counts.residual_evaluations <= counts.external_calls <= counts.residual_evaluations + 10
    assert counts.external_s > 0.0


def test_runs_repeat_bit_by_bit() -> None:
    model = translate(Lorenz(stale=True))
    first = model.simulate(3.0, tolerance=1e-6)
    model.simulate(1.0, parameters={"sigma": 14.0}, tolerance=1e-3)
    again = model.simulate(3.0, tolerance=1e-6)
    assert np.array_equal(first["x"], again["x"])
    assert np.array_equal(first.t, again.t)


def test_pattern_follows_the_sparsity() -> None:
    pattern = translate(Lorenz()).dae.sparsity
    dense = np.zeros((3, 3), dtype=bool)
    dense[pattern.row, np.repeat(np.arange(3), np.diff(pattern.colind))] = True
    assert dense.sum() == 8
    assert dense[:, 2].sum() == 2  # der(x) does not depend on z


def test_jacobian_against_differences() -> None:
    dae = translate(Arm()).dae
    e = dae.evaluator()
    rng = np.random.default_rng(1)
    e.y[:], e.yp[:] = rng.normal(size=dae.n), rng.normal(size=dae.n)
    e.cj[0] = 3.7
    matrix = np.zeros((dae.n, dae.n))
    column = np.repeat(np.arange(dae.n), np.diff(dae.sparsity.colind))
    matrix[dae.sparsity.row, column] = e.jacobian()
    for j in range(dae.n):
        h, sides = 1e-6, []
        for sign in (1.0, -1.0):
            e.y[j] += sign * h
            e.yp[j] += sign * h * e.cj[0]
            sides.append(e.residual().copy())
            e.y[j] -= sign * h
            e.yp[j] -= sign * h * e.cj[0]
        assert np.allclose((sides[0] - sides[1]) / (2 * h), matrix[:, j], rtol=1e-6, atol=1e-7)


def test_loop_through_the_function_conserves_energy() -> None:
    model = translate(Arm())
    assert model.dae.y_paths == ["q_1", "q_2", "w_1", "w_2"]  # the torque is no unknown
    s = model.simulate(5.0, tolerance=1e-9)
    q1, q2, w1, w2 = (s[x] for x in ("q_1", "q_2", "w_1", "w_2"))
    kinetic = (2.0 + 0.3) / 2 * w1**2 + w2**2 / 2 + w1 * w2 * np.cos(q1 - q2)
    energy = kinetic - 19.62 * np.cos(q1) - 9.81 * np.cos(q2)
    assert np.ptp(energy) < 1e-6
    assert np.allclose(s["tau"], -0.3 * s["der(w_1)"], rtol=0, atol=1e-9)


class Chain(Component):
    """y = g(f(x) + x), der(x) = -y, through two calls; the first's output feeds the second's input."""

    x: Real = variable("1", start=2.0, fixed=True)
    a: Real = variable("1")
    y: Real = variable("1")
    T: Real = parameter("s", default=1.0)

    def equations(self) -> Equations:
        yield "second", external(Numeric(np.arctan, 1, 1), inputs=[self.a + self.x], outputs=[self.y])
        yield "first", external(Numeric(np.square, 1, 1), inputs=[self.x], outputs=[self.a])
        yield self.T * der(self.x) == -self.y


def test_chained_calls() -> None:
    model = translate(Chain())
    assert model.dae.y_paths == ["x"]
    s = model.simulate(3.0, tolerance=RTOL)

    class Plain(Chain):
        def equations(self) -> Equations:
            yield self.y == ca.atan(self.a + self.x)
            yield self.a == self.x**2
            yield self.T * der(self.x) == -self.y

    t = translate(Plain()).simulate(3.0, tolerance=RTOL)
    assert np.max(np.abs(s["x"] - t["x"])) < 1e-7
    assert np.max(np.abs(s["y"] - t["y"])) < 1e-7
    assert model.verify(s).largest < 1e-12
    ours, theirs = model.linearize(s, outputs=["y"]), translate(Plain()).linearize(t, outputs=["y"])
    assert np.allclose([ours.A, ours.C], [theirs.A, theirs.C], rtol=1e-6)


class Loop(Component):
    """x = f(y), y = 2 x - u: solved by Newton's method through the function, which alone knows its own loop."""

    u: Real = real_input("1", default=0.5)
    x: Real = variable("1")
    w: Real = variable("1")
    y: Real = variable("1")
    s: Real = variable("1", start=0.0, fixed=True)
    T: Real = parameter("s", default=1.0)

    def equations(self) -> Equations:
        both = Numeric(np.cos, 2, 2, sparsity=[[True, False], [False, True]], name="cosines")
        yield "cosines", external(both, inputs=[self.y, self.w], outputs=[self.x, der(self.s) * self.T])
        yield self.y == 2.0 * self.x - self.u
        yield self.w == 3.0 * self.x


def test_algebraic_loop_and_an_input_from_the_own_output() -> None:
    model = translate(Loop())
    solution = model.simulate(1.0, inputs={"u": 0.2}, tolerance=RTOL)
    x = 0.8
    for _ in range(200):  # x = cos(2 x - 0.2), by a damped fixed point
        x += 0.2 * (np.cos(2.0 * x - 0.2) - x)
    assert np.allclose(solution["x"], x, rtol=0, atol=1e-10)
    assert np.isclose(solution["s"][-1], np.cos(3.0 * x), rtol=1e-7)
    assert len(model.dae.y_paths) == 2
    slope = model.linearize(solution, outputs=["x"]).D[0, 0]
    assert np.isclose(slope, np.sin(2 * x - 0.2) / (1 + 2 * np.sin(2 * x - 0.2)), rtol=1e-6)


class Everywhere(Component):
    """The output of a call in relations, when-clauses, initial equations, samples; inputs of all kinds."""

    u: Real = real_input("1", default=1.0)
    T: Real = parameter("s", default=1.0)
    x: Real = variable("1", start=0.3)
    f: Real = variable("1")
    n: Real = discrete("1")
    held: Real = discrete("1")
    crossed: Real = discrete("s", start=-1.0)
    step: Real = parameter("1", default=0.375)

    def equations(self) -> Equations:
        law = Numeric(lambda v: [v[0] ** 2 + v[1] - v[2] + 0.0 * v[3]], 4, 1)
        yield "f", external(law, inputs=[self.x, self.u, self.n, time()], outputs=[self.f])
        yield self.T * der(self.x) == if_else(self.f > 2.0, -1.0, 1.0) + 0.0 * self.f
        yield when(self.f > 1.5, self.crossed == time(), self.n == pre(self.n) + self.step)
        yield sampled(lambda t, v: v[0], period=0.5, inputs=[self.f], outputs=[self.held])

    def initial_equations(self) -> Equations:
        yield self.f == 1.25


def test_everywhere_in_a_model() -> None:
    s = translate(Everywhere()).simulate(1.2, tolerance=RTOL)
    # x(0) = 0.5 by f = x^2 + 1; f = 1.5 at x = sqrt(0.5); n jumps by 0.375, f falls to 1.125, rises by x^2
    assert np.isclose(s["x"][0], 0.5, atol=1e-10)
    assert np.isclose(s["crossed"][s.t < 0.43][-1], np.sqrt(0.5) - 0.5, atol=1e-7)
    # f = 1.5 again at x^2 = 0.875, 1.25, and so on: f never reaches 2, so that x = 0.5 + t
    assert np.isclose(s["x"][-1], 1.7, atol=1e-7)
    times = 1 + np.floor((1.7**2 - 0.5) / 0.375)
    assert np.isclose(s["n"][-1], 0.375 * times, atol=1e-9)
    at = np.flatnonzero(s.t <= 0.9)[-1]
    assert np.isclose(s["held"][at], 1.0 + 1.0 - s["n"][np.flatnonzero(s.t < 0.5)[-1]], atol=1e-6)


class Tower(Component):
    """A rigid constraint onto the output of a function."""

    s: Real = variable("m", start=0.0, fixed=True)
    v: Real = variable("m/s")
    F: Real = variable("N")
    m: Real = parameter("kg", default=1.0)
    x: Real = variable("m")

    def equations(self) -> Equations:
        yield der(self.s) == self.v
        yield self.m * der(self.v) == self.F
        yield "place", external(Numeric(lambda v: np.sin(v), 1, 1), inputs=[time()], outputs=[self.x])
        yield "welded", self.s == self.x


def test_index_reduction_through_a_call_is_refused() -> None:
    with pytest.raises(
        StructureError, match=r'"place\[0\]".*test_external.py:\d+.*external function'
    ) as caught:
        translate(Tower())
    assert "spring" in caught.value.remedy


class Falling(Component):
    """m der(v) = m g - c v |v|, the drag by a function that other processes find by its name."""

    m: Real = parameter("kg", default=2.0)
    g: Real = parameter("m/s^2", default=9.81)
    v: Real = variable("m/s", start=0.0, fixed=True)
    F: Real = variable("N")

    def equations(self) -> Equations:
        yield "drag", external(Drag(0.5), inputs=[self.v], outputs=[self.F])
        yield self.m * der(self.v) == self.m * self.g - self.F


def test_terminal_velocity_also_as_bytes() -> None:
    model = translate(Falling())
    s = model.simulate(3.0, tolerance=1e-9)
    v = np.sqrt(2.0 * 9.81 / 0.5)
    assert np.allclose(s["v"], v * np.tanh(9.81 * s.t / v), rtol=1e-7, atol=1e-8)
    with pytest.raises(UsageError, match="is not imported"):
        from_bytes(model.to_bytes())
    dae = from_bytes(model.to_bytes(), trusted=("tests.codegen.external_functions",))
    e, other = dae.evaluator(), model.dae.evaluator()
    e.y[:] = other.y[:] = 3.0
    assert np.array_equal(e.residual(), other.residual())
    assert np.array_equal(e.jacobian(), other.jacobian())


def test_refused() -> None:
    model = translate(Lorenz())
    with pytest.raises(UsageError, match="cannot be found by another process"):
        model.to_bytes()
    with pytest.raises(UsageError, match="no form in Modelica"):
        model.to_modelica()
    with pytest.raises(UsageError, match="no sensitivities through"):
        model.sensitivities(model.simulate(0.1), ["x"], ["sigma"])


class Wrong(Component):
    what: str
    v: Real = variable("m")
    w: Real = variable("m/s")
    F: Real = variable("N")
    d: Real = discrete("1")

    def equations(self) -> Equations:
        yield self.w == 0.0
        if self.what == "unit":
            yield self.F == 0.0
        if self.what == "input unit":
            yield self.v == 0.0
        match self.what:
            case "unit":
                yield external(Drag(1.0), inputs=[self.w], outputs=[self.v])
            case "input unit":
                yield external(Drag(1.0), inputs=[self.v], outputs=[self.F])
            case "count":
                yield external(Drag(1.0), inputs=[self.v, self.v], outputs=[self.v])
            case "discrete":
                yield external(Drag(1.0), inputs=[self.v], outputs=[self.d])
            case "no function":
                yield external(np.sin, inputs=[self.v], outputs=[self.v])  # type: ignore[arg-type]
            case "sparsity":
                law = Numeric(np.sin, 1, 1, sparsity=[[True, True]])
                yield external(law, inputs=[self.v], outputs=[self.v])


@pytest.mark.parametrize(
    ("what", "error", "message"),
    [
        ("unit", UnitError, "the left side is m .length, m., but the right side is kg m"),
        ("input unit", UnitError, "input 0 of Drag, v: the function's unit is"),
        ("count", DeclarationError, "Drag has 1 inputs, but 2 are given"),
        ("discrete", DeclarationError, "an output of external.. is a variable, not d"),
        ("no function", DeclarationError, "is no external function: it has no name|n_inputs"),
        ("sparsity", DeclarationError, r"the sparsity of law has the shape \(1, 2\), not \(1, 1\)"),
    ],
)
def test_wrong_declarations(what: str, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        translate(Wrong(what=what))


def test_options_still_apply() -> None:
    dense = translate(Arm()).simulate(1.0, options=SolverOptions(rtol=1e-9, linear_solver="dense"))
    sparse = translate(Arm()).simulate(1.0, options=SolverOptions(rtol=1e-9, linear_solver="sparse"))
    assert np.max(np.abs(dense["q_1"] - sparse["q_1"])) < 1e-7
