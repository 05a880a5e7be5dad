"""What went wrong in a run of the quadruped, in words."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import Solution
from arthur_acausal.models.arthur.dimensions import JOINT_NAMES

FloatArray = NDArray[np.float64]

COUNTERS = {
    "at_stop": "a cylinder reached its stop",
    "cavitating": "a chamber's pressure fell below p_low",
    "valve_saturated": "a valve's current reached its limit",
    "voltage_limited": "the bus voltage limited the motor",
    "current_limited": "the drive limited the motor's current",
}
"""The quadruped's discrete variables that count, and what they count."""


def counts(solution: Solution) -> dict[str, int]:
    """Return how often each kind of trouble came."""
    return {name: round(solution.final(name)) for name in COUNTERS}


def notes(solution: Solution) -> list[str]:
    """Return a line about each kind of trouble that came, with the joints that had it, and about a fall."""
    lines = []
    for name, number in counts(solution).items():
        if number:
            times = "once" if number == 1 else f"{number} times"
            lines.append(f"{COUNTERS[name]} {times}{_where(solution, name)}")
    if solution.final("fallen"):
        lines.append(f"the robot fell at {solution.t[-1]:.3g} s")
    return lines


def _where(solution: Solution, name: str) -> str:
    """Return the joints that were concerned when a counter rose, the first of them first."""
    rose = np.flatnonzero(np.diff(solution[name]) > 0) + 1
    margins = _margins(solution, name)
    if margins is None or not rose.size:
        return ""
    joints = dict.fromkeys(JOINT_NAMES[i] for i in margins[rose].argmax(axis=1))
    return f": {', '.join(joints)}"


def _margins(solution: Solution, name: str) -> FloatArray | None:
    """Return how near each actuator is to a kind of trouble (nt, 12), largest where it is nearest."""

    def all_of(signal: str) -> FloatArray:
        return solution.values([f"actuators[{i}].{signal}" for i in range(len(JOINT_NAMES))])

    if name == "at_stop":
        y = all_of("cylinder.y")
        return np.maximum(y - all_of("cylinder.y_max"), all_of("cylinder.y_min") - y)
    if name == "cavitating":
        return -np.minimum(all_of("cylinder.p_A"), all_of("cylinder.p_B"))
    if name == "valve_saturated":
        return np.abs(all_of("control.I")) - all_of("control.I_rated")
    return None
