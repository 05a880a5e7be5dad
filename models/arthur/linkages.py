"""The linkages through which the quadruped's cylinders drive its joints."""

from __future__ import annotations

from dataclasses import dataclass
from math import radians

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.components.robotics import Triangle
from arthur_acausal.models.arthur.dimensions import JOINTS, LEGS, side_of

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class JointLinkage:
    """The triangle of one kind of joint: its range, sides and cylinder.

    Attributes
    ----------
    low, high : range of the joint [rad]. a, b : the sides [m]. psi_mid : angle between them at mid range [rad].
    stroke : of the cylinder [m]; the piston is in the middle where the joint's two limits are equally far.
    direction : +1 where extension increases the angle. Abduction has it for the right legs, the left are mirrored.
    """

    low: float
    high: float
    a: float
    stroke: float
    b: float = 0.15
    psi_mid: float = radians(96.0)
    direction: int = 1

    def triangle(self, direction: int | None = None) -> Triangle:
        """Return the geometry; ``direction`` in place of the own one mounts it mirrored."""
        sign = self.direction if direction is None else direction
        return Triangle(self.a, self.b, self.psi_mid - sign * (self.low + self.high) / 2, float(sign))

    @property
    def l_0(self) -> float:
        """Return the length [m] at which the piston stands in the middle of its stroke."""
        triangle = self.triangle()
        return float(triangle.length(self.low) + triangle.length(self.high)) / 2


LINKAGES = {
    "abduction": JointLinkage(radians(-35.0), radians(35.0), a=0.022, stroke=0.025),
    "hip": JointLinkage(radians(0.0), radians(90.0), a=0.026, stroke=0.036),
    "knee": JointLinkage(radians(-135.0), radians(-45.0), a=0.026, stroke=0.036),
}
"""Sized so that the report's cylinders carry a trot: moment arms 14 to 25 mm (assumed; the report gives no linkage).

Standing on a leg pushes on the larger piston side: it turns the knee and the right abduction joints forward.
"""


def direction_of(leg: str, joint: str) -> int:
    """Return +1 where extension increases a joint's angle, else -1."""
    return -side_of(leg) if joint == "abduction" else LINKAGES[joint].direction


def triangle_of(leg: str, joint: str) -> Triangle:
    """Return the geometry of one of the twelve joints."""
    return LINKAGES[joint].triangle(direction_of(leg, joint))


def all_triangles() -> Triangle:
    """Return the geometry of the twelve joints at once, in the order of JOINT_NAMES, for arrays (..., 12)."""
    each = [triangle_of(leg, joint) for leg in LEGS for joint in JOINTS]
    sides = np.array([(t.a, t.b, t.psi_0, t.direction) for t in each]).T
    return Triangle(*sides)


def middle_lengths() -> FloatArray:
    """Return the cylinders' lengths [m] with the piston in the middle, (12,): y = length(q) - middle."""
    return np.array([LINKAGES[joint].l_0 for _ in LEGS for joint in JOINTS])
