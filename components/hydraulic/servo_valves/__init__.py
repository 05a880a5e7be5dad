"""Servo valves with the loads on what moves in them, after section 3 of the ARTHuR report."""

from arthur_acausal.components.hydraulic.servo_valves.passages import APEX, Shape, full_area, open_area
from arthur_acausal.components.hydraulic.servo_valves.rotary_body import RotaryBody
from arthur_acausal.components.hydraulic.servo_valves.rotary_valve import RotaryValve
from arthur_acausal.components.hydraulic.servo_valves.spool_body import SpoolBody
from arthur_acausal.components.hydraulic.servo_valves.spool_valve import SpoolValve

__all__ = [
    "APEX",
    "RotaryBody",
    "RotaryValve",
    "Shape",
    "SpoolBody",
    "SpoolValve",
    "full_area",
    "open_area",
]
