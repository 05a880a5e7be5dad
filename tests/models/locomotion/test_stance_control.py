"""The force problem against its textbook form, and its solution against another solver."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest
from scipy.linalg import block_diag, expm

from arthur_acausal.models.arthur.locomotion.base_trajectory import BaseTrajectory
from arthur_acausal.models.arthur.locomotion.estimation import Estimate
from arthur_acausal.models.arthur.locomotion.rotation import about_z, skew
from arthur_acausal.models.arthur.locomotion.settings import Settings
from arthur_acausal.models.arthur.locomotion.stance_control import (
    ForceProblem,
    StanceControl,
    solve,
    stance_torques,
)
from tests.models.locomotion.test_trajectories import FEET, estimate

MASS = 9.88
SETTINGS = Settings()
N = SETTINGS.horizon
TROT = np.array([[True, False, False, True]] * 5 + [[False, True, True, False]] * 4 + [[True] * 4])
WALK = np.array([[True, True, True, False]] * 6 + [[True] * 4] * 4)


def disturbed(seed: int) -> tuple[Estimate, BaseTrajectory, np.ndarray]:
    """A robot off its reference, with legs that are not alike; the trunk level, as the theory has it."""
    random = np.random.default_rng(seed)
    yaw = random.uniform(-3.0, 3.0)
    state = estimate(
        R=about_z(yaw),
        yaw=yaw,
        roll=random.normal(0, 0.02),
        pitch=random.normal(0, 0.02),
        position=np.array([*random.normal(0, 0.02, 2), 0.25 + random.normal(0, 0.005)]),
        velocity=random.normal(0, 0.2, 3),
        rate=random.normal(0, 0.3, 3),
    )
    pose, twist = np.zeros((N, 6)), np.zeros((N, 6))
    pose[:, 2], pose[:, 5] = yaw + 0.01 * np.arange(1, N + 1), 0.25
    twist[:, 3] = 0.5
    arms = FEET @ state.R.T + random.normal(0, 0.01, (N, 4, 3))
    return state, BaseTrajectory(pose, twist), arms


def textbook(
    state: Estimate, wanted: BaseTrajectory, arms: np.ndarray, stance: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Hessian and gradient by 13 states, matrix exponentials and A^k B (Di Carlo et al. 2018, eq. 16 to 25)."""
    turn = about_z(state.yaw)
    inertia = turn @ np.diag(SETTINGS.inertia) @ turn.T
    A = np.zeros((13, 13))
    A[:3, 6:9], A[3:6, 9:12], A[11, 12] = turn.T, np.eye(3), -1.0
    x = np.array(
        [state.roll, state.pitch, state.yaw, *state.position, *state.rate, *state.velocity, SETTINGS.gravity]
    )
    inputs, feet, A_d = [], [], expm(SETTINGS.step * A)
    for k in range(N):
        standing = np.flatnonzero(stance[k])
        B = np.zeros((13, 3 * len(standing)))
        for j, i in enumerate(standing):
            B[6:9, 3 * j : 3 * j + 3] = np.linalg.solve(inertia, skew(arms[k, i]))
            B[9:12, 3 * j : 3 * j + 3] = np.eye(3) / MASS
        whole = np.zeros((13 + B.shape[1],) * 2)
        whole[:13, :13], whole[:13, 13:] = A, B
        discrete = expm(SETTINGS.step * whole)
        inputs.append(discrete[:13, 13:])
        feet.append(len(standing))
    rows, free = [], []
    for k in range(N):
        blocks = [
            np.linalg.matrix_power(A_d, k - j) @ inputs[j] if j <= k else np.zeros((13, 3 * feet[j]))
            for j in range(N)
        ]
        rows.append(np.hstack(blocks))
        free.append(np.linalg.matrix_power(A_d, k + 1) @ x)
    w = SETTINGS.weights
    Q = block_diag(*[np.diag([*w.angles, *w.position, *w.rate, *w.velocity, 0.0])] * N)
    target = np.hstack([wanted.pose, wanted.twist, np.zeros((N, 1))]).ravel()
    S, deviation = np.vstack(rows), np.hstack(free) - target
    even = np.concatenate([np.tile([0, 0, MASS * SETTINGS.gravity / n], n) for n in feet])
    return S.T @ Q @ S + w.force * np.eye(S.shape[1]), S.T @ Q @ deviation - w.force * even


@pytest.mark.parametrize("stance", [TROT, WALK])
def test_the_condensed_problem_is_the_textbooks(stance: np.ndarray) -> None:
    state, wanted, arms = disturbed(1)
    problem = StanceControl(MASS, SETTINGS).problem(state, wanted, arms, stance)
    H, g = textbook(state, wanted, arms, stance)
    assert np.abs(problem.H - H).max() < 1e-12 * np.abs(H).max()
    assert np.abs(problem.g - g).max() < 1e-12 * np.abs(g).max()


def by_qpoases(problem: ForceProblem) -> np.ndarray:
    """Solve by qpOASES (Ferreau et al. 2014), a primal-dual active-set method of its own."""
    n = len(problem.g)
    H, A = ca.DM(problem.H), ca.sparsify(ca.DM(problem.A))
    solver = ca.conic("other", "qpoases", {"h": H.sparsity(), "a": A.sparsity()}, {"printLevel": "none"})
    bounds = {
        "lbx": problem.lower[:n],
        "ubx": problem.upper[:n],
        "lba": problem.lower[n:],
        "uba": problem.upper[n:],
    }
    return np.array(solver(h=H, g=problem.g, a=A, **bounds)["x"]).ravel()


@pytest.mark.parametrize("stance", [TROT, WALK])
@pytest.mark.parametrize("seed", range(3))
def test_two_solvers_agree(stance: np.ndarray, seed: int) -> None:
    control = StanceControl(MASS, SETTINGS)
    state, wanted, arms = disturbed(seed)
    problem = control.problem(state, wanted, arms, stance)
    x = solve(problem)
    assert x == pytest.approx(by_qpoases(problem), abs=1e-6)
    forces = control.forces(problem, stance)
    assert not forces[~stance].any()
    assert (np.abs(forces[..., :2]) <= SETTINGS.friction * forces[..., 2:] + 1e-4).all()
    assert forces[..., 2].min() >= -1e-6 and forces[..., 2].max() <= SETTINGS.max_force + 1e-6


def test_a_robot_at_rest_is_carried() -> None:
    control = StanceControl(MASS, SETTINGS)
    pose = np.zeros((N, 6))
    pose[:, 5] = 0.25
    stance = np.ones((N, 4), dtype=bool)
    arms = np.tile(FEET, (N, 1, 1))
    forces = control.forces(
        control.problem(estimate(), BaseTrajectory(pose, np.zeros((N, 6))), arms, stance), stance
    )
    assert forces == pytest.approx(np.tile([0.0, 0.0, MASS * 9.81 / 4], (N, 4, 1)), abs=0.05)


def test_torques_do_the_work_of_the_forces() -> None:
    """Virtual work: the ground's force on a foot moving with J dq, and the joints' torques, balance."""
    random = np.random.default_rng(2)
    J, force, rates, R = (
        random.normal(size=(3, 3)),
        random.normal(size=3),
        random.normal(size=3),
        about_z(0.7),
    )
    torques = np.array(ca.evalf(stance_torques(ca.SX(force), ca.SX(R), ca.SX(J)))).ravel()
    assert torques @ rates + force @ (R @ J @ rates) == pytest.approx(0.0, abs=1e-14)
