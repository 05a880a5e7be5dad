"""The walk state machine (7.5, Algorithms 3 and 4)."""

from __future__ import annotations

from enum import Enum


class Walk(Enum):
    """Whether the robot stands or walks."""

    STAND = "stand"
    WALK = "walk"


def walk_state(speed: float, still: float, gait: str) -> Walk:
    """Return WALK where a speed |v_d| above ``still`` [m/s] is commanded: the gait modulator is started or stopped.

    ``speed`` includes the yaw rate times the hips' radius. The gait "stand" always stands.
    """
    return Walk.WALK if speed > still and gait != "stand" else Walk.STAND
