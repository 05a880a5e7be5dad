"""Parts of robots: linkages between actuators and joints."""

from arthur_acausal.components.robotics.linkage import CylinderLinkage
from arthur_acausal.components.robotics.triangle import Triangle

__all__ = ["CylinderLinkage", "Triangle"]
