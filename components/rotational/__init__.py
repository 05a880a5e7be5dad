"""Rotational mechanics in one dimension."""

from arthur_acausal.components.rotational.elements import (
    Compliant,
    Damper,
    Fixed,
    IdealGear,
    Inertia,
    Spring,
    SpringDamper,
)
from arthur_acausal.components.rotational.flange import Flange
from arthur_acausal.components.rotational.sensors import AngleSensor, SpeedSensor, TorqueSensor
from arthur_acausal.components.rotational.sources import SpeedSource, TorqueSource

__all__ = [
    "AngleSensor",
    "Compliant",
    "Damper",
    "Fixed",
    "Flange",
    "IdealGear",
    "Inertia",
    "SpeedSensor",
    "SpeedSource",
    "Spring",
    "SpringDamper",
    "TorqueSensor",
    "TorqueSource",
]
