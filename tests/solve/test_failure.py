"""Runs that end early say why, and keep what they have computed."""

from __future__ import annotations

import signal
import sys
import threading
from typing import Any

import casadi
import numpy as np
import pytest

from arthur_acausal.errors import SimulationError
from arthur_acausal.solve.failure import SolverFailure, SolverInterrupted
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
    external,
    handmade,
    reinit,
    state,
)
from tests.solve.test_events import ball


def failed(dae: Handmade, stop_time: float = 2.0, **options: Any) -> tuple[str, Trajectory]:
    """The message and what was computed."""
    with pytest.raises(SolverFailure) as caught:
        simulate(dae, stop_time=stop_time, options=SolverOptions(**options))
    trajectory = caught.value.trajectory
    assert isinstance(caught.value, SimulationError) and trajectory is not None
    assert trajectory.status == "failed" and trajectory.message == str(caught.value)
    return str(caught.value), trajectory


def test_a_residual_that_loses_its_value_is_named_with_time_and_state(
    capsys: pytest.CaptureFixture[str],
) -> None:
    x, a = state("x", 1.0, fixed=True), algebraic("a", 1.0)
    told, kept = failed(handmade([x, a], {"drain": x.d + 1.0, "jet": a.s - casadi.sqrt(x.s)}))
    assert "an equation has no finite value" in told
    assert "jet; there x = -" in told and "at t = 1" in told
    assert 0.99 < kept.t[-1] <= 1.0 + 1e-6
    assert np.abs(kept.y[:, 0] - (1.0 - kept.t)).max() < 1e-6
    assert capsys.readouterr().out == ""  # IDA's binding prints; nothing of it gets through


def test_a_residual_without_value_on_the_way_is_no_failure() -> None:
    # a long first step leaves the range of the logarithm; shorter ones do not
    x = state("x", 1.0, fixed=True)
    dae = handmade([x], {"x": x.d + 5.0 * x.s + 1e-3 * casadi.log(x.s)})
    result = simulate(dae, stop_time=1.0, options=SolverOptions(rtol=1e-2, first_step=1.0))
    assert result.status == "finished"
    assert result.y[-1, 0] == pytest.approx(np.exp(-5.0), abs=2e-2)
    assert result.statistics.non_finite_residuals > 0
    assert "trial states had no finite residual" in result.statistics.messages[-1]


def test_a_jacobian_that_becomes_singular_names_its_unknown() -> None:
    x, a = state("x", 1.0, fixed=True), algebraic("a", 1.0)
    told, kept = failed(handmade([x, a], {"x": x.d + 1.0, "lever": x.s * a.s - 1.0}))
    assert "a" in told and "t = 1" in told
    assert kept.t[-1] < 1.0 + 1e-6


def test_a_state_that_runs_away_is_named() -> None:
    x, y = state("x", 1.0, fixed=True), state("y", 1.0, fixed=True)
    told, kept = failed(handmade([x, y], {"explosion": x.d - x.s**2, "calm": y.d + y.s}))
    assert "the error of x dominates" in told
    assert kept.t[-1] == pytest.approx(1.0, abs=2e-3)


def test_too_many_steps_are_reported_with_who_needs_them() -> None:
    x, y = state("x", 1.0, fixed=True), state("y", 0.0, fixed=True)
    dae = handmade([x, y], {"slow": x.d + x.s, "fast": y.d - 1000.0 * casadi.cos(1000.0 * TIME)})
    told, kept = failed(dae, max_steps=200)
    assert "more than 200 steps" in told and "the error of y dominates" in told and "max_steps" in told
    assert 0.0 < kept.t[-1] < 2.0


def test_a_discontinuity_without_event_is_told_with_its_variable() -> None:
    x = state("x", 0.0, fixed=True)
    jump = casadi.if_else(TIME < 0.5, 0.0, 1e12)
    told, kept = failed(handmade([x], {"x": x.d - jump}), rtol=1e-3)
    assert "as small as the rounding of time" in told and "the error of x dominates" in told
    assert kept.t[-1] == pytest.approx(0.5)


def integrator() -> Handmade:
    """x' = u from 0."""
    x, u = state("x", 0.0, fixed=True), external("u")
    return handmade([x, u], {"x": x.d - u.s})


