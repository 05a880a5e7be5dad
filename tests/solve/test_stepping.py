"""Runs taken forward step by step, against closed forms and against runs in one go."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal import (
    Component,
    Equations,
    Real,
    SimulationError,
    Table,
    UsageError,
    der,
    discrete,
    parameter,
    pre,
    real_input,
    terminate,
    translate,
    variable,
    when,
)


class Lag(Component):
    """tau x' = u - x, with a count of how often x rises above 0.5; above ``top`` the run ends."""

    u: Real = real_input("1", default=0.0)
    tau: Real = parameter("s", default=0.5)
    top: Real = parameter("1", default=10.0)
    x: Real = variable("1", start=0.0, fixed=True)
    y: Real = variable("1")
    crossings: Real = discrete("1", start=0.0)

    def equations(self) -> Equations:
        yield self.tau * der(self.x) == self.u - self.x
        yield self.y == 2 * self.x + self.u
        yield when(self.x > 0.5, self.crossings == pre(self.crossings) + 1)
        yield when(self.x > self.top, terminate("over the top"))


def test_each_step_is_that_of_the_closed_form() -> None:
    run = translate(Lag()).stepper(10.0, tolerance=1e-9)
    x, rng = 0.0, np.random.default_rng(1)
    for k in range(40):
        u = float(rng.uniform(-1.0, 2.0))
        run.set({"u": u})
        run.advance(0.1 * (k + 1))
        x = u + (x - u) * np.exp(-0.1 / 0.5)
        assert run.t == pytest.approx(0.1 * (k + 1), rel=1e-12)
        assert run.observe(["x", "y", "u"]) == pytest.approx([x, 2 * x + u, u], abs=1e-7)
    assert run.ended is None


def test_as_with_a_table_of_the_same_inputs() -> None:
    model, times = translate(Lag()), np.arange(11) * 0.2
    values = np.array([0.0, 1.0, 1.0, 0.2, 2.0, 0.0, 1.0, -1.0, 3.0, 0.0])
    table = Table(np.repeat(times, 2)[1:-1], np.repeat(values, 2))  # two values at a time: a jump
    whole = model.simulate(2.0, inputs={"u": table}, tolerance=1e-8)
    run = model.stepper(2.0, tolerance=1e-8)
    for t, u in zip(times[1:], values, strict=False):
        run.set({"u": u})
        run.advance(t)
        assert run.observe(["x"])[0] == pytest.approx(whole.at(t, "x"), abs=1e-6)
    assert run.observe(["crossings"])[0] == whole["crossings"][-1] > 1
    assert run.ended == "finished"


def test_it_ends_as_the_model_says_and_begins_again_from_known_values() -> None:
    model = translate(Lag())
    first = model.stepper(5.0, parameters={"top": 0.7})
    first.set({"u": 1.0})
    first.advance(5.0)
    assert first.ended == "over the top"
    assert first.t == pytest.approx(0.5 * np.log(1 / 0.3), rel=1e-4)
    assert first.trajectory().t[-1] == first.t
    again = model.stepper(5.0, parameters={"top": 0.7}, begin=first.begin)
    again.set({"u": 1.0})
    again.advance(5.0)
    assert again.t == first.t


def test_what_cannot_be_set_is_refused() -> None:
    model = translate(Lag())
    run = model.stepper(1.0, inputs={"u": lambda t: t})
    with pytest.raises(UsageError, match="no input 'u' that can be set"):
        run.set({"u": 1.0})
    with pytest.raises(UsageError, match="no input 'v' that can be set"):
        model.stepper(1.0).set({"v": 1.0})
    with pytest.raises(UsageError, match="finite"):
        model.stepper(1.0).set({"u": np.nan})


class Escape(Component):
    """x' = x^2 from 1: there is no solution beyond t = 1."""

    x: Real = variable("1", start=1.0, fixed=True)
    k: Real = parameter("1/s", default=1.0)

    def equations(self) -> Equations:
        yield der(self.x) == self.k * self.x**2


def test_a_failure_holds_what_was_computed() -> None:
    run = translate(Escape()).stepper(2.0)
    run.advance(0.5)
    assert run.observe(["x"])[0] == pytest.approx(2.0, rel=1e-4)
    with pytest.raises(SimulationError) as caught:
        run.advance(1.5)
    assert caught.value.trajectory.t[-1] <= 1.0  # type: ignore[attr-defined]


class Root(Component):
    """x' = y, where y^2 = u: nothing for u < 0."""

    u: Real = real_input("1", default=1.0)
    tau: Real = parameter("s", default=1.0)
    x: Real = variable("1", start=0.0, fixed=True)
    y: Real = variable("1", start=1.0)

    def equations(self) -> Equations:
        yield self.tau * der(self.x) == self.y
        yield self.y**2 == self.u


def test_a_jump_without_a_solution_holds_what_was_computed() -> None:
    run = translate(Root()).stepper(2.0)
    run.advance(0.5)
    with pytest.raises(SimulationError) as caught:
        run.set({"u": -1.0})
    assert caught.value.trajectory.t[-1] == pytest.approx(0.5)  # type: ignore[attr-defined]
