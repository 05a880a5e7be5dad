"""Index reduction and the choice of states, on mechanisms with a closed form or an independent solution."""

from __future__ import annotations

import re

import numpy as np
import pytest
from casadi import cos, sin
from scipy.integrate import solve_ivp

from arthur_acausal import (
    Component,
    Equations,
    Real,
    StructureError,
    connect,
    der,
    parameter,
    real_input,
    start,
    time,
    translate,
    variable,
)
from arthur_acausal.components.rotational import Inertia, TorqueSource
from arthur_acausal.declare.quantity import StateSelect
from arthur_acausal.flatten.flatten import flatten
from arthur_acausal.transform.index import listed
from arthur_acausal.transform.structured import transform
from tests.circuit import Capacitor, Current, Ground, Inductor, Resistor, Voltage


class Pendulum(Component):
    """A point mass on a rod in Cartesian coordinates: index 3. ``F``: the rod's force over mass and length."""

    L: Real = parameter("m", default=1.0)
    g: Real = parameter("m/s^2", default=9.81)
    x: Real = variable("m", start=1.0, fixed=True)
    y: Real = variable("m", start=-0.1)
    vx: Real = variable("m/s", start=0.0)
    vy: Real = variable("m/s", start=0.0)
    F: Real = variable("1/s^2")

    def equations(self) -> Equations:
        yield der(self.x) == self.vx
        yield der(self.y) == self.vy
        yield der(self.vx) == -self.F * self.x
        yield der(self.vy) == -self.F * self.y - self.g
        yield "rod", self.x**2 + self.y**2 == self.L**2

    def initial_equations(self) -> Equations:
        yield "at rest", self.x * self.vy - self.y * self.vx == 0


def test_a_set_of_dummies_that_does_not_fit_is_refused() -> None:
    flat = flatten(Pendulum())
    fitting = transform(flat)
    assert len(fitting.reduced.dummies) == 2  # the first and the second derivative of x, or those of y
    assert transform(flat, fitting.reduced.dummies).causal.states == fitting.causal.states
    with pytest.raises(StructureError, match="more than their unknowns"):
        transform(flat, frozenset())


def test_the_pendulum_is_of_index_3_and_has_two_states() -> None:
    report = translate(Pendulum()).report
    assert report.index == 3
    assert len(report.states) == 2
    assert any('"rod"' in text and text.startswith("der(") for text in report.differentiated), "twice"
    assert sum('"rod"' in text for text in report.differentiated) == 2


