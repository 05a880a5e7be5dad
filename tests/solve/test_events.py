"""State and time events."""

from __future__ import annotations

import casadi
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.simulate import simulate
from arthur_acausal.solve.trajectory import Trajectory
from tests.solve.handmade import (
    TIME,
    Handmade,
    Relation,
    When,
    algebraic,
    assign,
    discrete,
    handmade,
    reinit,
    state,
    terminate,
)

G = 9.81


def times(result: Trajectory, kind: str = "when") -> list[float]:
    """Times of the events of one kind."""
    return [event.time for event in result.events if event.kind == kind]


def ball(e: float = 0.7) -> Handmade:
    """A ball dropped from 1 m that keeps e of its speed at each bounce, and counts."""
    h, v, n = state("h", 1.0, fixed=True), state("v", 0.0, fixed=True), discrete("n")
    below = Relation("h < 0", -h.s)
    bounce = When("when h < 0", below.s, [reinit(v, -e * v.s), assign(n, n.d + 1)])
    return handmade([h, v, n], {"kinematics": h.d - v.s, "fall": v.d + G}, relations=[below], whens=[bounce])


def bounces(e: float, count: int) -> list[float]:
    """The exact times: t0 = sqrt(2 h / g), then each flight takes e times as long as the one before."""
    t0 = np.sqrt(2.0 / G)
    return [t0 + 2.0 * t0 * sum(e**k for k in range(1, n + 1)) for n in range(count)]


@pytest.mark.parametrize(("rtol", "error"), [(1e-4, 1e-6), (1e-6, 1e-9), (1e-8, 1e-10)])
def test_bounces_are_found_in_time(rtol: float, error: float) -> None:
    result = simulate(ball(), stop_time=2.48, options=SolverOptions(rtol=rtol))
    assert np.abs(np.array(times(result)) - bounces(0.7, 10)).max() < error
    assert result.z[-1, 0] == 10.0
    assert result.statistics.state_events == 10  # leaving the ground is no second event


def test_the_two_rows_of_an_event_show_before_and_after() -> None:
    result = simulate(ball(), stop_time=1.0)
    row = int(np.flatnonzero(np.diff(result.t) == 0.0)[0])
    assert result.y[row + 1, 1] == pytest.approx(-0.7 * result.y[row, 1])
    assert result.z[row : row + 2, 0].tolist() == [0.0, 1.0]
    assert result.y[row, 1] == pytest.approx(-np.sqrt(2.0 * G), rel=1e-6)
    assert [e.what for e in result.events] == ["h < 0 became true", "when h < 0"]


def test_an_elastic_ball_keeps_its_energy() -> None:
    result = simulate(ball(1.0), stop_time=20.0, options=SolverOptions(rtol=1e-8))
    energy = G * result.y[:, 0] + result.y[:, 1] ** 2 / 2.0
    assert result.z[-1, 0] == 22.0
    assert np.abs(energy / G - 1.0).max() < 1e-5


def ramp(offset: float, *, inclusive: bool = False, start: float = 0.0, rate: float = 1.0) -> Handmade:
    """x' = rate, and n counts how often x > offset (or x >= offset) becomes true."""
    x, n = state("x", start, fixed=True), discrete("n")
    above = Relation("x > offset", x.s - offset, inclusive=inclusive)
    return handmade(
        [x, n],
        {"x": x.d - rate},
        relations=[above],
        whens=[When("when x > offset", above.s, [assign(n, n.d + 1)])],
    )


def test_a_relation_that_is_exactly_zero_at_the_start() -> None:
    strict = simulate(ramp(0.0), stop_time=1.0)  # false at 0, true just after: an event at 0
    assert times(strict) == [0.0] and strict.z[-1, 0] == 1.0
    inclusive = simulate(ramp(0.0, inclusive=True), stop_time=1.0)  # true at 0 already: no event
    assert not inclusive.events
    falling = simulate(ramp(0.0, inclusive=True, rate=-1.0), stop_time=1.0)  # true at 0, false just after
    assert times(falling, "state") == [0.0] and falling.z[-1, 0] == 0.0
    still = simulate(ramp(0.0, rate=0.0), stop_time=1.0)
    assert not still.events


