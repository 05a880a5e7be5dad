"""Stance leg trajectory (7.10): where the feet are over the horizon, and which of them stand."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from arthur_acausal import compile_functions
from arthur_acausal.models.arthur.locomotion.swing_trajectory import swing_position

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

NEVER = 1e3
"""Time [s] that stands for a lift-off which will not come."""


@dataclass(slots=True)
class FootPlan:
    """The feet's planned motion relative to the trunk, on the horizon's grid t = 0, h, ..., N h.

    Attributes
    ----------
    foot : centres in the trunk's frame of that time (N + 1, 4, 3) [m]. velocity : relative to the trunk [m/s].
    stance : whether a foot stands during the step from t to t + h (N, 4); the first step is the present state.
    """

    foot: FloatArray
    velocity: FloatArray
    stance: BoolArray


@cache
def foot_plan(steps: int, h: float) -> ca.Function:
    """Return the function that plans the four legs' feet.

    (phase, swing, T, start, v_0, end, v_1, height, next, v, w) -> (foot, velocity, stance), for each leg:

    phase : time to the end of the present phase [s], T_st, T_sw [s], swing state S_sw (4). swing : 1 if it swings.
    start, v_0, end, v_1, height : the present swing (see swing_position); for a leg that stands, ``start`` is where
    it is. next : where the next swing ends. v, w : the trunk's velocity and angular velocity in its own frame.
    foot, velocity : 3 x (N + 1). stance : at the middle of each step, N.

    A stance foot moves with -(v + w x r) relative to the trunk, to first order in w. Only one full phase after the
    present one is planned: what follows lies beyond the horizon.
    """
    phase, swing = ca.SX.sym("phase", 4), ca.SX.sym("swing")
    start, v_0, end, v_1, after = (ca.SX.sym(n, 3) for n in ("start", "v_0", "end", "v_1", "next"))
    height, v, w, t = ca.SX.sym("height"), ca.SX.sym("v", 3), ca.SX.sym("w", 3), ca.SX.sym("t")
    remaining, T_st, T_sw, S = phase[0], phase[1], phase[2], phase[3]

    def ground(r: ca.SX) -> ca.SX:
        return -(v + ca.cross(w, r))

    def stand(r: ca.SX, since: ca.SX) -> ca.SX:
        return r + ground(r) * since

    touch = ca.vertcat(0, 0, v_1[2])
    lift = ca.if_else(swing, remaining + T_st, remaining)
    land = lift + T_sw
    landed = ca.if_else(swing, end, start)
    lifted = stand(landed, lift - ca.if_else(swing, remaining, 0))
    now = swing_position(S + t / T_sw, T_sw, start, v_0, end, v_1, height)
    first = ca.if_else(
        ca.logic_and(swing, t < remaining), now, stand(landed, t - ca.if_else(swing, remaining, 0))
    )
    second = swing_position(
        (t - lift) / T_sw, T_sw, lifted, ground(lifted), after, ground(after) + touch, height
    )
    place = ca.if_else(t < lift, first, ca.if_else(t < land, second, stand(after, t - land)))
    flying = ca.logic_or(ca.logic_and(swing, t < remaining), ca.logic_and(t >= lift, t < land))
    motion = [place, ca.jacobian(place, t), ca.logic_not(flying)]

    inputs = [phase, swing, start, v_0, end, v_1, height, after, v, w]
    at = ca.Function("foot_at", [t, *inputs], motion)
    grid = [at(k * h, *inputs) for k in range(steps + 1)]
    middle = [at((k + 0.5) * h, *inputs)[2] for k in range(steps)]
    outputs = [ca.horzcat(*(g[0] for g in grid)), ca.horzcat(*(g[1] for g in grid)), ca.horzcat(*middle)]
    one = ca.Function("plan", inputs, [ca.densify(each) for each in outputs], {"cse": True})
    return compile_functions([one])[0].map(4)


def stance_vectors(
    plan: FootPlan, R: FloatArray, yaw_rate: float, centre: FloatArray, radius: float, times: FloatArray
) -> FloatArray:
    """Return the vectors from the centre of mass to the feet's lowest points, in the world (N, 4, 3) [m].

    Parameters
    ----------
    R : present orientation of the trunk. yaw_rate : desired [rad/s]. centre : of mass from the trunk's centre, in the
        world [m]. radius : of the feet [m]. times : beginnings of the steps (N,) [s].
    """
    turns = np.zeros((len(times), 3, 3))
    turns[:, 0, 0] = turns[:, 1, 1] = np.cos(yaw_rate * times)
    turns[:, 1, 0] = np.sin(yaw_rate * times)
    turns[:, 0, 1] = -turns[:, 1, 0]
    turns[:, 2, 2] = 1.0
    arms = plan.foot[:-1] @ (turns @ R).transpose(0, 2, 1) - centre
    arms[:, :, 2] -= radius
    return arms
