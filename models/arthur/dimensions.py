"""The quadruped's dimensions: one source for the rigid bodies, the linkages and the controllers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import acos, cos, sin

LEGS = ("FL", "FR", "RL", "RR")
"""Front left, front right, rear left, rear right: x points forward, y to the left, z up."""
JOINTS = ("abduction", "hip", "knee")
JOINT_NAMES = tuple(f"{leg}_{joint}" for leg in LEGS for joint in JOINTS)
"""The twelve joints in the order of every vector of joints."""


@dataclass(frozen=True, slots=True)
class Link:
    """A rigid body: mass [kg], centre of mass [m] and principal inertia about it [kg m^2], in its own frame."""

    mass: float
    centre: tuple[float, float, float]
    inertia: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Dimensions:
    """A quadruped of 10 kg: a free trunk and four legs of abduction, hip and knee, with round feet.

    Frames are parallel at zero angles, where the legs hang straight down. Abduction turns about x, hip and knee about
    y: a positive hip angle moves the knee backward, a negative knee angle the foot forward. Links are given for a leg
    on the left; on the right y is mirrored. The report gives no legs: all values are assumed, sized so that the
    report's cylinders carry a trot (see ``models.arthur.quadruped``).

    Attributes
    ----------
    hip_x, hip_y : place of the abduction joints on the trunk [m], ahead and aside of its centre.
    offset : from the abduction joint sideways to the plane of the leg [m].
    thigh_length, calf_length : hip to knee, knee to the foot's centre [m].
    foot_radius : [m]. friction : coefficient of sliding friction of the feet [1].
    armature : of each joint, the piston's mass reflected [kg m^2].
    stand_height : of the trunk's centre above the ground when standing [m].
    trunk_size : edges of the trunk [m].
    trunk, abduction, thigh, calf : the bodies. The calf's includes the foot.
    contact_time : time constant of the contacts [s]; contact_impedance, contact_width [m] : they grow smoothly from 0
        to this share of the constraint force over this depth.
    """

    hip_x: float = 0.17
    hip_y: float = 0.06
    offset: float = 0.05
    thigh_length: float = 0.16
    calf_length: float = 0.16
    foot_radius: float = 0.02
    friction: float = 0.6
    armature: float = 6e-5
    stand_height: float = 0.25
    trunk_size: tuple[float, float, float] = (0.40, 0.16, 0.10)
    trunk: Link = Link(6.0, (0.0, 0.0, 0.0), (0.018, 0.070, 0.078))
    abduction: Link = Link(0.42, (0.0, 0.025, 0.0), (2.2e-4, 2.2e-4, 2.2e-4))
    thigh: Link = Link(0.42, (0.0, 0.0, -0.06), (9.6e-4, 9.6e-4, 1.3e-4))
    calf: Link = Link(0.13, (0.0, 0.0, -0.08), (3.6e-4, 3.6e-4, 2.0e-5))
    contact_time: float = 0.01
    contact_impedance: float = 0.95
    contact_width: float = 0.003

    @property
    def mass(self) -> float:
        """Return the mass of the whole robot [kg]."""
        return self.trunk.mass + len(LEGS) * (self.abduction.mass + self.thigh.mass + self.calf.mass)

    @property
    def stand(self) -> tuple[float, float, float]:
        """Return abduction, hip and knee angle [rad] of a leg that stands, the foot straight below the hip."""
        a, b, height = self.thigh_length, self.calf_length, self.stand_height - self.foot_radius
        knee = -acos((height**2 - a**2 - b**2) / (2 * a * b))
        hip = acos((height**2 + a**2 - b**2) / (2 * a * height))
        return 0.0, hip, knee

    def standing(self, shifts: Sequence[float]) -> list[float]:
        """Return angles [rad] of a robot that stands, in the order of JOINT_NAMES, displaced by ``shifts`` [rad].

        There are two for each leg, of abduction and hip. The knees make up for them so that all feet are as high as
        in `stand`: on feet that are not, a robot this stiff would rock, and in no position be in balance.
        """
        angles: list[float] = []
        below = self.stand_height - self.foot_radius
        _, straight, _ = self.stand
        for k, leg in enumerate(LEGS):
            abduction, hip = shifts[2 * k], straight + shifts[2 * k + 1]
            length = (below + side_of(leg) * self.offset * sin(abduction)) / cos(abduction)
            calf = -acos((length - self.thigh_length * cos(hip)) / self.calf_length)
            angles += [abduction, hip, calf - hip]
        return angles


def side_of(leg: str) -> int:
    """Return +1 for a leg on the left, -1 on the right."""
    return 1 if leg.endswith("L") else -1


def front_of(leg: str) -> int:
    """Return +1 for a front leg, -1 for a rear leg."""
    return 1 if leg.startswith("F") else -1