def test_an_event_at_stop_time_still_happens_once() -> None:
    result = simulate(ramp(1.0), stop_time=1.0)
    assert len(times(result)) <= 1
    past = simulate(ramp(1.0 - 1e-9), stop_time=1.0)
    assert times(past) == pytest.approx([1.0 - 1e-9], abs=1e-12)
    assert past.t[-1] == 1.0 and past.status == "finished"


@given(offset=st.floats(1e-6, 0.999), rate=st.floats(0.5, 1e3), inclusive=st.booleans())
def test_crossings_are_found_wherever_they_are(offset: float, rate: float, inclusive: bool) -> None:
    result = simulate(
        ramp(offset, inclusive=inclusive, rate=rate), stop_time=2.0, options=SolverOptions(intervals=2)
    )
    assert times(result) == pytest.approx([offset / rate], rel=1e-9, abs=1e-12)
    assert result.z[-1, 0] == 1.0


@given(moments=st.lists(st.integers(1, 99), min_size=1, max_size=6, unique=True))
def test_time_events_are_met_exactly_wherever_they_are(moments: list[int]) -> None:
    n, x = discrete("n"), state("x", 0.0, fixed=True)
    at = sorted(k / 100 for k in moments)
    relations = [Relation(f"time >= {t}", TIME - t, inclusive=True, time_only=True) for t in at]
    whens = [When(r.label, r.s, [assign(n, n.d + 1)]) for r in relations]
    dae = handmade([x, n], {"x": x.d - n.s}, relations=relations, whens=whens)
    result = simulate(dae, stop_time=1.0, options=SolverOptions(intervals=3))
    assert times(result) == at
    assert result.y[-1, 0] == pytest.approx(sum(1.0 - t for t in at), abs=1e-9)


def test_simultaneous_events_are_one_instant() -> None:
    x, y, n, both = state("x", 0.0), state("y", 1.0), discrete("n"), discrete("both")
    up, down = Relation("x > 0.5", x.s - 0.5), Relation("y < 0.5", 0.5 - y.s)
    dae = handmade(
        [x, y, n, both],
        {"x": x.d - 1.0, "y": y.d + 1.0},
        relations=[up, down],
        whens=[
            When("up", up.s, [assign(n, n.d + 1)]),
            When("down", down.s, [assign(both, both.d + n.s)]),
        ],
    )
    result = simulate(dae, stop_time=1.0)
    assert result.statistics.events == 1
    assert times(result) == pytest.approx([0.5, 0.5], abs=1e-12)
    assert result.z[-1].tolist() == [1.0, 1.0]  # `both` sees the n of the same instant


def test_a_discrete_variable_sets_off_the_next_when_at_the_same_instant() -> None:
    x, armed, fired = state("x", 0.0), discrete("armed"), discrete("fired")
    up = Relation("x > 0.5", x.s - 0.5)
    dae = handmade(
        [x, armed, fired],
        {"x": x.d - 1.0},
        relations=[up],
        whens=[
            When("fire", armed.s, [assign(fired, fired.d + 1), reinit(x, 10.0)]),
            When("arm", up.s, [assign(armed, 1.0)]),
        ],
    )
    result = simulate(dae, stop_time=1.0)
    assert [e.what for e in result.events] == ["x > 0.5 became true", "arm", "fire"]
    assert result.z[-1].tolist() == [1.0, 1.0]
    assert result.y[-1, 0] == pytest.approx(10.5)


def test_pre_is_the_value_before_the_event() -> None:
    x, a, b = state("x", 0.0), discrete("a", 1.0), discrete("b", 2.0)
    up = Relation("x > 0.5", x.s - 0.5)
    swap = When("swap", up.s, [assign(a, b.d), assign(b, a.d)])
    result = simulate(handmade([x, a, b], {"x": x.d - 1.0}, relations=[up], whens=[swap]), stop_time=1.0)
    assert result.z[-1].tolist() == [2.0, 1.0]


