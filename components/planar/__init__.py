"""Mechanics in the plane: bodies, joints, links and springs, in kinematic chains and loops."""

from arthur_acausal.components.planar.bodies import Body, Fixed, PointMass
from arthur_acausal.components.planar.forces import Damper, LineForce, Spring, SpringDamper, WorldForce
from arthur_acausal.components.planar.frame import Frame, Gravity
from arthur_acausal.components.planar.joints import LoopPrismatic, LoopRevolute, Prismatic, Revolute
from arthur_acausal.components.planar.links import FixedRotation, FixedTranslation

__all__ = [
    "Body",
    "Damper",
    "Fixed",
    "FixedRotation",
    "FixedTranslation",
    "Frame",
    "Gravity",
    "LineForce",
    "LoopPrismatic",
    "LoopRevolute",
    "PointMass",
    "Prismatic",
    "Revolute",
    "Spring",
    "SpringDamper",
    "WorldForce",
]
