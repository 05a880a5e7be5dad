"""Hydraulics: absolute pressures in Pa, flows as mass flow over the fluid's reference density in m^3/s."""

from arthur_acausal.components.hydraulic.accumulator import Accumulator
from arthur_acausal.components.hydraulic.battery import BatteryDrive
from arthur_acausal.components.hydraulic.check_valve import CheckValve
from arthur_acausal.components.hydraulic.cylinder import Cylinder
from arthur_acausal.components.hydraulic.displacement import HydraulicMotor, SpeedPump
from arthur_acausal.components.hydraulic.filter import Filter, SignalFilter
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.gear_pump import GearPump
from arthur_acausal.components.hydraulic.line import Line, LineSegment
from arthur_acausal.components.hydraulic.motor import BrushlessMotor
from arthur_acausal.components.hydraulic.orifice import Orifice, VariableOrifice
from arthur_acausal.components.hydraulic.pilot_valves import (
    CounterbalanceValve,
    PilotCheckValve,
    PressureReducingValve,
    SequenceValve,
    ShuttleValve,
    SwitchedCheckValve,
)
from arthur_acausal.components.hydraulic.piston import Piston
from arthur_acausal.components.hydraulic.ports import HydraulicPort
from arthur_acausal.components.hydraulic.pump_scaling import (
    GPM,
    GPM_EXACT,
    PumpSize,
    consistent_displacement,
    gear_size,
    pump_scaling,
)
from arthur_acausal.components.hydraulic.ram import Ram
from arthur_acausal.components.hydraulic.relief_valve import ReliefValve
from arthur_acausal.components.hydraulic.reservoir import GasReservoir
from arthur_acausal.components.hydraulic.resistance import LaminarPipe, LinearResistance, Pipe
from arthur_acausal.components.hydraulic.sensors import FlowSensor, PressureDifferenceSensor, PressureSensor
from arthur_acausal.components.hydraulic.servo_valve import ServoValve
from arthur_acausal.components.hydraulic.servo_valves import RotaryBody, RotaryValve, SpoolBody, SpoolValve
from arthur_acausal.components.hydraulic.sources import (
    ControlledFlowSource,
    ControlledPressureSource,
    FlowSource,
    PressureSource,
)
from arthur_acausal.components.hydraulic.spool import CentreEdge, LoadSelector, MeteringEdge, Spool
from arthur_acausal.components.hydraulic.spool_valves import (
    LoadSensingValve,
    OpenCentreValve,
    Valve22,
    Valve33,
    Valve43,
)
from arthur_acausal.components.hydraulic.tank import Tank
from arthur_acausal.components.hydraulic.two_port import TwoPort
from arthur_acausal.components.hydraulic.volume import Volume
from arthur_acausal.components.hydraulic.wave_line import WaveLine

__all__ = [
    "GPM",
    "GPM_EXACT",
    "Accumulator",
    "BatteryDrive",
    "BrushlessMotor",
    "CentreEdge",
    "CheckValve",
    "ControlledFlowSource",
    "ControlledPressureSource",
    "CounterbalanceValve",
    "Cylinder",
    "Filter",
    "FlowSensor",
    "FlowSource",
    "Fluid",
    "GasReservoir",
    "GearPump",
    "HydraulicMotor",
    "HydraulicPort",
    "LaminarPipe",
    "Line",
    "LineSegment",
    "LinearResistance",
    "LoadSelector",
    "LoadSensingValve",
    "MeteringEdge",
    "OpenCentreValve",
    "Orifice",
    "PilotCheckValve",
    "Pipe",
    "Piston",
    "PressureDifferenceSensor",
    "PressureReducingValve",
    "PressureSensor",
    "PressureSource",
    "PumpSize",
    "Ram",
    "ReliefValve",
    "RotaryBody",
    "RotaryValve",
    "SequenceValve",
    "ServoValve",
    "ShuttleValve",
    "SignalFilter",
    "SpeedPump",
    "Spool",
    "SpoolBody",
    "SpoolValve",
    "SwitchedCheckValve",
    "Tank",
    "TwoPort",
    "Valve22",
    "Valve33",
    "Valve43",
    "VariableOrifice",
    "Volume",
    "WaveLine",
    "consistent_displacement",
    "gear_size",
    "pump_scaling",
]
