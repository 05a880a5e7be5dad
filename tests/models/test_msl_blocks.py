"""Block diagrams of the Modelica Standard Library against closed forms and published figures."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import signal

from arthur_acausal import Solution, SolverOptions, simulate
from arthur_acausal.components.blocks.filters import CUT, low_pass_poles
from arthur_acausal.models.conformance.msl_blocks import CASES

PRECISE = SolverOptions(rtol=1e-9, intervals=900)
KINDS = {
    "CriticalDamping": "critical damping",
    "Bessel": "Bessel",
    "Butterworth": "Butterworth",
    "ChebyshevI": "Chebyshev I",
}


def run(name: str, stop_time: float) -> Solution:
    return simulate(CASES[f"msl_Blocks_{name}"].model(), stop_time=stop_time, options=PRECISE)


def poles(kind: str, order: int) -> np.ndarray:
    real, pairs = low_pass_poles(kind, order, 0.5, normalized=True)
    return np.array([*real, *pairs, *np.conj(pairs)])


@pytest.mark.parametrize("kind", KINDS.values())
@pytest.mark.parametrize("order", [1, 2, 3, 4, 5])
def test_a_filter_falls_to_3_dB_at_its_cut_off(kind: str, order: int) -> None:
    p = poles(kind, order)
    assert abs(np.prod(-p) / np.prod(1j - p)) == pytest.approx(CUT, rel=1e-9)


def test_filters_answer_a_step_as_their_transfer_functions_do() -> None:
    solution = run("Filter", 0.9)
    t = 0.016 * np.arange(50)
    for name, kind in KINDS.items():
        p = 4 * np.pi * poles(kind, 3)
        y: Any = signal.step(signal.ZerosPolesGain([], p, np.prod(-p).real), T=t)[1]
        assert solution.at(0.1 + t, f"{name}.y") == pytest.approx(0.1 + y.real, abs=1e-6), name


def test_derivatives_of_a_filter_up_to_its_order() -> None:
    solution = run("FilterWithDifferentiation", 0.9)
    t = 0.025 * np.arange(28)
    p = 4 * np.pi * poles("Bessel", 3)
    first: Any = signal.impulse(signal.ZerosPolesGain([], p, np.prod(-p).real), T=t)[1]
    second: Any = signal.impulse(signal.ZerosPolesGain([0.0], p, np.prod(-p).real), T=t)[1]
    assert solution.at(0.1 + t, "der1.y") == pytest.approx(first.real, abs=1e-4)
    assert solution.at(0.1 + t[1:], "der2.y") == pytest.approx(second.real[1:], abs=2e-2)


def test_a_rise_time_is_kept_as_published() -> None:
    """Documentation of FilterWithRiseTime: 94.7, 98.6, 99.6 % of the step after the rise time, order 2."""
    solution = run("FilterWithRiseTime", 4.0)
    reached = [solution.at(3.0, f"filter_fac{k}.y") for k in (3, 4, 5)]
    assert reached == pytest.approx([0.947, 0.986, 0.996], abs=6e-4)


def test_a_position_is_limited_in_speed_and_acceleration() -> None:
    solution = run("SlewRateLimiter", 1.0)
    assert solution["limit_a.y"].max() == pytest.approx(2.0, abs=1e-3)
    assert np.abs(solution["a.y"]).max() == pytest.approx(20.0, abs=1e-3)
    assert solution.final("positionSmoothed.y") == pytest.approx(1.0, abs=1e-3)
    assert solution.at(0.15, "limit_a.y") == pytest.approx(1.0, abs=5e-3)


def test_waves_are_modulated() -> None:
    solution = run("Modulation", 0.3)
    t = solution.t
    amplitude = 1 + 0.5 * np.sin(4 * np.pi * t)
    phase = 200 * np.pi * t + 25 * (1 - np.cos(4 * np.pi * t))
    assert solution["sine.y"] == pytest.approx(np.sin(200 * np.pi * t), abs=1e-5)
    assert solution["cosAM.y"] == pytest.approx(amplitude * np.cos(200 * np.pi * t), abs=1e-5)
    assert solution["sinFM.y"] == pytest.approx(np.sin(phase), abs=1e-5)
    assert solution["cosFM.y"] == pytest.approx(np.cos(phase), abs=1e-5)


def test_a_sinc_and_decaying_sines() -> None:
    solution = run("CompareSincExpSine", 1.0)
    t = solution.t
    assert solution["sinc.y"] == pytest.approx(np.sinc(10 * t), abs=1e-9)
    decaying = np.exp(-5 * t) * np.cos(10 * np.pi * t)
    assert solution["expSine2.y"] == pytest.approx(decaying, abs=1e-9)


def test_a_logical_loop_keeps_what_it_was() -> None:
    """Set by the first table, kept until the second one is true alone."""
    solution = run("LogicalNetwork1", 10.0)
    times = [0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5]
    expected = [0, 0, 1, 1, 1, 0, 1, 1, 1, 0]
    assert [float(solution.at(t, "Or1.y")) for t in times] == expected
