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