def test_terminate_ends_the_run_with_its_message() -> None:
    x = state("x", 0.0)
    up = Relation("x > 0.5", x.s - 0.5)
    result = simulate(
        handmade([x], {"x": x.d - 1.0}, relations=[up], whens=[When("end", up.s, [terminate("far enough")])]),
        stop_time=1.0,
    )
    assert (result.status, result.message) == ("terminated", "far enough")
    assert result.t[-1] == pytest.approx(0.5, abs=1e-12)


def test_a_time_event_is_met_exactly_and_only_once() -> None:
    x, n = state("x", 0.0), discrete("n")
    late = Relation("time >= 0.3", TIME - 0.3, inclusive=True, time_only=True)
    dae = handmade(
        [x, n],
        {"x": x.d - casadi.if_else(late.s, 2.0, 0.0)},
        relations=[late],
        whens=[When("late", late.s, [assign(n, n.d + 1)])],
    )
    result = simulate(dae, stop_time=1.0)
    assert times(result) == [0.3]
    assert result.y[-1, 0] == pytest.approx(1.4, abs=1e-12)
    assert (result.t == 0.3).sum() == 2
    assert result.statistics.root_evaluations == 0


def test_sampling_by_a_time_that_moves_on() -> None:
    # x is sampled every 0.1 s into a held value; exact: x = t^2 at the samples
    x, held, following = state("x", 0.0, fixed=True), discrete("held"), discrete("next", 0.1)
    due = Relation("time >= next", TIME - following.s, inclusive=True, time_only=True)
    sample = When("sample", due.s, [assign(held, x.s), assign(following, following.d + 0.1)])
    dae = handmade([x, held, following], {"x": x.d - 2.0 * TIME}, relations=[due], whens=[sample])
    result = simulate(dae, stop_time=1.0)
    assert np.allclose(times(result), 0.1 * np.arange(1, 10 + 1)[: len(times(result))], rtol=0, atol=1e-15)
    assert len(times(result)) in (9, 10)  # 0.1 added ten times is just below 1
    assert result.z[-1, 0] == pytest.approx(round(10 * result.z[-1, 1] - 1) ** 2 / 100.0, abs=1e-6)


def test_time_events_closer_than_rounding_are_one() -> None:
    n, m = discrete("n"), discrete("m")
    x = state("x", 0.0)
    first = Relation("a", TIME - 0.3, time_only=True)
    second = Relation("b", TIME - (0.1 + 0.2), time_only=True)
    whens = [When("a", first.s, [assign(n, n.d + 1)]), When("b", second.s, [assign(m, m.d + 1)])]
    result = simulate(handmade([x, n, m], {"x": x.d}, relations=[first, second], whens=whens), stop_time=1.0)
    assert result.statistics.events == 1
    assert result.z[-1].tolist() == [1.0, 1.0]


@pytest.mark.parametrize("declared", [False, True])
def test_relations_of_time_that_are_not_affine_are_found_as_roots(declared: bool) -> None:
    n = discrete("n")
    sine = Relation("sin(time) > 0.5", casadi.sin(TIME) - 0.5, time_only=declared)
    dae = handmade([n], {}, relations=[sine], whens=[When("up", sine.s, [assign(n, n.d + 1)])])
    result = simulate(dae, stop_time=10.0)
    a = np.arcsin(0.5)
    assert times(result, "state") == pytest.approx([a, np.pi - a, a + 2 * np.pi, 3 * np.pi - a], abs=1e-9)


