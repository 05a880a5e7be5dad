"""Heat transfer between lumped bodies, named as in the Modelica Standard Library (Thermal.HeatTransfer)."""

from arthur_acausal.components.thermal.elements import (
    BodyRadiation,
    Convection,
    HeatCapacitor,
    ThermalCollector,
    ThermalConductor,
    ThermalElement,
    ThermalResistor,
)
from arthur_acausal.components.thermal.heat_port import HeatPort
from arthur_acausal.components.thermal.sensors import (
    HeatFlowSensor,
    RelativeTemperatureSensor,
    TemperatureSensor,
)
from arthur_acausal.components.thermal.sources import (
    FixedHeatFlow,
    FixedTemperature,
    PrescribedHeatFlow,
    PrescribedTemperature,
)

__all__ = [
    "BodyRadiation",
    "Convection",
    "FixedHeatFlow",
    "FixedTemperature",
    "HeatCapacitor",
    "HeatFlowSensor",
    "HeatPort",
    "PrescribedHeatFlow",
    "PrescribedTemperature",
    "RelativeTemperatureSensor",
    "TemperatureSensor",
    "ThermalCollector",
    "ThermalConductor",
    "ThermalElement",
    "ThermalResistor",
]
