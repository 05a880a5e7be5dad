"""State estimation and sensors, without a simulator."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal.models.arthur.dimensions import Dimensions
from arthur_acausal.models.arthur.locomotion.estimation import Estimator
from arthur_acausal.models.arthur.locomotion.kernel import Kernel
from arthur_acausal.models.arthur.locomotion.leg_model import kinematics
from arthur_acausal.models.arthur.locomotion.rotation import matrix_of
from arthur_acausal.models.arthur.locomotion.sensors import FIELDS, N_INPUTS, Reader
from arthur_acausal.models.arthur.locomotion.settings import Noise, Settings

ROBOT = Dimensions()
SETTINGS = Settings()
VELOCITY = np.array([0.5, -0.1, 0.02])
ALL = np.ones(4, dtype=bool)


def gliding() -> np.ndarray:
    """Inputs of a tilted trunk that moves steadily and turns, its feet's lowest points at rest on the ground."""
    q = np.array([0.99, 0.05, -0.04, 0.1])
    R = matrix_of(q)
    rate = np.array([0.1, -0.2, 0.3])
    angles = np.tile(ROBOT.stand, 4) + np.linspace(-0.1, 0.1, 12)
    _, _, point, jacobian, _ = Kernel(kinematics(ROBOT))(angles, np.zeros(12), R[2])
    speeds = [
        np.linalg.solve(J.T, -R.T @ VELOCITY - np.cross(rate, r))
        for J, r in zip(jacobian.reshape(4, 3, 3), point.reshape(4, 3), strict=True)
    ]
    parts = [[1.0, 2.0, 0.25], q / np.linalg.norm(q), VELOCITY, rate, angles, *speeds, np.full(4, 24.0)]
    return np.concatenate([*parts, SETTINGS.gravity * R[2]])


def test_the_stance_feet_tell_the_velocity() -> None:
    """Each of n feet takes its share of the error at each tick: (1 - n gain)^k of it is left."""
    estimator, read = Estimator(ROBOT, SETTINGS, true_velocity=False), Reader(Noise(), None)
    for k in range(1, 30):
        state = estimator(read(gliding()), ALL)
        left = (1.0 - 4 * SETTINGS.odometry_gain) ** k
        assert state.velocity == pytest.approx((1.0 - left) * VELOCITY, abs=1e-12)


def test_a_foot_in_the_air_tells_nothing() -> None:
    inputs = gliding()
    inputs[37:41] = [24.0, 0.0, 0.0, 24.0]
    inputs[25 + 3 : 25 + 9] = 50.0  # the legs of FR and RL move
    estimator, read = Estimator(ROBOT, SETTINGS, true_velocity=False), Reader(Noise(), None)
    states = [estimator(read(inputs), ALL) for _ in range(300)]
    state = states[-1]
    assert state.contact.tolist() == [True, False, False, True]
    assert state.velocity == pytest.approx(VELOCITY, abs=1e-6)


def test_in_the_air_the_accelerometer_is_integrated() -> None:
    inputs = gliding()
    inputs[37:] = 0.0  # no contact, free fall
    estimator, read = Estimator(ROBOT, SETTINGS, true_velocity=False), Reader(Noise(), None)
    states = [estimator(read(inputs), ALL) for _ in range(50)]
    assert states[-1].velocity == pytest.approx([0.0, 0.0, -9.81 * 0.1])


def test_the_true_velocity_is_taken_where_asked() -> None:
    state = Estimator(ROBOT, SETTINGS, true_velocity=True)(Reader(Noise(), None)(gliding()), ALL)
    assert state.velocity == pytest.approx(VELOCITY) and state.position == pytest.approx([1.0, 2.0, 0.25])


def test_noise_has_its_deviation_and_is_repeatable() -> None:
    noise = Noise(angle=1e-3, rate=0.02, force=2.0, orientation=0.01)
    inputs = gliding()
    readings = [read(inputs) for read in [Reader(noise, 7)] for _ in range(2000)]
    again = Reader(noise, 7)(inputs)
    assert (again.angles == readings[0].angles).all() and (again.orientation == readings[0].orientation).all()
    assert np.std([r.angles for r in readings], axis=0) == pytest.approx(np.full(12, 1e-3), rel=0.1)
    assert np.std([r.rate for r in readings], axis=0) == pytest.approx(np.full(3, 0.02), rel=0.1)
    assert np.std([r.forces for r in readings], axis=0) == pytest.approx(np.full(4, 2.0), rel=0.1)
    R = matrix_of(inputs[3:7])
    turns = [R.T @ matrix_of(r.orientation) for r in readings]
    tilt = np.array([[T[2, 1], T[0, 2], T[1, 0]] for T in turns])
    assert tilt.std(axis=0) == pytest.approx(np.full(3, 0.01), rel=0.1)
    assert np.abs(tilt.mean(axis=0)).max() < 1e-3
    assert sum(FIELDS.values()) == N_INPUTS == len(inputs)
