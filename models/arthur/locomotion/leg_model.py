"""Kinematics and dynamics of the legs (7.4.3 to 7.4.9), as CasADi functions of the dimensions.

The dynamics library that the report leaves open: textbook rigid-body formulas, no part of the simulator.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import casadi as ca

from arthur_acausal import compile_functions
from arthur_acausal.models.arthur.dimensions import LEGS, Dimensions, Link, front_of, side_of


@dataclass(frozen=True, slots=True)
class _Leg:
    """One leg's expressions: angles, rates, the foot's centre in the trunk's frame, its links."""

    q: ca.SX
    rate: ca.SX
    foot: ca.SX
    calf_rate: ca.SX
    centres: tuple[tuple[ca.SX, Link], ...]
    mass_matrix: ca.SX


def _leg(leg: str, robot: Dimensions) -> _Leg:
    """Build the chain trunk, abduction, thigh, calf, foot of one leg (see Dimensions for the frames)."""
    side, front = side_of(leg), front_of(leg)
    q, rate = ca.SX.sym(f"q_{leg}", 3), ca.SX.sym(f"dq_{leg}", 3)
    mirror = ca.vertcat(1, side, 1)
    R_a = _about_x(q[0])
    R_t = R_a @ _about_y(q[1])
    R_c = R_a @ _about_y(q[1] + q[2])
    abduction = ca.vertcat(front * robot.hip_x, side * robot.hip_y, 0)
    hip = abduction + R_a @ ca.vertcat(0, side * robot.offset, 0)
    knee = hip + R_t @ ca.vertcat(0, 0, -robot.thigh_length)
    foot = knee + R_c @ ca.vertcat(0, 0, -robot.calf_length)

    lateral = R_a[:, 1]
    w_a = ca.vertcat(rate[0], 0, 0)
    w_t = w_a + lateral * rate[1]
    w_c = w_t + lateral * rate[2]
    frames = (
        (robot.abduction, abduction, R_a, w_a),
        (robot.thigh, hip, R_t, w_t),
        (robot.calf, knee, R_c, w_c),
    )
    mass_matrix = robot.armature * ca.SX.eye(3)
    centres = []
    for link, origin, R, w in frames:
        centre = origin + R @ (ca.DM(link.centre) * mirror)
        J_v, J_w = ca.jacobian(centre, q), R.T @ ca.jacobian(w, rate)
        mass_matrix += link.mass * J_v.T @ J_v + J_w.T @ ca.diag(ca.DM(link.inertia)) @ J_w
        centres.append((centre, link))
    return _Leg(q, rate, foot, w_c, tuple(centres), mass_matrix)


@cache
def kinematics(robot: Dimensions) -> ca.Function:
    """Return the function (q, dq, up) -> (foot, foot_velocity, contact, contact_jacobian, centre).

    q, dq : angles and rates of the joints [rad], [rad/s], 12. up : the vertical in the trunk's frame, 3.
    foot : centres of the feet, 12 [m]. foot_velocity : relative to the trunk, 12 [m/s].
    contact : lowest points of the round feet, 12 [m]. contact_jacobian : velocity of the feet's material there over
    the joints' rates, 3 x 3 by columns for each foot, 36. centre : of the robot's mass, 3 [m].
    All in the trunk's frame, leg after leg.
    """
    up = ca.SX.sym("up", 3)
    legs = [_leg(name, robot) for name in LEGS]
    moment = ca.SX(robot.trunk.centre) * robot.trunk.mass
    feet, velocities, contacts, jacobians = [], [], [], []
    for leg in legs:
        velocity = ca.jtimes(leg.foot, leg.q, leg.rate)
        arm = -robot.foot_radius * up
        feet.append(leg.foot)
        velocities.append(velocity)
        contacts.append(leg.foot + arm)
        jacobians.append(ca.vec(ca.jacobian(velocity + ca.cross(leg.calf_rate, arm), leg.rate)))
        for centre, link in leg.centres:
            moment += link.mass * centre
    q, rate = ca.vertcat(*(leg.q for leg in legs)), ca.vertcat(*(leg.rate for leg in legs))
    outputs = [ca.densify(ca.vertcat(*each)) for each in (feet, velocities, contacts, jacobians)]
    return ca.Function("kinematics", [q, rate, up], [*outputs, moment / robot.mass], _OPTIONS)


