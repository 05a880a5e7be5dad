"""Sampled blocks and elsewhen, against the same recurrences by hand."""

from __future__ import annotations

from typing import Any

import casadi
import numpy as np
import pytest

from arthur_acausal import (
    Component,
    DeclarationError,
    Equations,
    Real,
    SimulationError,
    SolverOptions,
    der,
    discrete,
    parameter,
    pre,
    sampled,
    translate,
    variable,
    when,
)


class Integrating:
    """A PI law with a state of its own."""

    def __init__(self) -> None:
        self.sum = 0.0

    def fresh(self) -> Integrating:
        return Integrating()

    def __call__(self, t: float, inputs: Any) -> list[float]:
        self.sum += 0.01 * inputs[0]
        return [2.0 * inputs[0] + 5.0 * self.sum]


class Loop(Component):
    """An integrator under a sampled controller."""

    period: Real = parameter("s", default=0.01)
    target: Real = parameter("m", default=1.0)
    x: Real = variable("m", start=0.0, fixed=True)
    u: Real = discrete("m/s")

    def equations(self) -> Equations:
        yield der(self.x) == self.u
        yield (
            "law",
            sampled(Integrating(), period=self.period, inputs=[self.target - self.x], outputs=[self.u]),
        )


def test_a_sampled_controller_follows_its_recurrence_exactly() -> None:
    translation = translate(Loop())
    solution = translation.simulate(2.0)
    x = total = 0.0
    for _ in range(200):
        total += 0.01 * (1.0 - x)
        x += 0.01 * (2.0 * (1.0 - x) + 5.0 * total)
    assert solution.final("x") == pytest.approx(x, rel=1e-12)
    again = translation.simulate(2.0)
    assert np.array_equal(again["x"], solution["x"])  # the controller's state is fresh


class Rates(Component):
    """Two blocks at different rates; the second reads what the first has set at the same moment."""

    a: Real = discrete()
    b: Real = discrete()

    def equations(self) -> Equations:
        yield sampled(lambda t, inputs: [inputs[0] + 1.0], period=0.1, inputs=[self.a], outputs=[self.a])
        add = casadi.Function("add", [casadi.SX.sym("t"), (x := casadi.SX.sym("x", 2))], [x[0] + x[1]])
        yield sampled(add, period=0.3, offset=0.2, inputs=[self.a, self.b], outputs=[self.b])


def test_several_rates_keep_phase_and_order() -> None:
    solution = translate(Rates()).simulate(1.05)
    assert solution.final("a") == 11.0  # at 0, 0.1, ..., 1.0
    assert solution.final("b") == 3.0 + 6.0 + 9.0  # at 0.2, 0.5, 0.8, each after the first block


class Failing(Component):
    u: Real = discrete()

    def equations(self) -> Equations:
        yield "broken law", sampled(lambda t, inputs: [1.0 / (0.25 - t)], period=0.25, outputs=[self.u])


def test_an_error_in_a_sampled_function_names_the_block_and_keeps_the_run() -> None:
    with pytest.raises(
        SimulationError, match=r"broken law failed at t = 0\.25 s: ZeroDivisionError"
    ) as caught:
        translate(Failing()).simulate(1.0)
    assert caught.value.solution.t[-1] == pytest.approx(0.25)


def test_a_period_must_be_positive() -> None:
    with pytest.raises(Exception, match="period is 0 s"):
        translate(Loop()).simulate(1.0, parameters={"period": 0.0})


