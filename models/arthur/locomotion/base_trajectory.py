"""Base trajectory generation (7.9): what the trunk shall do over the horizon."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.models.arthur.locomotion.commands import Command
from arthur_acausal.models.arthur.locomotion.estimation import Estimate
from arthur_acausal.models.arthur.locomotion.rotation import wrapped
from arthur_acausal.models.arthur.locomotion.settings import Settings

FloatArray = NDArray[np.float64]


@dataclass(slots=True)
class BaseTrajectory:
    """Desired motion at the ends of the horizon's steps, k = 1..N, in the world.

    Attributes
    ----------
    pose : roll, pitch, yaw [rad], x, y, z [m] (N, 6). twist : angular velocity [rad/s], velocity [m/s] (N, 6).
    """

    pose: FloatArray
    twist: FloatArray


class BaseReference:
    """Integrates the commanded velocity, from which it does not run away.

    Attributes
    ----------
    velocity : desired, ahead, left and up, in a level frame of the trunk's heading [m/s].
    yaw_rate : desired [rad/s]. Both follow the command as ramps.
    """

    def __init__(self, settings: Settings) -> None:
        self.velocity = [0.0, 0.0, 0.0]
        self.yaw_rate = 0.0
        self._settings = settings
        self._place = [0.0, 0.0]
        self._started = False
        self._yaw = 0.0
        self._height = 0.0
        self._times = settings.step * np.arange(1, settings.horizon + 1)

    def update(self, command: Command, estimate: Estimate, walking: bool) -> None:
        """Advance by one period. A robot that stands keeps its trunk in the middle of its feet."""
        period, yaw = self._settings.period, estimate.yaw
        here = estimate.position.tolist()
        if not self._started:
            self._started = True
            self._place, self._yaw, self._height = here[:2], yaw, here[2]
        if not walking:
            self._place = (estimate.position + estimate.point.mean(axis=0)).tolist()[:2]
        v_x, v_y, yaw_rate = (command.v_x, command.v_y, command.yaw_rate) if walking else (0.0, 0.0, 0.0)
        most = self._settings.acceleration * period
        self.velocity = [
            _towards(v, aim, most) for v, aim in zip(self.velocity, (v_x, v_y, 0.0), strict=True)
        ]
        self.yaw_rate = _towards(self.yaw_rate, yaw_rate, most)
        self._height = _towards(self._height, command.height, most)
        reach, (v_x, v_y, _) = self._settings.position_reach, self.velocity
        x, y = self._place
        x += period * (cos(yaw) * v_x - sin(yaw) * v_y)
        y += period * (sin(yaw) * v_x + cos(yaw) * v_y)
        self._place = [_towards(here[0], x, reach), _towards(here[1], y, reach)]
        ahead = wrapped(self._yaw + period * self.yaw_rate - yaw)
        self._yaw = yaw + _towards(0.0, ahead, self._settings.yaw_reach)

    def trajectory(self) -> BaseTrajectory:
        """Return the desired motion over the horizon, level and at the commanded height."""
        n, t = len(self._times), self._times
        pose, twist = np.zeros((n, 6)), np.zeros((n, 6))
        yaw = self._yaw + self.yaw_rate * t
        pose[:, 2] = yaw
        twist[:, 2] = self.yaw_rate
        c, s = np.cos(yaw), np.sin(yaw)
        twist[:, 3] = c * self.velocity[0] - s * self.velocity[1]
        twist[:, 4] = s * self.velocity[0] + c * self.velocity[1]
        pose[:, 3:5] = self._place + self._settings.step * np.cumsum(twist[:, 3:5], axis=0)
        pose[:, 5] = self._height
        return BaseTrajectory(pose, twist)


def _towards(value: float, aim: float, most: float) -> float:
    """Return the value moved to the aim, but no farther than ``most``."""
    return value + min(most, max(-most, aim - value))
