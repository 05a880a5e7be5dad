"""Rotational mechanics in one dimension."""

from arthur_acausal.components.rotational.backlash import ElastoBacklash
from arthur_acausal.components.rotational.braking import (
    EddyCurrentTorque,
    InverseTorque,
    LinearTorque,
    SignTorque,
)
from arthur_acausal.components.rotational.elements import (
    Compliant,
    Damper,
    Disc,
    Fixed,
    Inertia,
    Spring,
    SpringDamper,
)
from arthur_acausal.components.rotational.flange import Flange
from arthur_acausal.components.rotational.friction import BearingFriction, Brake, Clutch, OneWayClutch
from arthur_acausal.components.rotational.gears import IdealGear, IdealGearR2T, IdealPlanetary, LossyGear
from arthur_acausal.components.rotational.sensors import (
    AccelerationSensor,
    AngleSensor,
    PowerSensor,
    RelativeAngleSensor,
    RelativeSpeedSensor,
    SpeedSensor,
    TorqueSensor,
)
from arthur_acausal.components.rotational.sources import (
    AngleSource,
    ConstantSpeed,
    ConstantTorque,
    QuadraticTorque,
    SpeedSource,
    TorqueSource,
)
from arthur_acausal.components.rotational.vehicle import Vehicle

__all__ = [
    "AccelerationSensor",
    "AngleSensor",
    "AngleSource",
    "BearingFriction",
    "Brake",
    "Clutch",
    "Compliant",
    "ConstantSpeed",
    "ConstantTorque",
    "Damper",
    "Disc",
    "EddyCurrentTorque",
    "ElastoBacklash",
    "Fixed",
    "Flange",
    "IdealGear",
    "IdealGearR2T",
    "IdealPlanetary",
    "Inertia",
    "InverseTorque",
    "LinearTorque",
    "LossyGear",
    "OneWayClutch",
    "PowerSensor",
    "QuadraticTorque",
    "RelativeAngleSensor",
    "RelativeSpeedSensor",
    "SignTorque",
    "SpeedSensor",
    "SpeedSource",
    "Spring",
    "SpringDamper",
    "TorqueSensor",
    "TorqueSource",
    "Vehicle",
]
