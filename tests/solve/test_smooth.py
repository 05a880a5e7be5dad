"""Systems without events against closed forms and published reference values."""

from __future__ import annotations

from itertools import pairwise

import casadi
import numpy as np
import pytest

from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.simulate import simulate
from arthur_acausal.solve.trajectory import Trajectory
from tests.solve.handmade import TIME, Handmade, algebraic, external, handmade, state

RTOLS = (1e-4, 1e-6, 1e-8, 1e-10)


def oscillator() -> Handmade:
    """x'' = -x from x = 1 at rest: x = cos t, and x^2 + v^2 = 1."""
    x, v = state("x", 1.0, fixed=True), state("v", 0.0, fixed=True)
    return handmade([x, v], {"kinematics": x.d - v.s, "spring": v.d + x.s})


def robertson() -> Handmade:
    """Robertson (1966), with the conservation of mass as an algebraic equation."""
    a, b, c = state("a", 1.0), state("b", 0.0, nominal=1e-5), algebraic("c")
    rate = -0.04 * a.s + 1e4 * b.s * c.s
    return handmade(
        [a, b, c],
        {"a": a.d - rate, "b": b.d + rate + 3e7 * b.s**2, "mass": a.s + b.s + c.s - 1.0},
    )


def akzo() -> Handmade:
    """Chemical Akzo Nobel problem, index 1; Test Set for IVP Solvers (Mazzia and Magherini), problem II-10."""
    start = {"y1": 0.444, "y2": 0.00123, "y3": 0.0, "y4": 0.007, "y5": 0.0}
    ys = [state(path, value, nominal=0.01) for path, value in start.items()]
    y6 = algebraic("y6", 0.3, nominal=0.01)
    y1, y2, y3, y4, y5 = (y.s for y in ys)
    r1, r2, r3 = 18.7 * y1**4 * casadi.sqrt(y2), 0.58 * y3 * y4, 0.58 / 34.4 * y1 * y5
    r4, r5 = 0.09 * y1 * y4**2, 0.42 * y6.s**2 * casadi.sqrt(y2)
    f_in = 3.3 * (0.9 / 737.0 - y2)
    rates = [
        -2.0 * r1 + r2 - r3 - r4,
        -0.5 * r1 - r4 - 0.5 * r5 + f_in,
        r1 - r2 + r3,
        -r2 + r3 - 2.0 * r4,
        r2 - r3 + r5,
    ]
    equations = {y.path: y.d - rate for y, rate in zip(ys, rates, strict=True)}
    return handmade([*ys, y6], equations | {"y6": 115.83 * y1 * y4 - y6.s})


# End values: Test Set for IVP Solvers, release 2.4, computed by RADAU5 in quadruple precision.
ROBERTSON_END = (1e11, [2.083340149701255e-08, 8.333360770334713e-14, 0.999999979166505])
AKZO_END = (
    180.0,
    [
        0.1150794920661702,
        0.001203831471567715,
        0.1611562887407974,
        0.0003656156421249283,
        0.01708010885264404,
        0.004873531310307455,
    ],
)


def run(dae: Handmade, stop_time: float, rtol: float, **options: object) -> Trajectory:
    """Simulate with some options."""
    return simulate(dae, stop_time=stop_time, options=SolverOptions(rtol=rtol).replace(**options))


def test_exponential_decay_is_within_the_tolerance() -> None:
    x = state("x", 1.0, fixed=True)
    decay = handmade([x], {"decay": x.d + 3.0 * x.s})
    for rtol in RTOLS:
        result = run(decay, 2.0, rtol)
        assert np.abs(result.y[:, 0] - np.exp(-3.0 * result.t)).max() < 10.0 * rtol
        assert np.abs(result.yp[:, 0] + 3.0 * np.exp(-3.0 * result.t)).max() < 300.0 * rtol


