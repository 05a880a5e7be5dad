"""How runs go on, or end, with external functions: stale derivatives, no value, errors, events, sets of states."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal import (
    Component,
    Equations,
    InitializationError,
    Real,
    SimulationError,
    der,
    external,
    parameter,
    sampled,
    simulate,
    translate,
    variable,
    when,
)
from arthur_acausal.declare.statement import reinit
from tests.codegen.external_functions import FloatArray, Numeric


class Duffing(Component):
    """s'' = s - s^3 - 0.1 s', dimensionless; the force by NumPy."""

    function: object = None
    s: Real = variable("1", start=0.1, fixed=True)
    v: Real = variable("1", start=0.0, fixed=True)
    T: Real = parameter("s", default=1.0)

    def equations(self) -> Equations:
        yield self.T * der(self.s) == self.v
        function = self.function or Numeric(lambda x: x[0] - x[0] ** 3 - 0.1 * x[1], 2, 1)
        yield "spring", external(function, inputs=[self.s, self.v], outputs=[self.T * der(self.v)])  # type: ignore[arg-type]


def duffing(x: FloatArray) -> float:
    return float(x[0] - x[0] ** 3 - 0.1 * x[1])


def test_a_stale_derivative_costs_iterations_but_no_accuracy() -> None:
    stale, exact = (Numeric(duffing, 2, 1, stale=stale) for stale in (True, False))
    a, b = (simulate(Duffing(function=f), 20.0, tolerance=1e-8) for f in (stale, exact))
    assert np.max(np.abs(a["s"] - b["s"])) < 1e-6
    assert sum(copy.derivatives for copy in stale.copies) < sum(copy.derivatives for copy in exact.copies)


def test_steps_go_round_where_there_is_no_value() -> None:
    """der(v) = -sqrt(v): a step beyond v = 0 has no value; until then v = (1 - t/2)^2."""
    law = Numeric(lambda x: -np.sqrt(x[0]) if x[0] >= 0.0 else np.nan, 2, 1, name="square root")

    class Drain(Component):
        v: Real = variable("1", start=1.0, fixed=True)
        T: Real = parameter("s", default=1.0)

        def equations(self) -> Equations:
            yield "outflow", external(law, inputs=[self.v, 0.0], outputs=[self.T * der(self.v)])

    done = simulate(Drain(), 1.9, tolerance=1e-8)
    assert np.allclose(done["v"], (1.0 - done.t / 2.0) ** 2, rtol=0, atol=1e-7)
    with pytest.raises(SimulationError, match="an external function has no finite value") as caught:
        simulate(Drain(), 4.0)
    assert '"outflow" square root (test_external.py' in caught.value.cause
    with pytest.raises(InitializationError, match='these have no finite value: "outflow" square root'):
        translate(Drain()).simulate(1.0, start={"v": -1.0})


def test_one_that_raises_ends_the_run_with_its_name_and_time() -> None:
    def law(x: FloatArray) -> float:
        if x[0] > 0.5:
            raise ValueError("beyond the table")
        return 1.0

    with pytest.raises(
        SimulationError, match=r'"spring" law .*failed at t = .*ValueError: beyond the table'
    ) as caught:
        simulate(Duffing(function=Numeric(law, 2, 1)), 10.0)
    solution = caught.value.solution
    assert 0.0 < solution["s"][-1] <= 0.51


class Bouncing(Component):
    """A ball under gravity from outside, bouncing without loss: the height is the same after each period."""

    h: Real = variable("m", start=1.0, fixed=True)
    v: Real = variable("m/s", start=0.0, fixed=True)
    function: object = None

    def equations(self) -> Equations:
        yield der(self.h) == self.v
        yield external(self.function, inputs=[self.h], outputs=[der(self.v)])  # type: ignore[arg-type]
        yield when(self.h < 0.0, reinit(self.v, -self.v))


def test_told_of_events() -> None:
    gravity = Numeric(lambda x: -9.81, 1, 1)
    done = simulate(Bouncing(function=gravity), 4.0, tolerance=1e-8)
    bounces = sum(e.kind == "when" for e in done.events)
    assert bounces == 4  # at sqrt(2/g) (1, 3, 5, 7) = 0.45, 1.35, 2.26, 3.16
    assert sum(copy.restarts for copy in gravity.copies) >= bounces
    assert np.isclose(done["h"].max(), 1.0, atol=1e-6)


class Sprung(Component):
    """An oscillator, its spring from outside, pushed by a force that is sampled and held to first order."""

    function: object = None
    s: Real = variable("1", start=0.1, fixed=True)
    v: Real = variable("1", start=0.0, fixed=True)
    a: Real = variable("1/s")
    u: Real = variable("1")
    T: Real = parameter("s", default=1.0)

    def equations(self) -> Equations:
        yield self.T * der(self.s) == self.v
        yield external(self.function, inputs=[self.s], outputs=[self.T * self.a])  # type: ignore[arg-type]
        yield self.T * der(self.v) == self.T * self.a + self.u
        yield sampled(lambda t, _: np.sin(t), period=0.1, outputs=[self.u], hold="first")


def test_a_sample_costs_an_external_function_one_evaluation() -> None:
    done = simulate(Sprung(function=Numeric(lambda x: -x[0], 1, 1)), 10.0, tolerance=1e-6)
    samples, beside = 101, done.statistics.external_calls - done.statistics.residual_evaluations
    assert done.statistics.restarts <= 2
    assert samples - 20 < beside < samples + 60  # and some for initial values, starts and Jacobians


class Pendulum(Component):
    """In Cartesian coordinates, its weight from outside: the set of states changes on the way."""

    x: Real = variable("m", start=1.0)
    y: Real = variable("m", start=0.0)
    v_x: Real = variable("m/s", start=0.0)
    v_y: Real = variable("m/s", start=0.0)
    F: Real = variable("N/m")
    W: Real = variable("N")
    m: Real = parameter("kg", default=1.0)
    L: Real = parameter("m", default=1.0)

    def equations(self) -> Equations:
        yield der(self.x) == self.v_x
        yield der(self.y) == self.v_y
        yield (
            "weight",
            external(
                Numeric(lambda v: -9.81 * v[0] + 0.0 * v[1], 2, 1), inputs=[self.m, self.x], outputs=[self.W]
            ),
        )
        yield self.m * der(self.v_x) == -self.F * self.x
        yield self.m * der(self.v_y) == -self.F * self.y + self.W
        yield "rod", self.x**2 + self.y**2 == self.L**2


def test_sets_of_states_change() -> None:
    model = translate(Pendulum())
    done = model.simulate(3.0, tolerance=1e-8)
    assert len(done.pieces) > 1
    assert np.max(np.abs(done["x"] ** 2 + done["y"] ** 2 - 1.0)) < 1e-12
    energy = (done["v_x"] ** 2 + done["v_y"] ** 2) / 2 + 9.81 * done["y"]
    assert np.max(np.abs(energy)) < 1e-5
    assert model.verify(done).largest < 1e-9
