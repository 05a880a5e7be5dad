"""Translational mechanics in one dimension."""

from arthur_acausal.components.translational.braking import (
    EddyCurrentForce,
    InverseForce,
    LinearForce,
    SignForce,
)
from arthur_acausal.components.translational.elements import (
    Compliant,
    Damper,
    Fixed,
    Lever,
    Mass,
    Rod,
    SlidingMass,
    Spring,
    SpringDamper,
)
from arthur_acausal.components.translational.flange import Flange
from arthur_acausal.components.translational.friction import (
    Brake,
    MassWithFriction,
    MassWithStopAndFriction,
    SupportFriction,
)
from arthur_acausal.components.translational.sensors import (
    AccelerationSensor,
    ForceSensor,
    PositionSensor,
    PowerSensor,
    RelativePositionSensor,
    RelativeSpeedSensor,
    SpeedSensor,
)
from arthur_acausal.components.translational.sources import (
    AccelerationSource,
    ConstantForce,
    ConstantSpeed,
    ForceSource,
    LoadForce,
    PositionSource,
    QuadraticForce,
    SpeedSource,
)
from arthur_acausal.components.translational.stops import ElastoGap, EndStops, StoppedMass

__all__ = [
    "AccelerationSensor",
    "AccelerationSource",
    "Brake",
    "Compliant",
    "ConstantForce",
    "ConstantSpeed",
    "Damper",
    "EddyCurrentForce",
    "ElastoGap",
    "EndStops",
    "Fixed",
    "Flange",
    "ForceSensor",
    "ForceSource",
    "InverseForce",
    "Lever",
    "LinearForce",
    "LoadForce",
    "Mass",
    "MassWithFriction",
    "MassWithStopAndFriction",
    "PositionSensor",
    "PositionSource",
    "PowerSensor",
    "QuadraticForce",
    "RelativePositionSensor",
    "RelativeSpeedSensor",
    "Rod",
    "SignForce",
    "SlidingMass",
    "SpeedSensor",
    "SpeedSource",
    "Spring",
    "SpringDamper",
    "StoppedMass",
    "SupportFriction",
]
