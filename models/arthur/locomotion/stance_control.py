"""Stance leg control (7.12): forces by convex model predictive control, torques by the feet's Jacobians.

Di Carlo, Wensing, Katz, Bledt and Kim, "Dynamic locomotion in the MIT Cheetah 3 through convex model-predictive
control", IROS 2018: a single rigid body of small roll and pitch, forces constant over each step, the states
condensed away. Here the powers of the state matrix are written out, since integrators only stand in it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from arthur_acausal import SimulationError
from arthur_acausal.models.arthur.locomotion.base_trajectory import BaseTrajectory
from arthur_acausal.models.arthur.locomotion.estimation import Estimate
from arthur_acausal.models.arthur.locomotion.rotation import about_z
from arthur_acausal.models.arthur.locomotion.settings import Settings

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class ForceProblem:
    """The quadratic program: minimise x^T H x / 2 + g^T x with lower <= (x, A x) <= upper.

    x : the standing feet's forces on the robot in the world, step after step, foot after foot, three each [N].
    """

    H: FloatArray
    g: FloatArray
    A: FloatArray
    lower: FloatArray
    upper: FloatArray


class StanceControl:
    """Builds and solves the force problem."""

    def __init__(self, mass: float, settings: Settings) -> None:
        self._mass = mass
        self._settings = settings
        n, h = settings.horizon, settings.step
        step = np.arange(n)
        # A force during step j has changed the velocity by h at the end of step k >= j, the position by reach[k, j].
        self._reach = h * h * np.maximum(step[:, None] - step[None, :] + 0.5, 0.0) * (step[:, None] >= step)
        self._pushes = h * (step[:, None] >= step)
        self._pose_pairs = self._reach.T @ self._reach
        self._twist_pairs = self._pushes.T @ self._pushes
        self._times = h * (step + 1.0)
        w = settings.weights
        self._pose_weight = np.array([*w.angles, *w.position])
        self._twist_weight = np.array([*w.rate, *w.velocity])
        self._constraints = {k: self._cone(k) for k in range(1, 4 * n + 1)}

    def problem(
        self, estimate: Estimate, wanted: BaseTrajectory, arms: FloatArray, stance: BoolArray
    ) -> ForceProblem:
        """Return the program for the feet that stand.

        Parameters
        ----------
        wanted : desired motion at the steps' ends. arms : centre of mass to feet, at the steps' beginnings (N, 4, 3).
        stance : which feet stand in which step (N, 4).
        """
        steps, feet = np.nonzero(stance)
        count = len(steps)
        R, turn = estimate.R, about_z(estimate.yaw).T
        spin = turn @ (R / np.array(self._settings.inertia)) @ R.T
        # Columns: the accelerations of (roll, pitch, yaw, x, y, z), and of (angular velocity, velocity), by a force.
        twist = np.zeros((6, count, 3))
        x, y, z = arms[steps, feet].T
        levers = np.zeros((3, count, 3))
        levers[0, :, 1], levers[0, :, 2] = -z, y
        levers[1, :, 0], levers[1, :, 2] = z, -x
        levers[2, :, 0], levers[2, :, 1] = -y, x
        pose = np.zeros((6, count, 3))
        pose[:3] = (spin @ levers.reshape(3, -1)).reshape(3, count, 3)
        twist[:3] = (turn.T @ pose[:3].reshape(3, -1)).reshape(3, count, 3)
        for axis in range(3):
            twist[3 + axis, :, axis] = pose[3 + axis, :, axis] = 1.0 / self._mass
        U, V = pose.reshape(6, -1), twist.reshape(6, -1)
        weighted_U, weighted_V = self._pose_weight[:, None] * U, self._twist_weight[:, None] * V
        index = np.repeat(steps, 3)
        H = weighted_U.T @ U
        H *= self._pose_pairs[index[:, None], index]
        H_twist = weighted_V.T @ V
        H_twist *= self._twist_pairs[index[:, None], index]
        H += H_twist
        force = self._settings.weights.force
        H.flat[:: 3 * count + 1] += force

        pose_error, twist_error = self._free(estimate, turn)
        pose_error -= wanted.pose
        twist_error -= wanted.twist
        g = np.einsum("ij,ij->j", weighted_U, (pose_error.T @ self._reach)[:, index])
        g += np.einsum("ij,ij->j", weighted_V, (twist_error.T @ self._pushes)[:, index])
        share = self._mass * self._settings.gravity / np.maximum(stance.sum(axis=1), 1)
        g[2::3] -= force * share[steps]
        return ForceProblem(H, g, *self._constraints[count])

    def forces(self, problem: ForceProblem, stance: BoolArray) -> FloatArray:
        """Return the forces on the robot, zero for feet that swing (N, 4, 3) [N]."""
        forces = np.zeros((*stance.shape, 3))
        forces[stance] = solve(problem).reshape(-1, 3)
        return forces

    def _free(self, estimate: Estimate, turn: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return pose and twist at the steps' ends without any force on the feet."""
        t = self._times[:, None]
        gravity = np.array([0.0, 0.0, -self._settings.gravity])
        angles = np.array([estimate.roll, estimate.pitch, estimate.yaw])
        pose, twist = np.empty((len(t), 6)), np.empty((len(t), 6))
        pose[:, :3] = angles + t * (turn @ estimate.rate)
        pose[:, 3:] = estimate.position + t * estimate.velocity + t**2 / 2 * gravity
        twist[:, :3] = estimate.rate
        twist[:, 3:] = estimate.velocity + t * gravity
        return pose, twist

    def _cone(self, count: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return A, lower and upper of so many forces: 0 <= f_z <= most, |f_x|, |f_y| <= mu f_z."""
        mu, most, free = self._settings.friction, self._settings.max_force, np.inf
        one = np.array([[1.0, 0.0, -mu], [-1.0, 0.0, -mu], [0.0, 1.0, -mu], [0.0, -1.0, -mu]])
        lower = np.concatenate([np.tile([-free, -free, 0.0], count), np.full(4 * count, -free)])
        upper = np.concatenate([np.tile([free, free, most], count), np.zeros(4 * count)])
        return np.asarray(np.kron(np.eye(count), one), dtype=float), lower, upper


def solve(problem: ForceProblem) -> FloatArray:
    """Solve the program with DAQP (Arnström, Bemporad and Axehill 2022), a dual active-set method."""
    import daqp

    result: Any = daqp.solve(problem.H, problem.g, problem.A, problem.upper, problem.lower)
    x, _, flag, _ = result
    if flag != 1:
        raise SimulationError(
            f"the force problem of the stance legs was not solved: DAQP ends with {flag}",
            remedy="check the estimate for numbers that are not finite, and the weights for negative ones",
        )
    return np.asarray(x)


def stance_torques(force: ca.SX, R: ca.SX, jacobian: ca.SX) -> ca.SX:
    """Return a leg's torques that press on the ground with the opposite of ``force``: -J^T R^T f [N m].

    ``force`` : of the ground on the foot, in the world [N]. ``R`` : trunk to world. ``jacobian`` : of the foot's
    contact point, in the trunk's frame.
    """
    return -jacobian.T @ R.T @ force
