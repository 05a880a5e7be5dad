"""Desired foot placement (7.8, Algorithm 8)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.models.arthur.dimensions import LEGS, Dimensions, front_of, side_of
from arthur_acausal.models.arthur.locomotion.rotation import cross

FloatArray = NDArray[np.float64]


def hips(robot: Dimensions, inward: float) -> FloatArray:
    """Return the neutral places of the feet relative to the trunk, p_ref in a level frame of its heading (4, 3) [m]."""
    y = robot.hip_y + robot.offset - inward
    return np.array([[front_of(leg) * robot.hip_x, side_of(leg) * y, 0.0] for leg in LEGS])


def foot_placement(
    hip: FloatArray,
    velocity: FloatArray,
    desired: FloatArray,
    yaw_rate: float,
    stance_time: float,
    gain: float,
) -> FloatArray:
    """Return where feet shall land, relative to the trunk at landing, in a level frame of its heading (..., 3) [m].

    p_ref + v_d T_st / 2 + k (v - v_d), v_d including the yaw rate: half the way that the hip moves during the
    stance, corrected for the error of velocity (Raibert 1986). Algorithm 8 puts the measured velocity in the first
    term and the stride's time for the stance's, at which the robot was slow and slipped.

    Parameters
    ----------
    hip : p_ref (..., 3) [m]. velocity, desired : of the trunk, in the same frame [m/s].
    yaw_rate : desired [rad/s]. stance_time : T_st [s]. gain : k [s].
    """
    there = desired + cross(np.array([0.0, 0.0, yaw_rate]), hip)
    place = hip + there * (stance_time / 2.0) + gain * (velocity - desired)
    place[..., 2] = 0.0
    return place
