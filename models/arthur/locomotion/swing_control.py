"""Swing leg control (7.13): inverse dynamics with proportional and derivative feedback."""

from __future__ import annotations

import casadi as ca


def swing_acceleration(
    p: ca.SX, v: ca.SX, a: ca.SX, foot: ca.SX, velocity: ca.SX, stiffness: float, damping: float
) -> ca.SX:
    """Return the acceleration to ask of a foot [m/s^2]: a + k (p - x) + d (v - dx/dt), all in the trunk's frame.

    ``leg_model.dynamics`` turns it into torques, by the operational-space inertia, Coriolis and gravity terms.

    Parameters
    ----------
    p, v, a : position, velocity, acceleration of the swing trajectory. foot, velocity : x and dx/dt, measured.
    stiffness : k [1/s^2]. damping : d [1/s].
    """
    return a + stiffness * (p - foot) + damping * (v - velocity)
