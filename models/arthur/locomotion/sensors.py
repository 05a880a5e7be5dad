"""Sensor inputs (7.3), and their noise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.models.arthur.locomotion.settings import Noise

FloatArray = NDArray[np.float64]

FIELDS = {
    "position": 3,
    "orientation": 4,
    "velocity": 3,
    "rate": 3,
    "angles": 12,
    "speeds": 12,
    "forces": 4,
    "acceleration": 3,
}
"""The parts of the vector of inputs in order, and their lengths."""
N_INPUTS = sum(FIELDS.values())


@dataclass(slots=True)
class Sensors:
    """One reading.

    Attributes
    ----------
    position : of the trunk in the world [m] (optional, 7.3.10). orientation : its quaternion (w, x, y, z).
    velocity : of the trunk in the world [m/s] (optional, 7.3.9). rate : angular velocity in the trunk's frame [rad/s].
    angles, speeds : of the joints [rad], [rad/s]. forces : normal forces on the feet [N].
    acceleration : of the accelerometer at the trunk's centre, gravity included, in the trunk's frame [m/s^2].
    """

    position: FloatArray
    orientation: FloatArray
    velocity: FloatArray
    rate: FloatArray
    angles: FloatArray
    speeds: FloatArray
    forces: FloatArray
    acceleration: FloatArray


class Reader:
    """Takes the vector of inputs apart and adds white noise, repeatable by its seed; without a seed there is none."""

    def __init__(self, noise: Noise, seed: int | None) -> None:
        self._random = None if seed is None else np.random.default_rng(seed)
        deviations = {
            "position": noise.position,
            "velocity": noise.velocity,
            "rate": noise.rate,
            "angles": noise.angle,
            "speeds": noise.speed,
            "forces": noise.force,
            "acceleration": noise.acceleration,
        }
        self._deviation = np.concatenate(
            [np.full(n, deviations.get(name, 0.0)) for name, n in FIELDS.items()]
        )
        self._half_angle = noise.orientation / 2
        self._ends = np.cumsum(list(FIELDS.values()))[:-1].tolist()

    def __call__(self, inputs: FloatArray) -> Sensors:
        values = np.array(inputs, dtype=float)
        if self._random is not None:
            values += self._deviation * self._random.standard_normal(N_INPUTS)
        starts = [0, *self._ends]
        parts = [values[a:b] for a, b in zip(starts, [*self._ends, N_INPUTS], strict=True)]
        sensors = Sensors(*parts)
        if self._random is not None:
            w, *v = sensors.orientation
            x, y, z = v
            a, b, c = self._half_angle * self._random.standard_normal(3)
            # q (1, d/2): a small turn d in the trunk's frame.
            sensors.orientation += (
                -x * a - y * b - z * c,
                w * a + y * c - z * b,
                w * b + z * a - x * c,
                w * c + x * b - y * a,
            )
        return sensors
