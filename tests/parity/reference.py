"""Trajectories of the transcribed listings by SciPy's Radau at rtol 1e-10, and their stored copy.

The open-loop run is 0.2 s from Table 5's state: the motor spins up, the relief valve opens at 81 ms, and the
valves and loads swing at 5 Hz with twelve phases. At this tolerance the reservoir's ringing at 4 kHz is
resolved, which takes a minute; so `python -m tests.parity.reference` writes the states every 2 ms to
`radau.npz`, and the tests recompute two windows of it from stored states.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

from tests.parity.listings import N_ACTUATORS, Array, Constants, initial_state, right_hand_side

FILE = Path(__file__).with_name("radau.npz")
STOP_TIME = 0.2  # [s]
RTOL = 1e-10
PHASES = 2 * np.pi * np.arange(N_ACTUATORS) / N_ACTUATORS

# Typical magnitudes of the states; the absolute tolerance of each is 0.01 rtol of it.
NOMINAL = np.concatenate(
    [[5e3, 1e7], np.full(12, 0.1), np.full(12, 0.01), np.full(24, 1e7), [0.1, 0.01, 1e5, 1e5]]
)


def voltage(t: float) -> float:
    """Motor voltage [V] at t [s]."""
    return float(42 * (1 - np.exp(-t / 0.02)))


def currents(t: float) -> Array:
    """The twelve valve currents [A] at t [s], both signs."""
    return np.asarray(0.03 * np.sin(2 * np.pi * 5 * t + PHASES) * np.tanh(t / 0.02))


def forces(t: float) -> Array:
    """The twelve load forces [N] at t [s], in phase with the currents, so that the loads resist."""
    return np.asarray(150 * np.sin(2 * np.pi * 5 * t + PHASES) * np.tanh(t / 0.02))


def radau(state: Array, times: Array, rtol: float = RTOL) -> Array:
    """Integrate from `state` at times[0]; return the states at `times` (54, number of times)."""
    given = Constants()

    def rates(t: float, y: Array) -> Array:
        more = (slice(None),) + (None,) * (y.ndim - 1)
        return right_hand_side(y, voltage(t), currents(t)[more], forces(t)[more], given)

    run = solve_ivp(
        rates,
        (times[0], times[-1]),
        state,
        method="Radau",
        t_eval=times,
        rtol=rtol,
        atol=0.01 * rtol * NOMINAL,
        vectorized=True,
    )
    if not run.success:
        raise RuntimeError(run.message)
    return np.asarray(run.y)


def stored() -> tuple[Array, Array]:
    """Return the stored times (101) and states (54, 101)."""
    with np.load(FILE) as file:
        return file["times"], file["states"]


if __name__ == "__main__":
    grid = np.linspace(0.0, STOP_TIME, 101)
    np.savez_compressed(FILE, times=grid, states=radau(initial_state(), grid))
