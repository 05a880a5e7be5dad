"""What the planned motion will need of the supply, for the control of the pump: flow and pressure.

The report names the prediction without a law. From the planned feet and forces, through the linkages, to pistons and
chambers; what leaks in the pump itself is its controller's affair.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.models.arthur.locomotion.actuation import Cylinders, moment_arms

FloatArray = NDArray[np.float64]


def predicted_flow(angles: FloatArray, rates: FloatArray, cylinders: Cylinders) -> FloatArray:
    """Return the supply's flow (...) [m^3/s] for planned joint angles [rad] and rates [rad/s] (..., 12).

    Through the linkages to piston velocities v = arm(q) dq/dt; an extending cylinder draws A_A v, a retracting one
    -A_B v; the leakage of valves and cylinders comes in addition.
    """
    v = moment_arms(angles) * rates
    flow: FloatArray = (
        np.where(v > 0.0, cylinders.A_A * v, -cylinders.A_B * v).sum(axis=-1) + cylinders.leakage
    )
    return flow


def compression_flow(forces: FloatArray, h: float, cylinders: Cylinders) -> FloatArray:
    """Return the flow (N + 1,) [m^3/s] that fills the chambers as planned forces (N + 1, 12) [N] change, h [s] apart.

    At touch-down and lift-off a force jumps. The chambers' pressures keep their sum, as both lands of a valve drop
    alike: a force that grows by dF raises p_A by dF/(A_A + A_B), and chamber A takes V_A/beta times that from the
    supply while B gives as much to the return; one that falls fills B. Spread over the step about the change; what
    changes now is not known, 0.
    """
    change = np.diff(forces, axis=0, prepend=forces[:1])
    volume = np.where(change > 0.0, cylinders.V_A * change, -cylinders.V_B * change)
    flow: FloatArray = volume.sum(axis=1) / (cylinders.beta * (cylinders.A_A + cylinders.A_B) * h)
    return flow


def piston_forces(ground: FloatArray, jacobians: FloatArray, R: FloatArray, angles: FloatArray) -> FloatArray:
    """Return the cylinders' forces (N, 12) [N] that bear planned forces of the ground on the feet (N, 4, 3) [N].

    ``jacobians`` : of the feet's contact points (N, 4, 3, 3), trunk's frame. ``R`` : trunk to world. ``angles`` : of
    the joints (N, 12). The legs' own weight and inertia are left out: 1 kg a leg.
    """
    torques = -np.einsum("nlij,nli->nlj", jacobians, ground @ R)
    forces: FloatArray = torques.reshape(-1, 12) / moment_arms(angles)
    return forces


def required_pressure(
    forces: FloatArray, angles: FloatArray, rates: FloatArray, cylinders: Cylinders
) -> FloatArray:
    """Return the supply pressure (...) [Pa] by which the pistons can give ``forces`` [N] at ``rates`` (..., 12).

    The greatest over the cylinders, each with its valve fully open: the chamber that is fed has the supply's pressure
    less the drop of its land, dp_land (A v/q_rated)^2, the other the return's and the drop of its own; piston and
    seals pass the share ``efficiency`` of the force.
    """
    c, v = cylinders, moment_arms(angles) * rates
    out_A, out_B = (c.dp_land * (A * v / c.q_rated) ** 2 for A in (c.A_A, c.A_B))
    extend = out_A + ((c.p_return + out_B) * c.A_B + forces / c.efficiency) / c.A_A
    retract = out_B + ((c.p_return + out_A) * c.A_A - forces / c.efficiency) / c.A_B
    moving = np.where(v > 0.0, extend, retract)
    holding = np.where(forces > 0.0, forces / c.A_A, -forces / c.A_B) / c.efficiency + c.p_return
    needed: FloatArray = np.maximum(moving, holding).max(axis=-1)
    return needed