def test_the_pendulum_swings_as_in_its_angle_through_both_turning_points() -> None:
    solution = translate(Pendulum()).simulate(3.0, tolerance=1e-8)
    reference = solve_ivp(
        lambda t, a: [a[1], -9.81 * np.sin(a[0])],
        (0.0, 3.0),
        [np.pi / 2, 0.0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-12,
        dense_output=True,
    )
    angle, speed = reference.sol(solution.t)
    assert solution["x"].min() < -0.99, "over to the other side: x and y both pass zero or an end"
    np.testing.assert_allclose(solution["x"], np.sin(angle), atol=1e-5)
    np.testing.assert_allclose(solution["y"], -np.cos(angle), atol=1e-5)
    np.testing.assert_allclose(solution["F"], speed**2 + 9.81 * np.cos(angle), atol=5e-5)
    assert np.abs(solution["x"] ** 2 + solution["y"] ** 2 - 1).max() < 1e-12
    power = solution["x"] * solution["vx"] + solution["y"] * solution["vy"]
    assert np.abs(power).max() < 1e-12, "the hidden constraint holds"


def test_rigidly_joined_inertias_turn_as_one() -> None:
    class Shaft(Component):
        torque = TorqueSource(tau=6.0)
        first = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
        second = Inertia(J=2.0)

        def equations(self) -> Equations:
            yield connect(self.torque.flange, self.first.flange_a)
            yield connect(self.first.flange_b, self.second.flange_a)

    translation = translate(Shaft())
    assert len(translation.report.states) == 2
    solution = translation.simulate(2.0)
    assert solution.final("second.w") == pytest.approx(4.0)  # tau t / (J_1 + J_2)
    assert solution.final("second.phi") == pytest.approx(4.0)
    assert solution.final("second.flange_a.tau") == pytest.approx(4.0)  # J_2 of the whole


class Geared(Component):
    """Two inertias with a gear between them: speeds in a ratio, one degree of freedom, torque ``tau`` on the first."""

    kind: StateSelect = "default"
    n: Real = parameter("1", default=3.0)
    J_1: Real = parameter("kg*m^2", default=1.0)
    J_2: Real = parameter("kg*m^2", default=18.0)
    tau: Real = parameter("N*m", default=9.0)
    phi_1: Real = variable("rad")
    phi_2: Real = variable("rad", start=0.0, fixed=True)
    w_1: Real = variable("rad/s", start=0.0, fixed=True)
    w_2: Real = variable("rad/s")
    tau_1: Real = variable("N*m")

    def equations(self) -> Equations:
        yield self.w_1 == der(self.phi_1)
        yield self.w_2 == der(self.phi_2)
        yield self.J_1 * der(self.w_1) == self.tau - self.tau_1
        yield self.J_2 * der(self.w_2) == self.n * self.tau_1
        yield "gear", self.phi_1 == self.n * self.phi_2


class GearedBySecond(Geared):
    phi_2: Real = variable("rad", start=0.0, fixed=True, state_select="always")
    w_2: Real = variable("rad/s", state_select="always")


class GearedByFirst(Geared):
    phi_1: Real = variable("rad", state_select="prefer")
    w_1: Real = variable("rad/s", start=0.0, fixed=True, state_select="prefer")


class GearedNotBySecond(Geared):
    phi_2: Real = variable("rad", start=0.0, fixed=True, state_select="never")
    w_2: Real = variable("rad/s", state_select="avoid")


@pytest.mark.parametrize(
    ("model", "states"),
    [
        (GearedBySecond(), {"phi_2", "w_2"}),
        (GearedByFirst(), {"phi_1", "w_1"}),
        (GearedNotBySecond(), {"phi_1", "w_1"}),
    ],
)
def test_state_select_decides_where_there_is_a_choice(model: Component, states: set[str]) -> None:
    translation = translate(model)
    assert set(translation.report.states) == states
    solution = translation.simulate(2.0)
    # (J_1 + J_2 / n^2) w_1' = tau: 3 w_1' = 9
    assert solution.final("w_1") == pytest.approx(6.0)
    assert solution.final("w_2") == pytest.approx(2.0)
    assert solution.final("phi_1") == pytest.approx(6.0)
    assert solution.final("tau_1") == pytest.approx(6.0)


def test_a_chain_of_definitions_is_one_of_derivatives() -> None:
    class Moved(Component):
        m: Real = parameter("kg", default=2.0)
        f: Real = parameter("N", default=4.0)
        s: Real = variable("m", start=1.0, fixed=True)
        v: Real = variable("m/s", start=0.0, fixed=True)
        a: Real = variable("m/s^2")

        def equations(self) -> Equations:
            yield self.v == der(self.s)
            yield self.a == der(self.v)
            yield self.m * self.a == self.f

    translation = translate(Moved())
    assert translation.report.states == ["s", "v"]
    assert translation.dae.n == 2
    solution = translation.simulate(3.0)
    assert solution.final("s") == pytest.approx(10.0)
    assert solution.final("a") == pytest.approx(2.0)


def test_a_prescribed_motion_gives_its_force() -> None:
    class Driven(Component):
        """Inverse dynamics: s = A sin(omega t), the force that moves m."""

        A: Real = parameter("m", default=0.5)
        omega: Real = parameter("rad/s", default=3.0)
        m: Real = parameter("kg", default=4.0)
        s: Real = variable("m")
        v: Real = variable("m/s")
        f: Real = variable("N")

        def equations(self) -> Equations:
            yield "track", self.s == self.A * sin(self.omega * time())
            yield self.v == der(self.s)
            yield self.m * der(self.v) == self.f

    translation = translate(Driven())
    assert translation.report.states == []
    solution = translation.simulate(2.0)
    np.testing.assert_allclose(solution["v"], 1.5 * np.cos(3 * solution.t), atol=1e-12)
    np.testing.assert_allclose(solution["f"], -18.0 * np.sin(3 * solution.t), atol=1e-12)


def test_a_capacitor_across_a_source_is_no_state() -> None:
    class Forced(Component):
        source = Voltage(V=5.0)
        first = Capacitor(C=1e-3)
        ground = Ground()

        def equations(self) -> Equations:
            yield connect(self.source.p, self.first.p)
            yield connect(self.source.n, self.first.n)
            yield connect(self.source.n, self.ground.p)

    translation = translate(Forced())
    assert translation.report.states == []
    solution = translation.simulate(1.0)
    assert (solution.final("first.v"), solution.final("first.i")) == (5.0, 0.0)


def test_three_capacitors_in_a_loop_have_two_states() -> None:
    class Delta(Component):
        """A current into the delta: v = i t over the capacitance C_1 + C_2 C_3 / (C_2 + C_3)."""

        source = Current(I=-2.0)
        c_1 = Capacitor(C=1.0, v=start(0.0, fixed=True))
        c_2 = Capacitor(C=2.0, v=start(0.0, fixed=True))
        c_3 = Capacitor(C=6.0)
        ground = Ground()

        def equations(self) -> Equations:
            yield connect(self.source.p, self.c_1.p)
            yield connect(self.c_1.p, self.c_2.p)
            yield connect(self.c_2.n, self.c_3.p)
            yield connect(self.c_3.n, self.c_1.n)
            yield connect(self.c_1.n, self.source.n)
            yield connect(self.source.n, self.ground.p)

    translation = translate(Delta())
    assert len(translation.report.states) == 2
    assert translation.report.index == 2
    solution = translation.simulate(5.0)
    assert solution.final("c_1.v") == pytest.approx(2.0 * 5.0 / 2.5)
    assert solution.final("c_3.i") == pytest.approx(2.0 * 1.5 / 2.5)
    assert solution.final("c_3.v") == pytest.approx(1.0)


def test_inductors_that_meet_have_one_state_less() -> None:
    class Cutset(Component):
        """Two branches L and R in parallel in series with a third: like one coil behind a source."""

        source = Voltage(V=12.0)
        trunk = Inductor(L=1.0, i=start(0.0, fixed=True))
        left = Inductor(L=2.0)
        right = Inductor(L=2.0, i=start(0.0, fixed=True))
        r_left = Resistor(R=4.0)
        r_right = Resistor(R=4.0)
        ground = Ground()

        def equations(self) -> Equations:
            yield connect(self.source.p, self.trunk.p)
            for coil, resistor in ((self.left, self.r_left), (self.right, self.r_right)):
                yield connect(self.trunk.n, coil.p)
                yield connect(coil.n, resistor.p)
                yield connect(resistor.n, self.source.n)
            yield connect(self.source.n, self.ground.p)

    translation = translate(Cutset())
    assert len(translation.report.states) == 2
    solution = translation.simulate(1.0, tolerance=1e-8)
    # equal branches: 2 H and 2 ohm in all, i = 6 (1 - exp(-t))
    np.testing.assert_allclose(solution["trunk.i"], 6 * (1 - np.exp(-solution.t)), atol=1e-6)
    np.testing.assert_allclose(solution["left.i"], 3 * (1 - np.exp(-solution.t)), atol=1e-6)


def test_a_constraint_between_angles_of_a_slider() -> None:
    class Crank(Component):
        """A crank of length a turns at w_0 and pushes a slider by a rod of length b: where the slider is."""

        a: Real = parameter("m", default=0.1)
        b: Real = parameter("m", default=0.3)
        w_0: Real = parameter("rad/s", default=20.0)
        phi: Real = variable("rad", start=0.3, fixed=True)
        psi: Real = variable("rad", start=0.1)
        s: Real = variable("m")
        v: Real = variable("m/s")

        def equations(self) -> Equations:
            yield der(self.phi) == self.w_0
            yield "height", self.a * sin(self.phi) == self.b * sin(self.psi)
            yield self.s == self.a * cos(self.phi) + self.b * cos(self.psi)
            yield self.v == der(self.s)

    translation = translate(Crank())
    assert len(translation.report.states) == 1
    solution = translation.simulate(0.5, tolerance=1e-8)
    phi = 0.3 + 20.0 * solution.t
    rod = np.sqrt(0.09 - (0.1 * np.sin(phi)) ** 2)
    np.testing.assert_allclose(solution["s"], 0.1 * np.cos(phi) + rod, atol=1e-7)
    v = -2.0 * np.sin(phi) - 0.2 * np.sin(phi) * np.cos(phi) / rod
    np.testing.assert_allclose(solution["v"], v, atol=1e-6)


class Followed(Component):
    """y follows the outer signal u exactly, and its speed is asked for."""

    u: Real = real_input("m")
    y: Real = variable("m")
    v: Real = variable("m/s")

    def equations(self) -> Equations:
        yield "track", self.y == 2 * self.u
        yield "speed", self.v == der(self.y)


def test_ropes_that_share_a_weight_are_not_determined_whatever_else_is_wrong() -> None:
    """Statically indeterminate: the equation told is the one of the ropes, not one of the length said twice."""

    class Ropes(Component):
        weight: Real = parameter("N", default=10.0)
        area: Real = parameter("m^2", default=4.0)
        left: Real = variable("N")
        right: Real = variable("N")
        length: Real = variable("m")

        def equations(self) -> Equations:
            yield "balance", self.left + self.right == self.weight
            yield "square", self.length**2 == self.area
            yield "square again", self.area / self.length == self.length

    with pytest.raises(StructureError) as caught:
        translate(Ropes())
    message = caught.value.message
    assert re.search(r'not determined: 1 of left, right \(which stand only in "balance" [^;]*\)', message)
    assert re.search(r'more than their unknowns: "square".*"square again".*hold only length', message)
    assert caught.value.remedy == "remove one of the equations named, and add one for what is not determined"


def test_the_derivative_of_an_outer_signal_is_refused_with_a_remedy() -> None:
    with pytest.raises(StructureError, match=r'"track".*must be differentiated.*external input') as caught:
        translate(Followed())
    assert "filter" in str(caught.value.remedy)


def test_the_index_counts_differentiations() -> None:
    class Decay(Component):
        T: Real = parameter("s", default=1.0)
        x: Real = variable("1", start=1.0, fixed=True)

        def equations(self) -> Equations:
            yield self.T * der(self.x) == -self.x

    assert translate(Decay()).report.index == 0
    assert translate(GearedBySecond()).report.index == 3, "the gear twice"
    report = translate(Pendulum()).report
    assert "2 equations were differentiated (index 3)" in report.messages
    assert sorted(report.dummies)[0].startswith("der(v") and len(report.dummies) == 2


def test_a_long_list_says_how_many_it_leaves_out() -> None:
    assert listed(["a"] * 12, "; ") == "; ".join(["a"] * 12)
    assert listed(["a"] * 13, "; ") == "; ".join(["a"] * 12) + " and 1 more"
