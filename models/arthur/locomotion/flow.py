"""The flow that the planned motion will need, for the control of the pump. The report names it without a law."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.models.arthur.locomotion.actuation import Cylinders, moment_arms

FloatArray = NDArray[np.float64]


def predicted_flow(angles: FloatArray, rates: FloatArray, cylinders: Cylinders) -> FloatArray:
    """Return the supply's flow (...) [m^3/s] for planned joint angles [rad] and rates [rad/s] (..., 12).

    Through the linkages to piston velocities v = arm(q) dq/dt; an extending cylinder draws A_A v, a retracting one
    -A_B v; the leakage comes in addition. Compressibility is left out.
    """
    v = moment_arms(angles) * rates
    flow: FloatArray = (
        np.where(v > 0.0, cylinders.A_A * v, -cylinders.A_B * v).sum(axis=-1) + cylinders.leakage
    )
    return flow
