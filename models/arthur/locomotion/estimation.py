"""State estimation (7.4, Algorithm 2): contacts, posture, velocity of the trunk."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from arthur_acausal import compile_functions
from arthur_acausal.models.arthur.dimensions import Dimensions
from arthur_acausal.models.arthur.locomotion.kernel import Kernel
from arthur_acausal.models.arthur.locomotion.leg_model import kinematics
from arthur_acausal.models.arthur.locomotion.rotation import euler_of, matrix_of
from arthur_acausal.models.arthur.locomotion.sensors import Sensors
from arthur_acausal.models.arthur.locomotion.settings import Settings

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]


@dataclass(slots=True)
class Estimate:
    """What the stack knows of the robot. W: world, B: the trunk's frame; feet in the order of LEGS.

    Attributes
    ----------
    R : B to W (3, 3). roll, pitch, yaw : [rad]. position, velocity : of the trunk in W [m], [m/s].
    rate_B, rate : angular velocity in B and in W [rad/s].
    angles, speeds : of the joints [rad], [rad/s].
    contact : c_f, of each foot. foot, foot_velocity : centres in B (4, 3), relative to the trunk [m], [m/s].
    point : lowest points of the feet from the trunk's centre, in W (4, 3) [m].
    centre : of mass, from the trunk's centre in W [m].
    """

    R: FloatArray
    roll: float
    pitch: float
    yaw: float
    position: FloatArray
    velocity: FloatArray
    rate_B: FloatArray
    rate: FloatArray
    angles: FloatArray
    speeds: FloatArray
    contact: BoolArray
    foot: FloatArray
    foot_velocity: FloatArray
    point: FloatArray
    centre: FloatArray


@cache
def odometry(robot: Dimensions) -> ca.Function:
    """Return the function (q, dq, R, w) -> (foot, foot_velocity, point, said, centre) of the legs' kinematics.

    R : trunk to world, by columns, 9. w : angular velocity in the trunk's frame. said : the trunk's velocity if the
    material at a foot's lowest point is at rest, -(w x r + J dq), for each foot in the world, 12 [m/s]. The others: see
    Estimate.
    """
    q, dq, R, w = ca.SX.sym("q", 12), ca.SX.sym("dq", 12), ca.SX.sym("R", 3, 3), ca.SX.sym("w", 3)
    foot, foot_velocity, point, jacobian, centre = kinematics(robot)(q, dq, R[2, :].T)
    points, said = [], []
    for i in range(4):
        mine = slice(3 * i, 3 * i + 3)
        J = ca.reshape(jacobian[9 * i : 9 * i + 9], 3, 3)
        points.append(R @ point[mine])
        said.append(-R @ (ca.cross(w, point[mine]) + J @ dq[mine]))
    outputs = [foot, foot_velocity, ca.vertcat(*points), ca.vertcat(*said), R @ centre]
    return compile_functions([ca.Function("odometry", [q, dq, ca.vec(R), w], outputs, {"cse": True})])[0]


class Estimator:
    """Integrates the accelerometer, drawn to what the stance feet say of the trunk's velocity and height.

    A stance foot does not slip: the material at its lowest point is at rest. Height is counted from the stance feet,
    so that the ground's own height needs no knowing. With ``true_velocity`` the optional inputs of 7.3.9 and 7.3.10
    are taken for position and velocity instead.
    """

    def __init__(self, robot: Dimensions, settings: Settings, true_velocity: bool) -> None:
        self._odometry = Kernel(odometry(robot))
        self._settings = settings
        self._true = true_velocity
        self._position = np.zeros(3)
        self._started = False
        self._velocity = np.zeros(3)

    def __call__(self, sensors: Sensors, stance: BoolArray) -> Estimate:
        """Return the estimate; ``stance`` tells the legs that are meant to stand (c_sync)."""
        R = matrix_of(sensors.orientation)
        outputs = self._odometry(sensors.angles, sensors.speeds, R.T.ravel(), sensors.rate)
        foot, foot_velocity, point, said = (x.reshape(4, 3).copy() for x in outputs[:4])
        contact = sensors.forces > self._settings.contact_force
        self._update(sensors, R, contact & stance, said, point)
        return Estimate(
            R,
            *euler_of(R),
            self._position.copy(),
            self._velocity.copy(),
            sensors.rate,
            R @ sensors.rate,
            sensors.angles,
            sensors.speeds,
            contact,
            foot,
            foot_velocity,
            point,
            outputs[4].copy(),
        )

    def _update(
        self, sensors: Sensors, R: FloatArray, standing: BoolArray, said: FloatArray, point: FloatArray
    ) -> None:
        """Advance position and velocity by one period; ``said``: the trunk's velocity according to each foot."""
        if self._true:
            self._position, self._velocity = sensors.position, sensors.velocity
            return
        if not self._started:
            self._started = True
            self._position = np.array([0.0, 0.0, -point[:, 2].mean()])
        period, gain = self._settings.period, self._settings.odometry_gain
        change = R @ sensors.acceleration
        change[2] -= self._settings.gravity
        self._velocity = self._velocity + period * change
        self._position = self._position + period * self._velocity
        share = gain * standing
        self._velocity += share @ said - share.sum() * self._velocity
        self._position[2] -= share @ (point[:, 2] + self._position[2])
