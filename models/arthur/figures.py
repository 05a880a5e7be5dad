"""The figures of a run of the quadruped: how it walked, how its forces followed, what it took."""

from __future__ import annotations

from math import hypot
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import Solution
from arthur_acausal.models.arthur.dimensions import JOINT_NAMES, LEGS, Dimensions
from arthur_acausal.models.arthur.locomotion.kernel import Kernel
from arthur_acausal.models.arthur.locomotion.leg_model import kinematics

FloatArray = NDArray[np.float64]

SETTLED = 1.0
"""Attitude, slip, tracking and mean speed count from here on [s], in a run that lasts longer."""
LOADED, SLIPPING = 5.0, 0.05
"""A foot stands above this normal force [N]; it slips when its contact point is faster than this [m/s]."""
GRAVITY = 9.81


def figures(solution: Solution, payload: float) -> dict[str, Any]:
    """Return ``locomotion`` and ``cost_of_transport``, ready for JSON.

    Distances are horizontal; ``mean_speed_m_s`` is the distance after the first second over the time. ``slip_share``
    is the share of stance (normal force above 5 N) in which the contact point moves faster than 0.05 m/s on level
    ground. ``force_tracking_rms`` is the rms error of the twelve forces over the rms of the demand.
    ``cost_of_transport`` is the battery's energy over weight and distance; None where it stays in place.
    """
    t = solution.t
    settled = t >= SETTLED if t[-1] > SETTLED else np.ones(t.size, dtype=bool)
    x, y = solution["body.base_x"], solution["body.base_y"]
    far = hypot(x[-1] - x[0], y[-1] - y[0])
    later = hypot(x[-1] - x[settled][0], y[-1] - y[settled][0])
    span = float(t[-1] - t[settled][0])
    roll, pitch = np.degrees(np.abs(attitude(solution)[:, settled])).max(axis=1)
    energy = float(np.trapezoid(solution["unit.drive.P_battery"], t))
    weight = (Dimensions().mass + payload) * GRAVITY
    walked = {
        "fell": bool(solution.final("fallen")),
        "distance_m": far,
        "mean_speed_m_s": later / span if span else 0.0,
        "max_roll_deg": float(roll),
        "max_pitch_deg": float(pitch),
        "slip_share": slip_share(solution, settled),
        "force_tracking_rms": tracking(solution, settled),
    }
    moved = far > Dimensions().foot_radius
    return {"locomotion": walked, "cost_of_transport": energy / (weight * far) if moved else None}


def valve_actuation(solution: Solution, begin: float = 0.0) -> dict[str, float]:
    """Return what the drives of the robot's driven valves took from ``begin`` [s] on, as means of a valve.

    ``mechanical_W`` counts what the valves take, not what they give back; ``copper_W`` is that of the windings;
    ``torque_max_Nm`` and ``opening_max``, over the port's width, are the largest of all.
    ``force_tracking_rms`` is the rms error of these cylinders' forces over the rms of the demand.
    """
    counted = solution.t >= begin
    t = solution.t[counted]
    drives = solution.select("actuators[*].valve.drive.P")
    actuators = [path.removesuffix(".valve.drive.P") for path in drives]

    def of_all(signal: str) -> FloatArray:
        return solution.values([f"{actuator}.{signal}" for actuator in actuators])[counted]

    def mean(power: FloatArray) -> float:
        return float(np.trapezoid(power.mean(axis=1), t) / np.ptp(t))

    error, demand = of_all("control.e"), of_all("F_d")
    return {
        "valves": len(actuators),
        "mechanical_W": mean(np.maximum(of_all("valve.drive.P"), 0.0)),
        "copper_W": mean(of_all("valve.drive.P_copper")),
        "torque_max_Nm": float(np.abs(of_all("valve.drive.flange.tau")).max()),
        "opening_max": float(np.abs(of_all("valve.drive.opening")).max()),
        "force_tracking_rms": float(np.sqrt(np.mean(error**2) / np.mean(demand**2))),
    }


def attitude(solution: Solution) -> FloatArray:
    """Return roll and pitch of the trunk [rad], (2, nt)."""
    w, x, y, z = (solution[f"body.base_q_{axis}"] for axis in "wxyz")
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x**2 + y**2))
    return np.array([roll, np.arcsin(np.clip(2 * (w * y - z * x), -1.0, 1.0))])


def slip_share(solution: Solution, settled: NDArray[np.bool_]) -> float:
    """Return the share of stance in which the contact point slips."""
    normal = solution.values([f"body.sensor_{leg}_touch" for leg in LEGS])[settled]
    loaded = spans(solution.t[settled]) * (normal > LOADED)
    slipping = contact_speeds(solution)[settled] > SLIPPING
    return float((loaded * slipping).sum() / loaded.sum()) if loaded.any() else 0.0


def contact_speeds(solution: Solution) -> FloatArray:
    """Return how fast the lowest point of each foot moves over level ground [m/s], (nt, 4)."""
    kernel = Kernel(kinematics(Dimensions()))
    angles, speeds = (solution.values([f"body.{j}_{x}" for j in JOINT_NAMES]) for x in ("phi", "w"))
    velocity = solution.values([f"body.base_v_{axis}" for axis in "xyz"])
    rate = solution.values([f"body.base_w_{axis}" for axis in "xyz"])
    result = np.empty((solution.t.size, len(LEGS)))
    turns = rotations(solution.values([f"body.base_q_{axis}" for axis in "wxyz"]))
    for k, R in enumerate(turns):
        _, _, contact, jacobian, _ = kernel(angles[k], speeds[k], R[2].copy())
        for i in range(len(LEGS)):
            mine = slice(3 * i, 3 * i + 3)
            J = jacobian[9 * i : 9 * i + 9].reshape(3, 3, order="F")
            v = velocity[k] + R @ (np.cross(rate[k], contact[mine]) + J @ speeds[k, mine])
            result[k, i] = hypot(v[0], v[1])
    return result


def headings(solution: Solution) -> FloatArray:
    """Return the trunk's velocity ahead and to the left in a level frame of its heading [m/s], (nt, 2)."""
    forward = rotations(solution.values([f"body.base_q_{axis}" for axis in "wxyz"]))[:, :2, 0]
    c, s = (forward / np.linalg.norm(forward, axis=1, keepdims=True)).T
    x, y = solution["body.base_v_x"], solution["body.base_v_y"]
    return np.column_stack([c * x + s * y, c * y - s * x])


def rotations(quaternions: FloatArray) -> FloatArray:
    """Return the matrices (nt, 3, 3) from the trunk to the world."""
    w, x, y, z = (quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)).T
    rows = [
        [1 - 2 * (y**2 + z**2), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x**2 + z**2), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x**2 + y**2)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def tracking(solution: Solution, settled: NDArray[np.bool_]) -> float | None:
    """Return the rms error of all forces over the rms of the demand; None where nothing was asked for."""
    error, demand = (
        solution.values(solution.select(f"actuators[*].{name}"))[settled] for name in ("control.e", "F_d")
    )
    span = spans(solution.t[settled])
    asked = np.sum(span * demand**2)
    return float(np.sqrt(np.sum(span * error**2) / asked)) if asked else None


def spans(t: FloatArray) -> FloatArray:
    """Return the time that each row stands for (nt, 1) [s]: rows are dense where events are."""
    between = np.diff(t) / 2
    return (np.append(between, 0.0) + np.insert(between, 0, 0.0))[:, None]
