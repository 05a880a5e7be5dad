"""The transcription by itself: the report's known numbers, and the stored Radau run against a new one."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.parity.listings import Array, Constants, initial_state, pump_scaling, right_hand_side
from tests.parity.reference import radau, stored


def eigenvalues(state: Array) -> NDArray[np.complex128]:
    """Eigenvalues [1/s] of the 54 rates about a state, valves closed, by central differences."""
    scale = np.where(np.abs(state) > 1e3, 10.0, 1e-6)
    steps = np.diag(scale)
    zero = np.zeros((12, 1))
    up, down = (right_hand_side(state[:, None] + s * steps, 0.0, zero, zero, Constants()) for s in (1, -1))
    return np.linalg.eigvals((up - down) / (2 * scale)).astype(np.complex128)


def test_pump_scaling_at_1_gpm_and_5000_rpm() -> None:
    assert pump_scaling(1.0, 5000.0) == pytest.approx((0.89059e-6, 1.41742e-7, 3.15882e-4), rel=1e-5)


def test_relief_valve_and_manifold_make_a_pole_near_2_microseconds() -> None:
    state = initial_state()
    state[0], state[1] = 5000.0, 20.68e6 + 34e3
    fastest = eigenvalues(state).real.min()
    assert -1 / fastest == pytest.approx(1.90e-6, rel=0.02)


def test_actuators_and_reservoir_ring_at_their_known_frequencies() -> None:
    state = initial_state()
    frequencies = np.unique(np.round(np.abs(eigenvalues(state).imag), 0))
    # sqrt(beta/m (A_A^2/V_A + A_B^2/V_B)), eta_act on the pressures' force: sqrt(0.95) of the passive 8775 rad/s
    actuator = np.sqrt(0.95) * 8775
    # sqrt(beta A_R^2/(m V_f)) of equation 5.55 with the gas spring, some parts in 1e4, left out
    fluid = np.sqrt(1.4e9 * 0.0011**2 / (0.04 * (2.3e-5 + 0.0011 * 0.04)))
    assert np.min(np.abs(frequencies / actuator - 1)) < 0.01
    assert frequencies[-1] == pytest.approx(fluid, rel=2e-3)


def test_nothing_moves_at_rest() -> None:
    rates = right_hand_side(initial_state(), 0.0, np.full(12, 0.1), np.zeros(12), Constants())
    pistons = rates[2:14]  # 3 bar on both sides of a piston with a rod
    assert np.all(pistons > 0)
    assert np.all(np.delete(rates, np.s_[2:14]) == 0)


@pytest.mark.parametrize("window", [(0, 3), (39, 42)], ids=["start", "relief valve opens"])
def test_stored_trajectory_is_what_radau_gives(window: tuple[int, int]) -> None:
    times, states = stored()
    first, last = window
    again = radau(states[:, first], times[first : last + 1])
    error = np.abs(again - states[:, first : last + 1]).max(axis=1) / np.ptp(states, axis=1)
    assert error.max() < 1e-8
