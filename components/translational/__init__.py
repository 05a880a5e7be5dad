"""Translational mechanics in one dimension."""

from arthur_acausal.components.translational.elements import (
    Compliant,
    Damper,
    Fixed,
    Mass,
    Spring,
    SpringDamper,
)
from arthur_acausal.components.translational.flange import Flange
from arthur_acausal.components.translational.sensors import ForceSensor, PositionSensor, SpeedSensor
from arthur_acausal.components.translational.sources import (
    ForceSource,
    LoadForce,
    PositionSource,
    SpeedSource,
)
from arthur_acausal.components.translational.stops import ElastoGap

__all__ = [
    "Compliant",
    "Damper",
    "ElastoGap",
    "Fixed",
    "Flange",
    "ForceSensor",
    "ForceSource",
    "LoadForce",
    "Mass",
    "PositionSensor",
    "PositionSource",
    "SpeedSensor",
    "SpeedSource",
    "Spring",
    "SpringDamper",
]
