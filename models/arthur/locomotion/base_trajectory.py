"""Base trajectory generation (7.9): what the trunk shall do over the horizon."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.models.arthur.locomotion.commands import Command
from arthur_acausal.models.arthur.locomotion.estimation import Estimate
from arthur_acausal.models.arthur.locomotion.rotation import about_z, wrapped
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
    velocity : desired, ahead, left and up, in a level frame of the trunk's heading (3,) [m/s].
    yaw_rate : desired [rad/s]. Both follow the command as ramps.
    """

    def __init__(self, settings: Settings) -> None:
        self.velocity = np.zeros(3)
        self.yaw_rate = 0.0
        self._settings = settings
        self._place = np.zeros(2)
        self._started = False
        self._yaw = 0.0
        self._height = 0.0
        self._times = settings.step * np.arange(1, settings.horizon + 1)

    def update(self, command: Command, estimate: Estimate, walking: bool) -> None:
        """Advance by one period. A robot that stands keeps its trunk in the middle of its feet."""
        period, most = self._settings.period, self._settings.acceleration * self._settings.period
        if not self._started:
            self._started = True
            self._place, self._yaw = estimate.position[:2].copy(), estimate.yaw
            self._height = float(estimate.position[2])
        if not walking:
            self._place = estimate.position[:2] + estimate.point[:, :2].mean(axis=0)
        aim = (command.v_x, command.v_y) if walking else (0.0, 0.0)
        for i, wanted in enumerate(aim):
            self.velocity[i] += min(most, max(-most, wanted - self.velocity[i]))
        wanted = command.yaw_rate if walking else 0.0
        self.yaw_rate += min(most, max(-most, wanted - self.yaw_rate))
        self._height += min(most, max(-most, command.height - self._height))
        reach = self._settings.position_reach
        here = estimate.position[:2]
        place = self._place + period * (about_z(estimate.yaw) @ self.velocity)[:2]
        self._place = np.minimum(np.maximum(place, here - reach), here + reach)
        ahead = wrapped(self._yaw + period * self.yaw_rate - estimate.yaw)
        most = self._settings.yaw_reach
        self._yaw = estimate.yaw + min(most, max(-most, ahead))

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
