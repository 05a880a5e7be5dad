"""Forward sensitivities against closed forms and central differences."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pytest

from arthur_acausal import Component, Table, UsageError, translate
from arthur_acausal.analysis.sensitivity import Sensitivities
from arthur_acausal.models.examples.jack import Jack
from tests.analysis.systems import Ball, LowPass, Oscillator, Switched

TOLERANCE = 1e-11  # a difference of two runs is off by their errors over STEP
STEP = 1e-4  # of the parameter, of the central differences


def compare(
    model: Component,
    stop_time: float,
    outputs: Sequence[str],
    parameters: Sequence[str],
    error: float,
    values: Mapping[str, float] | None = None,
) -> Sensitivities:
    """Compare with central differences at all times that are no event's, by the largest of each curve."""
    translation = translate(model)
    run = translation.simulate(stop_time, tolerance=TOLERANCE, parameters=values)
    found = translation.sensitivities(run, outputs, parameters)
    far = np.ones(run.t.size, dtype=bool)
    for event in run.events:
        far &= np.abs(run.t - event.time) > 10.0 * STEP * stop_time
    for path in parameters:
        value = run[path][0]
        around = [
            translation.simulate(
                stop_time,
                tolerance=TOLERANCE,
                parameters={**(values or {}), path: value * (1.0 + sign * STEP)},
            )
            for sign in (1.0, -1.0)
        ]
        for output in outputs:
            high, low = (other.at(run.t[far], output) for other in around)
            expected = (high - low) / (2.0 * STEP * value)
            size = np.abs(expected).max() or 1.0
            np.testing.assert_allclose(found[output, path][far], expected, rtol=0.0, atol=error * size)
    return found


def test_low_pass_in_closed_form() -> None:
    """v = 1 - exp(-t / (R C)), and tau = R C is a dependent parameter."""
    translation = translate(LowPass())
    run = translation.simulate(5e-3, tolerance=TOLERANCE)
    found = translation.sensitivities(run, ["v", "i", "tau"], ["R", "C"])
    t, R, C = run.t, 1e3, 1e-6
    decay = np.exp(-t / (R * C))
    np.testing.assert_allclose(found["v", "R"], -t / (R**2 * C) * decay, atol=1e-9)
    np.testing.assert_allclose(found["v", "C"], -t / (R * C**2) * decay, atol=1e-3)  # of 4e5
    np.testing.assert_allclose(found["i", "R"], (-1.0 / R**2 + t / (R**3 * C)) * decay, atol=1e-12)
    np.testing.assert_allclose(found["tau", "R"], C)


def test_a_dependent_parameter_that_is_given_stands_alone() -> None:
    translation = translate(LowPass())
    run = translation.simulate(5e-3, tolerance=TOLERANCE, parameters={"tau": 2e-3})
    found = translation.sensitivities(run, ["v"], ["C", "tau"])
    np.testing.assert_allclose(found["v", "C"], 0.0, atol=1e-12)
    np.testing.assert_allclose(found["v", "tau"], -run.t / 2e-3**2 * np.exp(-run.t / 2e-3), atol=1e-6)


def test_oscillator_by_differences() -> None:
    compare(Oscillator(), 3.0, ["x", "a"], ["m", "d", "k"], 5e-6)


def test_jack_by_differences() -> None:
    compare(Jack(), 0.05, ["load.v", "ram.p"], ["orifice.area", "ram.area", "load.m"], 1e-4)


def test_bouncing_ball_in_closed_form() -> None:
    """After one bounce: h = v_1 (t - t_1) - g (t - t_1)^2 / 2 with v_1 = e sqrt(2 g h_0), t_1 = sqrt(2 h_0 / g)."""
    translation = translate(Ball())
    run = translation.simulate(0.9, tolerance=TOLERANCE)
    found = translation.sensitivities(run, ["h", "v"], ["e", "h_0"])
    g, h_0, e = 9.81, 1.0, 0.7
    t_1 = (2.0 * h_0 / g) ** 0.5
    after = run.t > t_1 + 1e-9
    t = run.t[after]
    np.testing.assert_allclose(
        found["h", "e"][after], (2.0 * g * h_0) ** 0.5 * (t - t_1), rtol=1e-7, atol=1e-9
    )
    # v = v_1 - g (t - t_1): dv/dh_0 = e sqrt(g / (2 h_0)) + g dt_1/dh_0
    np.testing.assert_allclose(
        found["v", "h_0"][after], e * (g / 2.0) ** 0.5 + g * (1.0 / (2.0 * g)) ** 0.5, rtol=1e-7
    )
    np.testing.assert_allclose(found["v", "h_0"][run.t < t_1 - 1e-9], 0.0, atol=1e-12)


def test_events_of_states_and_time_with_discrete_values() -> None:
    found = compare(Switched(), 1.0, ["x", "z", "n"], ["k", "c", "T"], 5e-5)
    assert np.abs(found["n", "T"][-1]) > 0.1


def test_many_bounces_by_differences() -> None:
    compare(Ball(), 2.0, ["h"], ["g", "e", "h_0"], 1e-5, {"e": 0.8})


def test_inputs_are_those_of_the_run() -> None:
    translation = translate(Oscillator())
    force = Table([0.0, 0.5, 0.5, 2.0], [0.0, 0.0, 30.0, 30.0])
    run = translation.simulate(2.0, tolerance=TOLERANCE, inputs={"f": force})
    with pytest.raises(UsageError, match="does not keep the input f"):
        translation.sensitivities(run, ["x"], ["k"])
    found = translation.sensitivities(run, ["x"], ["k"], inputs={"f": force})["x", "k"]
    high, low = (
        translation.simulate(2.0, tolerance=TOLERANCE, inputs={"f": force}, parameters={"k": k})["x"]
        for k in (50.0 + 1e-3, 50.0 - 1e-3)
    )
    np.testing.assert_allclose(found, (high - low) / 2e-3, atol=1e-6)
