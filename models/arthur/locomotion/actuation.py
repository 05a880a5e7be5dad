"""Torque to actuator force (7.13, 8.1): the cylinders through their linkages."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from arthur_acausal.models.arthur.linkages import all_triangles

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Cylinders:
    """What the twelve cylinders can do.

    Attributes
    ----------
    A_A, A_B : piston area and annular area on the rod's side [m^2]. pressure : of the supply [Pa].
    efficiency : of force [1]. leakage : of all valves and cylinders together [m^3/s].
    q_rated, dp_land : flow of a valve fully open [m^3/s] at this drop of each land [Pa]. p_return : [Pa].
    V_A, V_B : volumes of the chambers, the piston about the middle [m^3]. beta : bulk modulus of the fluid [Pa].
    """

    A_A: float = 7.13e-5
    A_B: float = 5.35e-5
    pressure: float = 140e5
    efficiency: float = 0.95
    leakage: float = 0.0
    q_rated: float = 2e-3 / 60
    dp_land: float = 35e5
    p_return: float = 3e5
    V_A: float = 1.9e-6
    V_B: float = 1.6e-6
    beta: float = 1.4e9

    @property
    def push(self) -> float:
        """Return the largest force that extends [N]."""
        return self.efficiency * self.pressure * self.A_A

    @property
    def pull(self) -> float:
        """Return the largest force that retracts [N], positive."""
        return self.efficiency * self.pressure * self.A_B


_TRIANGLES = all_triangles()


def moment_arms(angles: FloatArray) -> FloatArray:
    """Return torque over force, and piston velocity over joint rate, of joints (..., 12) [m]."""
    return np.asarray(_TRIANGLES.arm(angles))


def actuator_forces(torques: FloatArray, angles: FloatArray) -> FloatArray:
    """Return the cylinders' forces, positive extends (..., 12) [N]."""
    return torques / moment_arms(angles)


def limited(torques: ca.SX, arms: ca.SX, cylinders: Cylinders) -> ca.SX:
    """Return the torques that the cylinders can give [N m], as an expression."""
    return ca.fmin(ca.fmax(torques / arms, -cylinders.pull), cylinders.push) * arms