class WrongOutput(Component):
    x: Real = variable("1", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == 1.0 / parameter_second()
        yield sampled(lambda t, inputs: [0.0], period=0.1, outputs=[self.x])


def parameter_second() -> float:
    return 1.0


def test_outputs_must_be_discrete() -> None:
    with pytest.raises(DeclarationError, match="an output of sampled\\(\\) is a discrete variable"):
        translate(WrongOutput(), check_units=False)


class Branches(Component):
    """Whichever threshold is passed first by itself counts; passed together, the first branch only."""

    T: Real = parameter("s", default=1.0)
    low: Real = parameter("1", default=0.4)
    x: Real = variable("1", start=0.0, fixed=True)
    n: Real = discrete()

    def equations(self) -> Equations:
        yield self.T * der(self.x) == 1.0
        yield when(self.x > 0.5, self.n == pre(self.n) + 1).elsewhen(
            self.x > self.low, self.n == pre(self.n) + 10
        )


@pytest.mark.parametrize(("low", "expected"), [(0.4, 11.0), (0.5, 1.0), (0.6, 11.0)])
def test_elsewhen_acts_unless_an_earlier_branch_does(low: float, expected: float) -> None:
    assert translate(Branches()).simulate(1.0, parameters={"low": low}).final("n") == expected


class Ramped(Component):
    """A mass pushed by a force that is commanded as t at 0, 0.5, 1, ... with a first-order hold."""

    m: Real = parameter("kg", default=2.0)
    x: Real = variable("m", start=0.0, fixed=True)
    v: Real = variable("m/s", start=0.0, fixed=True)
    F: Real = variable("N", start=1.0)

    def equations(self) -> Equations:
        yield der(self.x) == self.v
        yield self.m * der(self.v) == self.F
        yield "force", sampled(lambda t, v: 10.0 * t**2, period=0.5, outputs=[self.F], hold="first")


def test_first_order_hold_is_a_ramp_one_period_late_without_further_events() -> None:
    solution = translate(Ramped()).simulate(2.0, tolerance=1e-9)
    ends, values = [0.0, 0.5, 1.0, 1.5, 2.0], [1.0, 0.0, 2.5, 10.0, 22.5]
    assert np.allclose(solution["F"], np.interp(solution.t, ends, values), rtol=0, atol=1e-12)
    impulse = np.trapezoid(values, ends)
    assert solution.final("v") == pytest.approx(impulse / 2.0, rel=1e-8)
    assert solution.statistics.time_events == 4  # at 0.5, 1, 1.5, 2; the first call is part of the start
    assert solution.statistics.state_events == 0
    assert solution.statistics.restarts <= 1  # a bend needs no new start
    assert translate(Ramped()).verify(solution).largest < 1e-12


class Part(Component):
    """Adds one to what its source has, at its own period."""

    period: float
    source: float = 0.0
    y: Real = discrete()
    u: Real = discrete()

    def equations(self) -> Equations:
        yield sampled(lambda t, v: v[0] + 1.0, period=self.period, inputs=[self.y], outputs=[self.y])


class Chained(Component):
    """The owner's block, then its parts' in the order of declaration, each with what the earlier ones have set."""

    order: Any
    first: Part = Part(period=0.2)
    n: Real = discrete()

    def build(self) -> None:
        self.middle = Middle(order=self.order)
        self.last = Recorder(order=self.order, name="last")

    def equations(self) -> Equations:
        yield sampled(lambda t, v: self.order.append("owner") or [0.0], period=0.1, outputs=[self.n])


class Recorder(Component):
    order: Any
    name: str
    n: Real = discrete()

    def equations(self) -> Equations:
        yield sampled(lambda t, v: self.order.append(self.name) or [t], period=0.1, outputs=[self.n])


class Middle(Component):
    order: Any

    def build(self) -> None:
        self.inner = Recorder(order=self.order, name="inner")

    def equations(self) -> Equations:
        yield from ()


def test_blocks_of_parts_go_in_the_order_of_declaration() -> None:
    order: list[str] = []
    translate(Chained(order=order)).simulate(0.05)
    assert order == ["owner", "inner", "last"]


class Replanned(Component):
    """A planner at 0.3 s that is also called when the gait, at 0.1 s, changes its phase; a consumer behind it."""

    calls: Any
    phase: Real = discrete()
    plan: Real = discrete("s", start=-1.0)
    used: Real = discrete("s", start=-1.0)

    def equations(self) -> Equations:
        yield sampled(lambda t, v: float(t > 0.45), period=0.1, outputs=[self.phase])
        yield sampled(self._planner, period=0.3, outputs=[self.plan], trigger=self.phase)
        yield sampled(lambda t, v: v[0], period=0.1, inputs=[self.plan], outputs=[self.used])

    def _planner(self, t: float, v: Any) -> float:
        self.calls.append(round(t, 9))
        return t


def test_a_trigger_calls_a_block_out_of_turn() -> None:
    calls: list[float] = []
    solution = translate(Replanned(calls=calls)).simulate(1.0)
    assert calls == [0.0, 0.3, 0.5, 0.6, 0.9]
    at = (solution.t > 0.52) & (solution.t < 0.58)
    assert np.allclose(solution["used"][at], 0.5)


class Watching(Component):
    """Counts upward steps of a sampled signal by comparing it with its value before."""

    y: Real = discrete()
    n: Real = discrete()

    def equations(self) -> Equations:
        yield sampled(lambda t, v: float(int(t / 0.1 + 0.5) % 3 == 0), period=0.1, outputs=[self.y])
        rises = casadi.logic_and(self.y > 0.5, pre(self.y) < 0.5)
        yield when(rises, self.n == pre(self.n) + 1)


def test_pre_in_a_relation_is_the_value_before_the_event() -> None:
    assert translate(Watching()).simulate(1.05).final("n") == 4.0  # at 0, 0.3, 0.6, 0.9


class Before(Component):
    x: Real = variable("m", start=0.0, fixed=True)
    T: Real = parameter("s", default=1.0)
    n: Real = discrete("m")

    def equations(self) -> Equations:
        yield self.T * der(self.x) == -self.x
        yield when(pre(self.x) > self.n, self.n == self.x)


def test_pre_of_a_continuous_variable_in_a_relation_is_refused() -> None:
    with pytest.raises(DeclarationError, match=r"pre\(x\) of a continuous variable .*") as caught:
        translate(Before())
    assert "test_sampled.py" in caught.value.where


class OutputKind(Component):
    x: Real = discrete("m")

    def equations(self) -> Equations:
        yield sampled(lambda t, v: 0.0, period=0.1, outputs=[self.x], hold="first")


def test_a_ramp_is_a_continuous_variable() -> None:
    with pytest.raises(DeclarationError, match="is a continuous variable where hold is first, not x"):
        translate(OutputKind())


class Accumulating(Component):
    """State events at 1 - 2^-n, n = 0, 1, ...: endlessly many before t = 1, and none afterwards."""

    T: Real = parameter("s", default=1.0)
    x: Real = variable("1", start=0.0, fixed=True)
    n: Real = discrete()
    next: Real = discrete("1", start=0.0)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == 1.0
        after = pre(self.n) + 1.0
        yield when(self.x > self.next, self.n == after, self.next == 1.0 - 0.5**after)


def test_events_that_accumulate_stop_the_run_unless_told_otherwise() -> None:
    model = translate(Accumulating())
    with pytest.raises(SimulationError, match=r"accumulate at t = 1 s.*Zeno.*next < x"):
        model.simulate(2.0)
    passed = model.simulate(2.0, options=SolverOptions(zeno_interval=0.0, chattering_window=0.0))
    assert passed.final("x") == pytest.approx(2.0, rel=1e-9)
    assert passed.final("n") >= 38.0  # the rest is nearer than time resolves


class Lagging(Component):
    """T x' = u - x behind a set point that is held to first order: u is a polygon, bent at each sample."""

    T: Real = parameter("s", default=0.05)
    x: Real = variable("1", start=0.0, fixed=True)
    u: Real = variable("1")

    def equations(self) -> Equations:
        yield self.T * der(self.x) == self.u - self.x
        yield sampled(lambda t, v: np.sin(10.0 * t), period=0.01, outputs=[self.u], hold="first")


def test_a_bent_signal_is_integrated_on_without_a_restart() -> None:
    solution = translate(Lagging()).simulate(1.0, options=SolverOptions(rtol=1e-8, output_interval=0.01))
    assert solution.statistics.restarts <= 2
    x, before, asked = 0.0, 0.0, 0.0
    decay = np.exp(-0.01 / 0.05)
    for k in range(100):  # over each period u is a straight line, from what was reached to what is asked now
        before, asked = asked, np.sin(10.0 * 0.01 * k)
        slope = (asked - before) / 0.01
        steady = before - slope * 0.05  # x follows before + slope t, T slope behind
        x = steady + slope * 0.01 + (x - steady) * decay
        assert solution.at((k + 1) * 0.01, "x") == pytest.approx(x, abs=3e-7)


def test_a_signal_that_jumps_restarts() -> None:
    assert translate(Loop()).simulate(0.5).statistics.restarts >= 49