@cache
def dynamics(robot: Dimensions) -> ca.Function:
    """Return the function (q, dq, g, a) -> (load, swing): joint torques [N m], 12 each.

    The trunk does not accelerate.

    g : acceleration of gravity in the trunk's frame, 3 [m/s^2]. a : accelerations of the feet's centres, 12 [m/s^2].
    load : Coriolis, centrifugal and gravity torques. swing : operational-space inverse dynamics (Khatib 1987),
    J^T Lambda (a - dJ/dt dq) + load with Lambda = (J M^-1 J^T)^-1; for a leg of three joints J^T Lambda = M J^-1.
    """
    g, acceleration = ca.SX.sym("g", 3), ca.SX.sym("a", 12)
    loads, torques, qs, rates = [], [], [], []
    for i, name in enumerate(LEGS):
        leg = _leg(name, robot)
        q, rate, M = leg.q, leg.rate, leg.mass_matrix
        energy = ca.dot(rate, M @ rate) / 2
        potential = -sum((link.mass * ca.dot(g, centre) for centre, link in leg.centres), ca.SX(0))
        load = ca.jtimes(M @ rate, q, rate) - ca.gradient(energy - potential, q)
        J = ca.jacobian(leg.foot, q)
        drift = ca.jtimes(J @ rate, q, rate)
        loads.append(load)
        torques.append(M @ _inverse(J) @ (acceleration[3 * i : 3 * i + 3] - drift) + load)
        qs.append(q)
        rates.append(rate)
    inputs = [ca.vertcat(*qs), ca.vertcat(*rates), g, acceleration]
    return ca.Function("dynamics", inputs, [ca.vertcat(*loads), ca.vertcat(*torques)], _OPTIONS)


@cache
def inverse_kinematics(robot: Dimensions, points: int) -> ca.Function:
    """Return the function (foot, velocity) -> (q, dq) for ``points`` postures: all of 12 x points.

    foot : centres in the trunk's frame [m]. velocity : relative to the trunk [m/s]. q, dq : joints [rad], [rad/s],
    the knee bent backward. A foot out of reach gives the nearly stretched leg in its direction.
    """
    foot, velocity = ca.SX.sym("foot", 12), ca.SX.sym("velocity", 12)
    angles, rates = [], []
    for i, name in enumerate(LEGS):
        leg = _leg(name, robot)
        mine = slice(3 * i, 3 * i + 3)
        q = _angles(foot[mine], name, robot)
        J = ca.substitute(ca.jacobian(leg.foot, leg.q), leg.q, q)
        angles.append(q)
        rates.append(_inverse(J) @ velocity[mine])
    one = ca.Function("posture", [foot, velocity], [ca.vertcat(*angles), ca.vertcat(*rates)], _OPTIONS)
    return compile_functions([one])[0].map(points)


STRETCHED = 0.98
"""Longest distance of hip and foot, as a share of the leg's length: beyond, the Jacobian is nearly singular."""


def _angles(foot: ca.SX, leg: str, robot: Dimensions) -> ca.SX:
    """Return a leg's angles: the law of cosines in the plane of the leg."""
    side, a, b = side_of(leg), robot.thigh_length, robot.calf_length
    x, y, z = foot[0] - front_of(leg) * robot.hip_x, foot[1] - side * robot.hip_y, foot[2]
    depth = ca.sqrt(ca.fmax(y**2 + z**2 - robot.offset**2, (0.1 * a) ** 2))
    q_0 = ca.atan2(z, y) - ca.atan2(-depth, side * robot.offset)
    q_0 = ca.atan2(ca.sin(q_0), ca.cos(q_0))
    reach = ca.sqrt(x**2 + depth**2)
    shrink = ca.fmin(1, STRETCHED * (a + b) / reach)
    x, depth, reach = x * shrink, depth * shrink, reach * shrink
    q_2 = -ca.acos(ca.fmax(-1, (reach**2 - a**2 - b**2) / (2 * a * b)))
    q_1 = ca.atan2(-x, depth) - ca.atan2(b * ca.sin(q_2), a + b * ca.cos(q_2))
    return ca.vertcat(q_0, q_1, q_2)


def _about_x(angle: ca.SX) -> ca.SX:
    c, s = ca.cos(angle), ca.sin(angle)
    return ca.vertcat(ca.horzcat(1, 0, 0), ca.horzcat(0, c, -s), ca.horzcat(0, s, c))


def _about_y(angle: ca.SX) -> ca.SX:
    c, s = ca.cos(angle), ca.sin(angle)
    return ca.vertcat(ca.horzcat(c, 0, s), ca.horzcat(0, 1, 0), ca.horzcat(-s, 0, c))


def _inverse(A: ca.SX) -> ca.SX:
    """Return the inverse of a 3 x 3 matrix, by its adjugate."""
    rows = [ca.cross(A[:, 1], A[:, 2]), ca.cross(A[:, 2], A[:, 0]), ca.cross(A[:, 0], A[:, 1])]
    return ca.horzcat(*rows).T / ca.dot(A[:, 0], rows[0])


_OPTIONS = {"cse": True}