def test_a_rectifier_switches_between_its_modes() -> None:
    # i = max(sin t, 0) through an ideal diode with 1 ohm, s parametrises its two branches; q collects the charge
    q, i, s = state("q", 0.0, fixed=True), algebraic("i"), algebraic("s", 0.1)
    on = Relation("s > 0", s.s)
    equations = {
        "charge": q.d - i.s,
        "mesh": casadi.sin(TIME) - i.s - casadi.if_else(on.s, 0.0, s.s),
        "diode": i.s - casadi.if_else(on.s, s.s, 0.0),
    }
    dae = handmade([q, i, s], equations, relations=[on])
    result = simulate(dae, stop_time=6.0 * np.pi, options=SolverOptions(rtol=1e-8))
    assert np.abs(result.y[:, 1] - np.maximum(np.sin(result.t), 0.0)).max() < 1e-6
    assert result.y[-1, 0] == pytest.approx(6.0, abs=1e-6)
    assert 5 <= result.statistics.state_events <= 7


def test_events_that_concern_discrete_variables_only_do_not_restart() -> None:
    # Scalable Test Suite, ManyEvents (Casella): x[i] = M t / (N + 1 - i) passes 1 at (N + 1 - i) / M
    N, M = 40, 10
    xs, seen, total = (
        [state(f"x[{i}]") for i in range(N)],
        [discrete(f"e[{i}]") for i in range(N)],
        discrete("v"),
    )
    above = [Relation(f"x[{i}] > 1", x.s - 1.0) for i, x in enumerate(xs)]
    whens = [When("seen", r.s, [assign(e, 1.0)]) for r, e in zip(above, seen, strict=True)]
    whens += [When("count", e.s, [assign(total, total.d + 1)]) for e in seen]
    equations = {x.path: x.d - M / (N - i) for i, x in enumerate(xs)}
    result = simulate(handmade([*xs, *seen, total], equations, relations=above, whens=whens), stop_time=1.0)
    exact = [(k + 1) / M for k in range(M - 1)]
    assert times(result, "state") == pytest.approx(exact, abs=1e-9)
    assert result.z[-1, -1] == M - 1
    assert result.statistics.restarts <= 1
    assert np.abs(result.y[-1] - [M / (N - i) for i in range(N)]).max() < 1e-9


def test_a_when_at_the_start_needs_a_change() -> None:
    x, n = state("x", 2.0), discrete("n")
    above = Relation("x > 1", x.s - 1.0)
    dae = handmade([x, n], {"x": x.d}, relations=[above], whens=[When("w", above.s, [assign(n, n.d + 1)])])
    assert simulate(dae, stop_time=1.0).z[-1, 0] == 0.0


def test_many_events_in_a_long_run_are_all_found() -> None:
    x, v, n = state("x", 0.0, fixed=True), state("v", 1.0, fixed=True), discrete("n")
    up = Relation("x > 0.5", x.s - 0.5)
    dae = handmade(
        [x, v, n],
        {"kinematics": x.d - v.s, "spring": v.d + x.s},
        relations=[up],
        whens=[When("w", up.s, [assign(n, n.d + 1)])],
    )
    result = simulate(dae, stop_time=200.0, options=SolverOptions(rtol=1e-9))
    exact = np.pi / 6.0 + 2.0 * np.pi * np.arange(32)
    assert np.abs(np.array(times(result)) - exact).max() < 1e-5
    assert result.z[-1, 0] == 32.0
    assert result.statistics.state_events == 64


def test_a_kink_at_the_event_itself_is_a_change_of_the_law() -> None:
    """v = 1000 s and, above zero, 1 s: both agree at s = 0, where the event is, but only one of them holds after it."""
    a, b = algebraic("a"), algebraic("b")
    blocks = Relation("a < 0", -a.s)
    slope = casadi.if_else(blocks.s, 1.0, 1e-3)
    rows = {
        "a": slope * a.s - casadi.sin(2 * np.pi * TIME) + 0.5,
        "b": 1e-3 * b.s - casadi.sin(2 * np.pi * TIME),
    }
    result = simulate(
        handmade([a, b], rows, relations=[blocks]), stop_time=1.0, options=SolverOptions(intervals=2000)
    )
    exact = np.sin(2 * np.pi * result.t) - 0.5
    assert result.y[:, 0] == pytest.approx(np.where(exact < 0, exact, 1e3 * exact), abs=2e-3)
    assert result.statistics.restarts == 2
