"""The pendulum's closed form against a numerical solution, and one run."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from arthur_acausal import translate
from benchmarks.pendulum import SPIN, G, Pendulum, exact_angle


@pytest.mark.parametrize(("degrees", "speed"), [(7.5, 0.0), (172.5, 0.0), (187.5, 0.0), (0.0, SPIN)])
def test_the_closed_form_agrees_with_a_numerical_solution(degrees: float, speed: float) -> None:
    angle = math.radians(degrees)
    solved = solve_ivp(
        lambda t, a: [a[1], -G * np.sin(a[0])], (0.0, 5.0), [angle, speed], "DOP853", rtol=1e-12, atol=1e-12
    )
    off = math.remainder(exact_angle(angle, speed, 5.0) - solved.y[0, -1], 2.0 * math.pi)
    assert abs(off) < 1e-8


def test_the_pendulum_swings_over_the_horizontal_as_the_closed_form_says() -> None:
    angle = math.radians(97.5)
    start = {"x": math.sin(angle), "y": -math.cos(angle), "vx": 0.0, "vy": 0.0}
    solution = translate(Pendulum()).simulate(2.0, tolerance=1e-9, start=start)
    found = math.atan2(solution.final("x"), -solution.final("y"))
    assert found == pytest.approx(exact_angle(angle, 0.0, 2.0), abs=1e-6)
    assert np.abs(np.hypot(solution["x"], solution["y"]) - 1.0).max() < 1e-12
