"""Swing leg trajectory (7.11, Algorithm 9): cubic splines in the trunk's frame."""

from __future__ import annotations

from functools import cache

import casadi as ca
import numpy as np

HALF = 0.5
"""Where the two halves of the vertical motion meet, as a share of the swing."""
MATCHED = 0.9
"""From this share of the swing on a foot goes with the ground: one that lands a little early does not slide."""


def spline_coefficients(p_0: ca.SX, p_T: ca.SX, v_0: ca.SX, v_T: ca.SX, T: float) -> ca.SX:
    """Return C_spline of 7.11.3: the cubic's coefficients, highest power first."""
    conditions = np.array(
        [[0, 0, 0, 1], [T**3, T**2, T, 1], [0, 0, 1, 0], [3 * T**2, 2 * T, 1, 0]],
    )
    return ca.DM(np.linalg.inv(conditions)) @ ca.vertcat(p_0, p_T, v_0, v_T)


def swing_position(
    S: ca.SX, T: ca.SX, start: ca.SX, v_0: ca.SX, end: ca.SX, v_1: ca.SX, height: ca.SX
) -> ca.SX:
    """Return the desired position of a foot [m] at the swing state S, as an expression.

    The report prints the powers of S lost, and both halves in S: they are cubics in S and in S - 1/2. The apex is
    start + height, the end velocity that of the ground. The horizontal motion has it from MATCHED on (retraction of
    the swing leg: Seyfarth, Geyer and Herr 2003). Beyond S = 1 the foot goes on with it.

    Parameters
    ----------
    S : 0..1 over the swing. T : T_sw [s]. start, end : positions [m]. v_0, v_1 : velocities there [m/s].
    height : H_sw [m].
    """
    t, early = ca.fmin(S, 1), ca.fmin(S, MATCHED) / MATCHED
    there = end - (1 - MATCHED) * T * v_1
    ahead = MATCHED * T
    places = [
        _cubic(spline_coefficients(start[i], there[i], ahead * v_0[i], ahead * v_1[i], 1.0), early)
        + ca.fmax(S - MATCHED, 0) * T * v_1[i]
        for i in (0, 1)
    ]
    apex = start[2] + height
    up = _cubic(spline_coefficients(start[2], apex, T * v_0[2], ca.SX(0), HALF), t)
    down = _cubic(spline_coefficients(apex, end[2], ca.SX(0), T * v_1[2], HALF), t - HALF)
    return ca.vertcat(*places, ca.if_else(t <= HALF, up, down) + ca.fmax(S - 1, 0) * T * v_1[2])


@cache
def swing_trajectory() -> ca.Function:
    """Return the function (S, T, start, v_0, end, v_1, height) -> (position, velocity, acceleration) of four feet.

    S, T, height : 4 each. start, v_0, end, v_1 : 12. See swing_position.
    """
    S, T, height = ca.SX.sym("S"), ca.SX.sym("T"), ca.SX.sym("height")
    start, v_0, end, v_1 = (ca.SX.sym(name, 3) for name in ("start", "v_0", "end", "v_1"))
    p = swing_position(S, T, start, v_0, end, v_1, height)
    v = ca.jacobian(p, S) / T
    a = ca.jacobian(v, S) / T
    outputs = [ca.densify(each) for each in (p, v, a)]
    one = ca.Function("swing", [S, T, start, v_0, end, v_1, height], outputs, {"cse": True})
    return one.map(4)


def _cubic(c: ca.SX, x: ca.SX) -> ca.SX:
    return ((c[0] * x + c[1]) * x + c[2]) * x + c[3]
