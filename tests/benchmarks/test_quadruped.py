"""The robot's benchmark: the C program integrates the same equations as ours."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from benchmarks.quadruped import cost_at
from benchmarks.quadruped_equations import explicit
from benchmarks.quadruped_fixed import Program, compiled
from benchmarks.quadruped_problem import Problem, problem

TICKS = 2
DURATION = 0.002 * TICKS


@pytest.fixture(scope="module")
def trot() -> Problem:
    return problem(0.05, DURATION)


@pytest.fixture(scope="module")
def program(trot: Problem) -> Iterator[Program]:
    with compiled(trot) as made:
        yield made


def test_explicit_rates_fulfil_the_residual_at_random_states(trot: Problem) -> None:
    dae, begin, rng = trot.translation.dae, trot.begin, np.random.default_rng(0)
    equations, evaluator = explicit(trot), dae.evaluator()
    body = dae.calls[0].function.fresh()
    n = int(np.sum(dae.differential))
    evaluator.t[0], evaluator.z[:], evaluator.m[:] = begin.t[-1], begin.z[-1], begin.m[-1]
    for _ in range(5):
        y = begin.y[-1] * (1.0 + 1e-2 * rng.standard_normal(dae.n))
        w = np.concatenate([begin.yp[-1, :n], y[n:]])
        given = begin.t[-1], y[:n], begin.z[-1]
        a = np.zeros(body.n_outputs)
        body.evaluate(np.array(equations.forces(*given, a, w)).ravel(), a)
        for _ in range(4):  # Newton's iteration
            w = np.array(equations.rates(*given, a, w)).ravel()
        evaluator.y[:], evaluator.yp[:n] = np.concatenate([y[:n], w[n:]]), w[:n]
        evaluator.yp[n:] = 0.0
        left = evaluator.residual().copy()
        evaluator.yp[:n] = 0.0
        assert np.all(np.abs(left) <= 1e-11 * np.maximum(np.abs(evaluator.residual()), 1.0))


def test_runge_kutta_in_c_and_our_integration_agree(trot: Problem, program: Program) -> None:
    ours = trot.ours(1e-8).joints
    assert np.max(np.abs(ours[-1] - ours[0])) > 1e-5  # it moves
    assert np.max(np.abs(program.run("rk4", 1e-6).joints - ours)) < 1e-8


@pytest.mark.parametrize(("method", "order"), [("euler", 1), ("semi", 1), ("ros1", 1), ("ros2", 2)])
def test_orders_of_the_methods(method: str, order: int, program: Program) -> None:
    exact = program.states("rk4", 2e-6, 0.002, 1, 1)[0][1]
    coarse, fine = (program.states(method, h, 0.002, 4, 1)[0][1] for h in (1e-5, 5e-6))
    ratio = np.linalg.norm(coarse - exact) / np.linalg.norm(fine - exact)
    assert ratio == pytest.approx(2.0**order, rel=0.15)


def test_cosimulation_comes_nearer_with_more_exchanges(program: Program, trot: Problem) -> None:
    exact = program.run("rk4", 1e-5).joints
    off = [np.abs(program.run("cosim", 1e-5, exchange=h).joints - exact).max() for h in (1e-3, 1e-4, 1e-5)]
    assert off[0] > 4.0 * off[1] > 16.0 * off[2]


def test_cost_at_an_error() -> None:
    def runs(method: str, *points: tuple[float, float | None]) -> list[dict[str, object]]:
        return [{"method": method, "cpu_s_per_s": c, "error_rad": e} for c, e in points]

    line = runs("line", (4.0, 1e-6), (1.0, 1e-4), (0.1, None))
    assert cost_at(line, 1e-5) == pytest.approx(2.0)  # half the way, in logarithms
    assert cost_at(line, 1e-3) == pytest.approx(1.0)  # what is more exact will do
    assert cost_at(line, 1e-7) == float("inf")
    assert cost_at(line + runs("point", (1.5, 1e-6), (0.2, 1e-2)), 1e-5) < 1.5
