"""The error of the foreseen flow, against closed forms."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest
from numpy.typing import NDArray

from arthur_acausal.models.arthur.demand import Demand
from arthur_acausal.models.arthur.foresight import foresight_error, picture

FloatArray = NDArray[np.float64]
MEAN, SWING, OMEGA = 3e-5, 1e-5, 2 * pi


def flow(t: FloatArray) -> FloatArray:
    """A flow that swings once a second."""
    return np.asarray(MEAN + SWING * np.sin(OMEGA * t))


def swinging(bias: float = 0.0) -> Demand:
    """Twenty periods, all foreseen but for a bias."""
    t, t_plan = np.arange(0.0, 20.32, 0.002), np.arange(0.0, 20.32, 0.01)
    plan = flow(t_plan[:, None] + 0.03 * np.arange(11.0)) + bias
    return Demand(t, flow(t), flow(t), t_plan, plan, plan)


def test_who_foresees_errs_by_the_bias_and_who_holds_by_the_phase() -> None:
    """The mean over a window T of a sine is sinc(omega T/2) of it at the middle; a shift d errs by 2 sin(omega d/2)."""
    T, bias = 0.02, 2e-7
    error = foresight_error(swinging(bias), window=T)
    amplitude = SWING / sqrt(2) * np.sinc(OMEGA * T / (2 * pi))
    between = SWING * (OMEGA * 0.03) ** 2 / 8  # what a line misses between points 30 ms apart
    assert np.abs(error.bias - bias).max() < between
    assert np.abs(error.planned - bias).max() < between
    shift = np.maximum(error.ahead, T / 2) + T / 2
    assert error.held == pytest.approx(amplitude * 2 * np.abs(np.sin(OMEGA * shift / 2)), rel=0.01)
    assert error.constant == pytest.approx(np.full(11, amplitude), rel=0.01)
    assert error.mean == pytest.approx(MEAN, rel=0.01)


def test_table_and_picture() -> None:
    error = foresight_error(swinging(), window=0.02)
    lines = error.table().splitlines()
    assert len(lines) == 2 + 11
    assert [float(x) for x in lines[-1].split()][::3] == pytest.approx(
        [300.0, error.held[-1] * 6e4], abs=1e-3
    )
    flows, errors = picture(swinging(), begin=19.0).axes
    assert flows.get_ylabel() == "flow [L/min]"
    assert np.asarray(errors.lines[1].get_ydata())[-1] == pytest.approx(error.held[-1] * 6e4, rel=0.02)