def test_ctrl_c_keeps_what_was_computed() -> None:
    def one(t: float) -> float:
        if t > 0.5:
            signal.raise_signal(signal.SIGINT)
        return 1.0

    with pytest.raises(SolverInterrupted) as caught:
        simulate(integrator(), stop_time=1.0, inputs={"u": one}, options=SolverOptions(max_step=0.01))
    kept = caught.value.trajectory
    assert isinstance(caught.value, KeyboardInterrupt)
    assert kept.status == "interrupted"
    assert 0.4 < kept.t[-1] <= 0.5 + 1e-9
    assert np.abs(kept.y[:, 0] - kept.t).max() < 1e-9


def test_errors_of_the_program_pass_through() -> None:
    def bad(t: float) -> float:
        if t > 0.5:
            raise ZeroDivisionError("mine")
        return 1.0

    with pytest.raises(ZeroDivisionError, match="mine"):
        simulate(integrator(), stop_time=1.0, inputs={"u": bad})


def test_prints_of_the_model_still_reach_the_screen(capsys: pytest.CaptureFixture[str]) -> None:
    said: list[float] = []

    def chatty(t: float) -> float:
        if not said:
            print("hello")
            said.append(t)
        return 1.0

    simulate(integrator(), stop_time=1.0, inputs={"u": chatty})
    assert capsys.readouterr().out == "hello\n"


def test_runs_in_threads_give_standard_output_back() -> None:
    x, a = state("x", 1.0, fixed=True), algebraic("a", 1.0)
    dae = handmade([x, a], {"drain": x.d + 1.0, "jet": a.s - casadi.sqrt(x.s)})
    before, messages = sys.stdout, []

    def work() -> None:
        messages.append(failed(dae)[0])

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sys.stdout is before
    assert len(messages) == 4 and all("jet" in told for told in messages)


def test_a_zeno_run_ends_at_its_limit() -> None:
    told, kept = failed(ball(), stop_time=3.0)
    t0 = np.sqrt(2.0 / 9.81)
    assert "accumulate" in told and "Zeno" in told and "h < 0" in told
    assert kept.t[-1] == pytest.approx(t0 * 1.7 / 0.3, abs=1e-4)


def test_chattering_is_called_so() -> None:
    x = state("x", 0.5, fixed=True)
    above = Relation("x > 0", x.s)
    told, kept = failed(handmade([x], {"x": x.d + casadi.if_else(above.s, 1.0, -1.0)}, relations=[above]))
    assert "chattering at t = 0.5" in told and "x > 0" in told
    assert kept.t[-1] == pytest.approx(0.5, abs=1e-6)


def test_an_event_iteration_without_end_is_called_chattering() -> None:
    x, n = state("x", 0.0, fixed=True), discrete("n")
    up = Relation("x > 0.5", x.s - 0.5)
    dae = handmade([x, n], {"x": x.d - 1.0}, relations=[up], always=[(n, casadi.if_else(up.s, n.d + 1, 0))])
    told, kept = failed(dae)
    assert "chattering" in told and "discrete variable" in told
    assert kept.t[-1] == pytest.approx(0.5)


def test_a_relation_that_changes_unseen_is_an_error() -> None:
    # g is affine as long as z is 0; from 0.3 on it is not, against what the relation promises
    x, z = state("x", 0.0, fixed=True), discrete("z")
    g = casadi.if_else(z.s > 0, casadi.exp(20.0 * (0.3 - TIME)) - 0.2, TIME - 0.3)
    wrong = Relation("g > 0", g, time_only=True)
    dae = handmade(
        [x, z],
        {"x": x.d - wrong.s},
        relations=[wrong],
        whens=[When("w", wrong.s, [assign(z, 1.0)])],
    )
    told, kept = failed(dae, stop_time=0.9)
    assert "g > 0 changed" in told and "without an event" in told and "test.py:1" in told
    assert kept.t[-1] == 0.9


def test_a_reinit_that_leads_nowhere_names_the_equations() -> None:
    x, a = state("x", 1.0, fixed=True), algebraic("a", 1.0)
    low = Relation("x < 0.5", 0.5 - x.s)
    dae = handmade(
        [x, a],
        {"x": x.d + 1.0, "root": a.s**2 - x.s},
        relations=[low],
        whens=[When("w", low.s, [reinit(x, -1.0)])],
    )
    told, kept = failed(dae)
    assert "at t = 0.5 s" in told and "root" in told
    assert kept.t[-1] == pytest.approx(0.5)
