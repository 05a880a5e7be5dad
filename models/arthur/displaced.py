"""Starts that differ a little: a robot that stands, its legs displaced at random."""

from __future__ import annotations

import numpy as np

from arthur_acausal.models.arthur.dimensions import JOINT_NAMES, LEGS, Dimensions

DISPLACED = 0.02
"""Most that abduction and hip are displaced [rad]; see `Dimensions.standing`."""


def displaced(random: np.random.Generator) -> dict[str, float]:
    """Return start values [rad] of the quadruped's joints, by path."""
    shifts = random.uniform(-DISPLACED, DISPLACED, 2 * len(LEGS)).tolist()
    return {
        f"body.{joint}_phi": angle
        for joint, angle in zip(JOINT_NAMES, Dimensions().standing(shifts), strict=True)
    }


def start_of(seed: int) -> dict[str, float]:
    """Return those of a seed, which also gives the sensors' noise."""
    return displaced(np.random.default_rng([seed, 1]))
