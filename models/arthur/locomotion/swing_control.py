"""Swing leg control (7.13): inverse dynamics with proportional and derivative feedback."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def swing_acceleration(
    desired: tuple[FloatArray, FloatArray, FloatArray],
    foot: FloatArray,
    velocity: FloatArray,
    stiffness: float,
    damping: float,
) -> FloatArray:
    """Return the accelerations to ask of the feet [m/s^2]: a + k (p - x) + d (v - dx/dt), all in the trunk's frame.

    ``leg_model.dynamics`` turns them into torques, by the operational-space inertia, Coriolis and gravity terms.

    Parameters
    ----------
    desired : position, velocity, acceleration of the swing trajectory. stiffness : k [1/s^2]. damping : d [1/s].
    """
    p, v, a = desired
    result: FloatArray = a + stiffness * (p - foot) + damping * (v - velocity)
    return result
