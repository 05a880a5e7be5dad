"""Consistent initial values: what is solved, what is assumed, and what is said when it cannot be."""

from __future__ import annotations

import casadi
import numpy as np
import pytest

from arthur_acausal.errors import InitializationError
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.simulate import simulate
from arthur_acausal.solve.trajectory import Trajectory
from tests.solve.handmade import (
    Handmade,
    Relation,
    algebraic,
    assign,
    discrete,
    handmade,
    state,
)


def start_of(dae: Handmade) -> Trajectory:
    """A short run; its first row is the start."""
    return simulate(dae, stop_time=1e-3, options=SolverOptions(intervals=1))


def refused(dae: Handmade) -> str:
    """The message of the InitializationError."""
    with pytest.raises(InitializationError) as caught:
        start_of(dae)
    return str(caught.value)


def test_algebraic_variables_and_derivatives_are_solved_for() -> None:
    x, a = state("x", 2.0, fixed=True), algebraic("a", 1.0)
    result = start_of(handmade([x, a], {"x": x.d + a.s, "square": a.s**2 - x.s**4}))
    assert result.y[0].tolist() == pytest.approx([2.0, 4.0], rel=1e-12)
    assert result.yp[0, 0] == pytest.approx(-4.0, rel=1e-12)


def test_a_steady_state_is_found_from_initial_equations() -> None:
    x, v = state("x", 0.3), state("v", 1.0)
    dae = handmade(
        [x, v],
        {"kinematics": x.d - v.s, "spring": v.d + casadi.sinh(x.s - 1.0) + v.s},
        initial={"der(x) == 0": x.d, "der(v) == 0": v.d},
    )
    result = start_of(dae)
    assert result.y[0] == pytest.approx([1.0, 0.0], abs=1e-10)
    assert not result.statistics.messages


def test_initial_conditions_on_algebraic_variables_and_derivatives_count() -> None:
    p, q = state("p", 5.0), algebraic("q", 0.1, fixed=True)
    dae = handmade([p, q], {"volume": p.d + q.s, "orifice": q.s * abs(q.s) - p.s})
    result = start_of(dae)
    assert result.y[0] == pytest.approx([0.01, 0.1], rel=1e-9)


def test_states_without_condition_take_their_start_and_a_given_start_comes_first() -> None:
    # one condition for two states: either may be freed; y has no start of its own, x has
    x, y = state("x", 3.0), state("y")
    dae = handmade([x, y], {"x": x.d + x.s, "y": y.d + y.s}, initial={"sum": x.s + y.s - 10.0})
    result = start_of(dae)
    assert result.y[0] == pytest.approx([3.0, 7.0])
    assert result.statistics.messages == ["no initial condition, start value taken: x = 3"]


def test_everything_assumed_is_listed() -> None:
    xs = [state(f"x{k}", float(k)) for k in range(9)]
    result = start_of(handmade(xs, {x.path: x.d for x in xs}))
    told = (
        "no initial condition, start value taken: x0 = 0, x1 = 1, x2 = 2, x3 = 3, x4 = 4, x5 = 5 and 3 more"
    )
    assert result.statistics.messages == [told]


def test_too_many_conditions_that_agree_are_noticed_only() -> None:
    x = state("x", 2.0, fixed=True)
    dae = handmade([x], {"x": x.d + x.s}, initial={"square": x.s**2 - 4.0})
    result = start_of(dae)
    assert result.y[0, 0] == 2.0
    assert result.statistics.messages == ["initial conditions that say nothing new: square"]


def test_too_many_conditions_that_disagree_are_named_with_their_values() -> None:
    x, y = state("x", 2.0, fixed=True), state("y", 1.0, fixed=True)
    dae = handmade([x, y], {"x": x.d + x.s, "y": y.d}, initial={"square": x.s**2 - 5.0})
    told = refused(dae)
    assert "contradict each other: not fulfilled: square (off by -1)" in told
    assert "fixed start of x" in told and "fixed start of y" not in told


def test_conditions_at_one_place_and_none_at_another_are_both_named() -> None:
    x, y = state("x", 1.0), state("y", 1.0)
    dae = handmade(
        [x, y],
        {"x": x.d + x.s, "y": y.d + y.s},
        initial={"first": x.s**2 + x.s - 2.0, "second": x.d + x.s * x.s},
    )
    result = start_of(dae)  # der(x) = -x = -x^2 and x = 1 agree; y takes its start
    assert result.y[0] == pytest.approx([1.0, 1.0])
    assert len(result.statistics.messages) == 2


