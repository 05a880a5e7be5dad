"""A controller that stands: it keeps the pose and the forces with which it is started."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.models.arthur.linkages import all_triangles

FloatArray = NDArray[np.float64]
ANGLES, SPEEDS, FORCES = slice(13, 25), slice(25, 37), slice(44, 56)


class Standing:
    """Proportional and differential control of the joints about the first pose, beside the first forces.

    Parameters
    ----------
    stiffness : of the joints [N m/rad]. damping : of the joints [N m s/rad]. horizon : moments of the flow's plan.
    """

    def __init__(self, stiffness: float = 100.0, damping: float = 2.0, horizon: int = 10) -> None:
        self._stiffness, self._damping, self._horizon = stiffness, damping, horizon
        self._arm = all_triangles().arm
        self._first: tuple[FloatArray, FloatArray] | None = None

    def fresh(self) -> Standing:
        """Return a controller that has not begun."""
        return Standing(self._stiffness, self._damping, self._horizon)

    def __call__(self, t: float, sensors: FloatArray) -> FloatArray:
        """Return the forces of the cylinders [N] and the planned flows, none."""
        angles, speeds = sensors[ANGLES], sensors[SPEEDS]
        if self._first is None:
            self._first = angles.copy(), sensors[FORCES].copy()
        pose, forces = self._first
        torque = self._stiffness * (pose - angles) - self._damping * speeds
        return np.concatenate([forces + torque / self._arm(angles), np.zeros(self._horizon + 1)])
