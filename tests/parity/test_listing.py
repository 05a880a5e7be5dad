"""The `listing` variant against the independent transcription: its derivatives, and a run of 0.2 s."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest
import scipy.sparse

from arthur_acausal import SolverOptions, Translation, translate
from arthur_acausal.models.arthur.powertrain import Powertrain
from tests.parity.listings import N_ACTUATORS, Array, Constants, right_hand_side
from tests.parity.reference import STOP_TIME, currents, forces, stored, voltage

RPM = 60 / (2 * np.pi)  # of the model's rad/s
EACH = range(N_ACTUATORS)
PATHS = (
    ["motor.w", "manifold.p"]
    + [f"cylinders[{i}].{name}" for name in ("v", "y", "p_A", "p_B") for i in EACH]
    + [f"reservoir.{name}" for name in ("v", "z", "p", "p_g")]
)
STATES = 1000


@pytest.fixture(scope="module")
def listing() -> Translation:
    # Without the meters, which are no part of the listings and no part of these states' equations.
    return translate(Powertrain(variant="listing", audit=False))


def random_states(rng: np.random.Generator, n: int) -> Array:
    """Return (54, n) states: both sides of every limit, negative pressures too, some pressures exactly equal."""
    draw = rng.uniform
    states = np.concatenate(
        [
            draw(-500, 9000, (1, n)),
            draw(-5e5, 3e7, (1, n)),
            draw(-1, 1, (12, n)),
            draw(-0.04, 0.04, (12, n)),
            draw(-1e5, 2.5e7, (24, n)),
            draw(-1, 1, (1, n)),
            draw(-0.001, 0.065, (1, n)),
            draw(-1e5, 1e6, (2, n)),
        ]
    )
    states[26, ::10] = states[52, ::10]  # p_A(1) = p_R
    return states


def derivatives(translation: Translation, states: Array, V: Array, I: Array, F: Array) -> Array:
    """Return the model's rates of PATHS, each state in the listings' units; the residual is affine in y'."""
    dae = translation.dae
    assert dae.differential.all(), "a state-space form: no algebraic variable is left"
    at = {path: index for index, path in enumerate(dae.y_paths)}
    where = np.array([at[path] for path in PATHS])
    kernels = dae.evaluator()
    kernels.p[:] = dae.parameter_vector()
    u_index = {path: index for index, path in enumerate(dae.u_paths)}
    unit = np.ones(len(PATHS))
    unit[0] = RPM
    rates = np.empty_like(states)
    for k in range(states.shape[1]):
        kernels.y[where] = states[:, k] / unit
        kernels.u[u_index["motor.V"]] = V[k]
        for i in EACH:
            kernels.u[u_index[f"valves[{i}].I"]] = I[i, k]
            kernels.u[u_index[f"loads[{i}].F"]] = F[i, k]
        kernels.yp[:] = 0.0
        constant = kernels.residual().copy()
        kernels.cj[:] = 1.0
        pattern = dae.sparsity
        matrix = scipy.sparse.csc_array((kernels.jacobian_yp(), pattern.row, pattern.colind)).toarray()
        rates[:, k] = np.linalg.solve(matrix, -constant)[where] * unit
    return rates


def test_derivatives_at_1000_random_states(listing: Translation) -> None:
    rng = np.random.default_rng(20220630)
    states = random_states(rng, STATES)
    V = rng.uniform(-60, 60, STATES)
    I = rng.uniform(-1, 1, (N_ACTUATORS, STATES))
    I[:, ::7] = 0.0
    F = rng.uniform(-1000, 1000, (N_ACTUATORS, STATES))
    ours = derivatives(listing, states, V, I, F)
    printed = right_hand_side(states, V, I, F, Constants())
    np.testing.assert_allclose(ours, printed, rtol=1e-10, atol=0.0)


def open_loop() -> dict[str, Callable[[float], float]]:
    """Return the reference's inputs by path."""

    def element(of: Callable[[float], Array], i: int, t: float) -> float:
        return float(of(t)[i])

    inputs: dict[str, Callable[[float], float]] = {"motor.V": voltage}
    for i in EACH:
        inputs[f"valves[{i}].I"] = partial(element, currents, i)
        inputs[f"loads[{i}].F"] = partial(element, forces, i)
    return inputs


def test_trajectory_agrees_with_radau(listing: Translation) -> None:
    times, reference = stored()
    options = SolverOptions(rtol=1e-9, intervals=len(times) - 1)
    solution = listing.simulate(STOP_TIME, options=options, inputs=open_loop())
    rows = np.searchsorted(solution.t, times + 1e-12, side="right") - 1
    ours = np.stack([solution[path][rows] for path in PATHS])
    ours[0] *= RPM
    error = np.abs(ours - reference).max(axis=1) / np.ptp(reference, axis=1)
    worst = int(np.argmax(error))
    assert error[worst] <= 1e-5, f"{PATHS[worst]} is off by {error[worst]:.1e} of its range"