def test_a_singular_jacobian_names_unknowns_and_equations() -> None:
    x, i1, i2 = state("x", 1.0, fixed=True), algebraic("i1"), algebraic("i2")
    dae = handmade(
        [x, i1, i2],
        {"x": x.d + i1.s, "node a": i1.s + i2.s - x.s, "node b": 2.0 * i1.s + 2.0 * i2.s - 2.0 * x.s},
    )
    told = refused(dae)
    assert "singular Jacobian" in told and "i1" in told and "i2" in told
    assert "node a" in told and "node b" in told and "depend on each other" in told


def test_inconsistent_equations_name_the_largest_residuals() -> None:
    x, a = state("x", 1.0, fixed=True), algebraic("a", 0.5)
    told = refused(handmade([x, a], {"x": x.d + x.s, "never": a.s**2 + x.s}))
    assert "never" in told


def test_a_residual_without_value_at_the_start_is_named() -> None:
    x, a = state("x", -1.0, fixed=True), algebraic("a", 0.5)
    told = refused(handmade([x, a], {"x": x.d + x.s, "root": a.s - casadi.sqrt(x.s)}))
    assert "root" in told and "no finite value" in told


def test_bounds_guide_the_iteration_but_do_not_bind_it() -> None:
    x = state("x", 1.0, fixed=True)
    a = algebraic("a", 0.5, min=0.0, max=10.0)
    result = start_of(handmade([x, a], {"x": x.d, "square": a.s**2 - 4.0 * x.s}))
    assert result.y[0, 1] == pytest.approx(2.0)
    b = algebraic("b", 0.5, min=0.0, max=1.0)
    result = start_of(handmade([x, b], {"x": x.d, "line": b.s - 3.0 * x.s}))
    assert result.y[0, 1] == pytest.approx(3.0)
    assert result.statistics.messages == ["initial values outside min and max: b = 3"]


def diode(voltage: float, guess: float) -> Handmade:
    """An ideal diode with 1 ohm in series: i = voltage or 0, whichever side `guess` starts on."""
    x, i, s = state("x", voltage, fixed=True), algebraic("i"), algebraic("s", guess)
    on = Relation("s > 0", s.s)
    v = casadi.if_else(on.s, 0.0, s.s)
    equations = {
        "source": x.d,
        "mesh": x.s - i.s - v,
        "diode": i.s - casadi.if_else(on.s, s.s, 0.0),
    }
    return handmade([x, i, s], equations, relations=[on])


@pytest.mark.parametrize("voltage", [5.0, -5.0])
@pytest.mark.parametrize("guess", [1.0, -1.0])
def test_modes_settle_whatever_side_they_start_on(voltage: float, guess: float) -> None:
    result = start_of(diode(voltage, guess))
    assert result.m[0, 0] == (voltage > 0.0)
    assert result.y[0, 1] == pytest.approx(max(voltage, 0.0), abs=1e-12)


def test_modes_without_a_side_that_holds_are_an_error() -> None:
    a = algebraic("a", 0.0)
    relation = Relation("a > 0", a.s)
    told = refused(handmade([a], {"flip": a.s - casadi.if_else(relation.s, -1.0, 1.0)}, relations=[relation]))
    assert "do not settle" in told and "a > 0" in told


def test_discrete_equations_hold_at_the_start() -> None:
    x = state("x", 2.0, fixed=True)
    gear, double = discrete("gear", 1.0), discrete("double", 0.0)
    fast = Relation("x > 1", x.s - 1.0)
    dae = handmade(
        [x, gear, double],
        {"x": x.d + gear.s},
        relations=[fast],
        always=[(double, 2.0 * gear.s), (gear, casadi.if_else(fast.s, 3.0, 1.0))],
    )
    result = start_of(dae)
    assert result.z[0].tolist() == [3.0, 6.0]
    assert result.yp[0, 0] == -3.0


def test_a_start_value_of_a_discrete_variable_can_be_set() -> None:
    x, count = state("x", 0.0, fixed=True), discrete("count", 4.0)
    dae = handmade([x, count], {"x": x.d - count.s})
    assert simulate(dae, stop_time=1.0, start={"count": 2.0}).y[-1, 0] == pytest.approx(2.0)
    assert assign(count, 0)[0] == "discrete"


def test_a_stiff_scale_between_unknowns_does_no_harm() -> None:
    p, q = state("p", 2e7, nominal=1e7, fixed=True), algebraic("q", 1e-5, nominal=1e-4)
    dae = handmade([p, q], {"volume": p.d + 1e14 * q.s, "orifice": q.s - 1e-8 * casadi.sqrt(p.s)})
    result = start_of(dae)
    assert result.y[0, 1] == pytest.approx(1e-8 * np.sqrt(2e7), rel=1e-12)