def test_oscillator_converges_and_keeps_its_energy() -> None:
    errors = []
    for rtol in RTOLS:
        result = run(oscillator(), 20.0, rtol)
        errors.append(np.abs(result.y[:, 0] - np.cos(result.t)).max())
        assert np.abs((result.y**2).sum(axis=1) - 1.0).max() < 200.0 * rtol
    assert all(error < 100.0 * rtol for error, rtol in zip(errors, RTOLS, strict=True))
    assert all(later < 0.2 * earlier for earlier, later in pairwise(errors))


def test_the_error_at_the_end_is_proportional_to_the_tolerance() -> None:
    """Over many tolerances, for a single run's error scatters. Unmended, it grows by 10^(4/6) in four decades."""

    def error_over_tolerance(decade: float) -> float:
        ratios = []
        for rtol in np.geomspace(decade, 10.0 * decade, 8):
            x, v = simulate(oscillator(), stop_time=20.0, options=SolverOptions(rtol=rtol, intervals=1)).y[-1]
            ratios.append(np.hypot(x - np.cos(20.0), v + np.sin(20.0)) / rtol)
        return float(np.exp(np.mean(np.log(ratios))))

    loose = error_over_tolerance(1e-6)
    assert error_over_tolerance(1e-10) < 2.5 * loose
    assert error_over_tolerance(1e-11) < 2.5 * loose


def test_robertson_reaches_the_reference() -> None:
    stop_time, reference = ROBERTSON_END
    errors = []
    for rtol in (1e-6, 1e-8, 1e-10):
        options = SolverOptions(rtol=rtol, atol={"b": 1e-14 * rtol, "a": 1e-8 * rtol}, intervals=10)
        result = simulate(robertson(), stop_time=stop_time, options=options)
        errors.append(np.abs(result.y[-1] / reference - 1.0).max())
        assert np.abs(result.y.sum(axis=1) - 1.0).max() < 1e-9
    assert errors[-1] < 1e-5
    assert errors[-1] < errors[0]


def test_akzo_reaches_the_reference() -> None:
    stop_time, reference = AKZO_END
    errors = [
        np.abs(run(akzo(), stop_time, rtol, atol=1e-6 * rtol).y[-1] / reference - 1.0).max()
        for rtol in (1e-5, 1e-7, 1e-10)
    ]
    assert errors[2] < 1e-8
    assert errors[2] < errors[1] < errors[0]


def test_dense_and_sparse_solvers_agree() -> None:
    dense, sparse = (run(akzo(), 180.0, 1e-8, linear_solver=solver) for solver in ("dense", "sparse"))
    assert (dense.statistics.linear_solver, sparse.statistics.linear_solver) == ("dense", "sparse")
    assert np.abs(dense.y / sparse.y[-1] - sparse.y / sparse.y[-1]).max() < 1e-5


def test_a_long_chain_goes_the_sparse_way_and_ends_in_its_steady_state() -> None:
    n = 300
    xs = [state(f"x[{i}]", 0.0, fixed=True) for i in range(n)]
    left = [1.0, *(x.s for x in xs[:-1])]
    right = [*(x.s for x in xs[1:]), 0.0]
    equations = {x.path: x.d - n**2 * (a - 2.0 * x.s + b) for x, a, b in zip(xs, left, right, strict=True)}
    result = run(handmade(xs, equations), 5.0, 1e-6)
    assert result.statistics.linear_solver == "sparse"
    exact = 1.0 - np.arange(1, n + 1) / (n + 1)
    assert np.abs(result.y[-1] - exact).max() < 1e-5


def test_a_long_index_one_chain_initialises_the_sparse_way() -> None:
    n = 300
    source = state("source", 1.0, fixed=True)
    vs = [algebraic(f"v[{i}]") for i in range(n)]
    left, right = [source.s, *(v.s for v in vs[:-1])], [*(v.s for v in vs[1:]), 0.0]
    equations = {v.path: a - 2.0 * v.s + b for v, a, b in zip(vs, left, right, strict=True)}
    result = run(handmade([source, *vs], {"source": source.d + source.s} | equations), 1.0, 1e-6)
    exact = 1.0 - np.arange(1, n + 1) / (n + 1)
    assert np.abs(result.y[0, 1:] - exact).max() < 1e-12
    assert np.abs(result.y[-1, 1:] - np.exp(-1.0) * exact).max() < 1e-5


