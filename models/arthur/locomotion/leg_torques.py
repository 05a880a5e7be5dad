"""The joints' torques of a control tick: stance and swing control and the cylinders' limits in one function."""

from __future__ import annotations

from functools import cache

import casadi as ca

from arthur_acausal import compile_functions
from arthur_acausal.models.arthur.dimensions import Dimensions
from arthur_acausal.models.arthur.linkages import all_triangles
from arthur_acausal.models.arthur.locomotion.actuation import Cylinders, limited
from arthur_acausal.models.arthur.locomotion.leg_model import dynamics, kinematics
from arthur_acausal.models.arthur.locomotion.settings import Settings
from arthur_acausal.models.arthur.locomotion.stance_control import stance_torques
from arthur_acausal.models.arthur.locomotion.swing_control import swing_acceleration
from arthur_acausal.models.arthur.locomotion.swing_trajectory import swing_trajectory


@cache
def leg_torques(robot: Dimensions, cylinders: Cylinders, settings: Settings) -> ca.Function:
    """Return the function (stance, R, q, dq, force, S, T, start, v_0, end, v_1, height) -> torques, 12 [N m].

    stance : 1 for a leg that stands, 4. R : trunk to world, by columns, 9. q, dq : joints [rad], [rad/s], 12.
    force : of the ground on the feet, in the world, 12 [N]. The others, of the swing: see swing_trajectory.
    A leg that stands presses on the ground and carries itself; one that swings follows its trajectory.
    """
    stance, R, force = ca.SX.sym("stance", 4), ca.SX.sym("R", 3, 3), ca.SX.sym("force", 12)
    q, dq = ca.SX.sym("q", 12), ca.SX.sym("dq", 12)
    swing = [ca.SX.sym(name, n) for name, n in _SWING.items()]
    up = R[2, :].T
    foot, velocity, _, jacobian, _ = kinematics(robot)(q, dq, up)
    p, v, a = [ca.vec(each) for each in swing_trajectory()(*[_by_legs(each) for each in swing])]
    ask = swing_acceleration(p, v, a, foot, velocity, settings.stiffness, settings.damping)
    load, follow = dynamics(robot)(q, dq, -settings.gravity * up, ask)
    torques = []
    for i in range(4):
        mine = slice(3 * i, 3 * i + 3)
        J = ca.reshape(jacobian[9 * i : 9 * i + 9], 3, 3)
        press = load[mine] + stance_torques(force[mine], R, J)
        torques.append(ca.if_else(stance[i], press, follow[mine]))
    arms = all_triangles().arm(q)
    inputs = [stance, ca.vec(R), q, dq, force, *swing]
    outputs = [ca.densify(limited(ca.vertcat(*torques), arms, cylinders))]
    return compile_functions([ca.Function("leg_torques", inputs, outputs, {"cse": True})])[0]


_SWING = {"S": 4, "T": 4, "start": 12, "v_0": 12, "end": 12, "v_1": 12, "height": 4}


def _by_legs(x: ca.SX) -> ca.SX:
    """Return a column a leg, as mapped functions take them."""
    return ca.reshape(x, -1, 4)
