"""Signal blocks. Without units as they stand; ``Sine.of("A")`` is a sine in amperes."""

from arthur_acausal.components.blocks.arithmetic import Add, Feedback, Gain, Limiter, Product
from arthur_acausal.components.blocks.continuous import PID, FirstOrder, Integrator, SecondOrder
from arthur_acausal.components.blocks.energy import EnergyMeter
from arthur_acausal.components.blocks.signal import SISO, Block, Source
from arthur_acausal.components.blocks.sources import Clock, Constant, Ramp, Sine, Step, TimeTable, Trapezoid

__all__ = [
    "PID",
    "SISO",
    "Add",
    "Block",
    "Clock",
    "Constant",
    "EnergyMeter",
    "Feedback",
    "FirstOrder",
    "Gain",
    "Integrator",
    "Limiter",
    "Product",
    "Ramp",
    "SecondOrder",
    "Sine",
    "Source",
    "Step",
    "TimeTable",
    "Trapezoid",
]