def test_statistics_count_what_the_integrator_did() -> None:
    result = run(oscillator(), 20.0, 1e-6, store_steps=True)
    s = result.statistics
    assert s.steps == len(result.t) - 1  # the stored steps are IDA's own
    assert s.residual_evaluations >= s.steps > s.jacobian_evaluations > 0
    assert s.unknowns == 2 and s.restarts == 0 and s.events == 0
    assert s.us_per_residual_call > 0.0
    assert {"steps", "messages", "us_per_residual_call", "integrate_s"} <= set(s.as_dict())


def test_the_output_grid_is_what_was_asked_for() -> None:
    default = run(oscillator(), 1.0, 1e-6)
    assert np.array_equal(default.t, np.linspace(0.0, 1.0, 501))
    assert np.array_equal(run(oscillator(), 1.0, 1e-6, intervals=1).t, [0.0, 1.0])
    uneven = run(oscillator(), 1.0, 1e-6, output_interval=0.3)
    assert np.allclose(uneven.t, [0.0, 0.3, 0.6, 0.9, 1.0], rtol=0, atol=1e-15)
    shifted = simulate(oscillator(), start_time=-2.0, stop_time=3.0, options=SolverOptions(intervals=5))
    assert np.array_equal(shifted.t, [-2.0, -1.0, 0.0, 1.0, 2.0, 3.0])
    assert np.abs(shifted.y[:, 0] - np.cos(shifted.t + 2.0)).max() < 1e-4


def test_max_step_and_first_step_are_heeded() -> None:
    result = run(oscillator(), 1.0, 1e-4, store_steps=True, max_step=0.01)
    assert np.diff(result.t).max() < 0.0101
    result = run(oscillator(), 1.0, 1e-4, store_steps=True, first_step=1e-6)
    assert result.t[1] <= 1e-6


def test_a_start_where_the_second_derivative_is_zero() -> None:
    """A sine's first step, estimated where it is straight, is a million times too long at a tight tolerance."""
    s = algebraic("s", 0.0)
    wave = handmade([s], {"sine": s.s - 1e6 * casadi.sin(100.0 * np.pi * TIME)})
    result = simulate(wave, stop_time=0.1, options=SolverOptions(rtol=1e-9, intervals=4))
    assert result.y[:, 0] == pytest.approx(1e6 * np.sin(100.0 * np.pi * result.t), abs=1e-2)
    assert result.statistics.rejected_steps > 10


def test_parameters_and_start_values_are_set_for_one_run() -> None:
    k = casadi.SX.sym("k")
    x = state("x", 1.0, fixed=True)
    decay = handmade([x], {"decay": x.d + k * x.s}, parameters={"k": (k, 1.0)})
    result = simulate(decay, stop_time=1.0, parameters={"k": 2.0}, start={"x": 3.0})
    assert result.y[0, 0] == 3.0
    assert result.y[-1, 0] == pytest.approx(3.0 * np.exp(-2.0), rel=1e-4)
    assert simulate(decay, stop_time=1.0).y[-1, 0] == pytest.approx(np.exp(-1.0), rel=1e-4)


def test_a_model_without_unknowns_runs() -> None:
    result = simulate(handmade([], {}), stop_time=1.0, options=SolverOptions(intervals=4))
    assert result.t.tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert result.y.shape == (5, 0)


def test_progress_is_reported_in_order() -> None:
    seen: list[float] = []
    x = state("x", 0.0, fixed=True)
    u = external("u")
    dae = handmade([x, u], {"x": x.d - casadi.cos(50.0 * TIME) - u.s})

    def slow(t: float) -> float:
        sum(range(20000))  # so that the run takes longer than a report's interval
        return 0.0

    simulate(dae, stop_time=10.0, inputs={"u": slow}, progress=seen.append)
    assert seen and all(0.0 <= t <= 10.0 for t in seen)
    assert seen == sorted(seen)
