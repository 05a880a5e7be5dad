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
IntArray = NDArray[np.int_]

PATTERNS = 64
"""How many patterns of stance are kept at most: those of a stride, and some."""


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


@dataclass(frozen=True, slots=True)
class _Pattern:
    """What depends on nothing but which feet stand when.

    steps, feet : of each force. index : step of each unknown. pose_pairs, twist_pairs : how two unknowns work together
    on the squares of pose and twist over the horizon. A, lower, upper : friction pyramids. share : of the weight [N].
    """

    steps: IntArray
    feet: IntArray
    index: IntArray
    pose_pairs: FloatArray
    twist_pairs: FloatArray
    A: FloatArray
    lower: FloatArray
    upper: FloatArray
    share: FloatArray


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
        self._times = h * (step + 1.0)
        w = settings.weights
        self._pose_weight = np.array([[*w.angles, *w.position]]).T
        self._twist_weight = np.array([[*w.rate, *w.velocity]]).T
        self._pose_pairs, self._twist_pairs = (x.T @ x for x in (self._reach, self._pushes))
        self._cones: dict[int, tuple[FloatArray, FloatArray, FloatArray]] = {}  # by the number of forces
        self._patterns: dict[bytes, _Pattern] = {}

    def problem(
        self, estimate: Estimate, wanted: BaseTrajectory, arms: FloatArray, stance: BoolArray
    ) -> ForceProblem:
        """Return the program for the feet that stand.

        Parameters
        ----------
        wanted : desired motion at the steps' ends. arms : centre of mass to feet, at the steps' beginnings (N, 4, 3).
        stance : which feet stand in which step (N, 4).
        """
        pattern = self._pattern(stance)
        turn = about_z(estimate.yaw).T
        U, V = self._effects(estimate.R, turn, arms[pattern.steps, pattern.feet])
        weighted_U, weighted_V = self._pose_weight * U, self._twist_weight * V
        force = self._settings.weights.force
        H = weighted_U.T @ U
        H *= pattern.pose_pairs
        H_twist = weighted_V.T @ V
        H_twist *= pattern.twist_pairs
        H += H_twist
        H.flat[:: len(H) + 1] += force

        pose, twist = self._free(estimate, turn)
        pose_error, twist_error = pose - wanted.pose, twist - wanted.twist
        g = (weighted_U * (pose_error.T @ self._reach)[:, pattern.index]).sum(axis=0)
        g += (weighted_V * (twist_error.T @ self._pushes)[:, pattern.index]).sum(axis=0)
        g[2::3] -= force * pattern.share
        return ForceProblem(H, g, pattern.A, pattern.lower, pattern.upper)

    def forces(self, problem: ForceProblem, stance: BoolArray) -> FloatArray:
        """Return the forces on the robot, zero for feet that swing (N, 4, 3) [N]."""
        forces = np.zeros((*stance.shape, 3))
        forces[stance] = solve(problem).reshape(-1, 3)
        return forces

    def _effects(self, R: FloatArray, turn: FloatArray, arms: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the accelerations of (roll, pitch, yaw, x, y, z) and of the twist by each unknown, 6 x n."""
        count = len(arms)
        levers, push = np.zeros((3, count, 3)), np.zeros((3, count, 3))
        x, y, z = arms.T
        levers[0, :, 1], levers[0, :, 2] = -z, y
        levers[1, :, 0], levers[1, :, 2] = z, -x
        levers[2, :, 0], levers[2, :, 1] = -y, x
        for axis in range(3):
            push[axis, :, axis] = 1.0 / self._mass
        spin = (R / np.array(self._settings.inertia)) @ R.T @ levers.reshape(3, -1)
        moved = push.reshape(3, -1)
        return np.concatenate([turn @ spin, moved]), np.concatenate([spin, moved])

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

    def _pattern(self, stance: BoolArray) -> _Pattern:
        key = stance.tobytes()
        if key not in self._patterns:
            if len(self._patterns) >= PATTERNS:
                self._patterns.clear()
            steps, feet = np.nonzero(stance)
            count = len(steps)
            if count not in self._cones:
                self._cones[count] = self._cone(count)
            index = np.repeat(steps, 3)
            pairs = np.ix_(index, index)
            share = self._mass * self._settings.gravity / np.maximum(stance.sum(axis=1), 1)
            self._patterns[key] = _Pattern(
                steps,
                feet,
                index,
                self._pose_pairs[pairs],
                self._twist_pairs[pairs],
                *self._cones[count],
                share[steps],
            )
        return self._patterns[key]

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
