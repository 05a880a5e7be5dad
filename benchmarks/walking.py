"""A quadruped in plain MuJoCo with ideal torques, for the locomotion stack alone: no hydraulics."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from arthur_acausal.models.arthur.dimensions import LEGS
from arthur_acausal.models.arthur.locomotion.controller import Controller
from arthur_acausal.models.arthur.locomotion.rotation import about_z, euler_of

FloatArray = NDArray[np.float64]

STEP = 1e-3
"""Time step of MuJoCo [s]."""
LOADED = 5.0
"""Normal force above which a foot counts as standing [N]."""
SLIDING = 0.05
"""Speed above which a standing foot's contact point counts as slipping [m/s]."""
FALLEN = 0.12
"""Height of the trunk below which the robot has fallen [m]; also if it is tilted by more than 60 degrees."""


@dataclass(frozen=True, slots=True)
class Push:
    """A force at the trunk's centre in the world [N], from ``start`` for ``duration`` [s]."""

    force: tuple[float, float, float] = (0.0, 50.0, 0.0)
    start: float = 3.0
    duration: float = 0.1


@dataclass(slots=True)
class Record:
    """What happened, at each control period.

    Attributes
    ----------
    fell : time of the fall [s], or None. t : [s].
    position, velocity : of the trunk, the velocity in a level frame of its heading (n, 3).
    angles : roll, pitch, yaw (n, 3) [rad]. yaw_rate : [rad/s]. slip, loaded : slipping and standing feet, counted.
    joints, speeds : (n, 12). outputs : of the controller (n, m). torque : applied, mean over the period (n, 12) [N m].
    """

    fell: float | None
    t: FloatArray
    position: FloatArray
    velocity: FloatArray
    angles: FloatArray
    yaw_rate: FloatArray
    slip: FloatArray
    loaded: FloatArray
    joints: FloatArray
    speeds: FloatArray
    outputs: FloatArray
    torque: FloatArray


def start(model: Any, seed: int | None) -> Any:
    """Return the robot standing; with a seed, displaced a little: height, tilt, joints, velocities."""
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    if seed is not None:
        random = np.random.default_rng([seed, 1])
        data.qpos[2] += random.uniform(0.0, 0.005)
        data.qpos[4:7] += random.uniform(-0.01, 0.01, 3)
        data.qpos[7:] += random.uniform(-0.02, 0.02, 12)
        data.qvel[:] += random.uniform(-0.05, 0.05, model.nv)
    mujoco.mj_forward(model, data)
    return data


def read(model: Any, data: Any) -> FloatArray:
    """Return the controller's inputs."""
    return np.concatenate(
        [
            data.qpos[:3],
            data.sensor("orientation").data,
            data.qvel[:3],
            data.sensor("gyro").data,
            data.qpos[7:],
            data.qvel[6:],
            [data.sensor(f"{leg}_touch").data[0] for leg in LEGS],
            data.sensor("accelerometer").data,
        ]
    )


def slipping(model: Any, data: Any, feet: dict[int, int]) -> tuple[int, int]:
    """Return how many feet stand, and how many of these slip."""
    standing = sliding = 0
    force, J = np.zeros(6), np.zeros((3, model.nv))
    for i in range(data.ncon):
        contact = data.contact[i]
        body = feet.get(contact.geom[1], feet.get(contact.geom[0]))
        if body is None:
            continue
        mujoco.mj_contactForce(model, data, i, force)
        if force[0] > LOADED:
            mujoco.mj_jac(model, data, J, None, contact.pos, body)
            normal = contact.frame[:3]
            v = J @ data.qvel
            standing += 1
            sliding += bool(np.linalg.norm(v - normal * (normal @ v)) > SLIDING)
    return standing, sliding


def walk(
    model: Any,
    controller: Controller,
    duration: float,
    push: Push | None = None,
    lag: float = 0.0,
    seed: int | None = None,
) -> Record:
    """Let the robot walk for some time [s]; ``lag`` [s] is the time constant of the torques; it ends at a fall."""
    data = start(model, seed)
    feet = {model.geom(f"{leg}_foot").id: model.body(f"{leg}_calf").id for leg in LEGS}
    torque_at = controller.places["torque"]
    model.opt.timestep = STEP
    substeps = round(controller.configuration.settings.period / STEP)
    share = 1.0 - np.exp(-STEP / lag) if lag > 0.0 else 1.0
    rows: list[tuple[Any, ...]] = []
    torque = np.full(12, np.nan)
    fell = None
    for _ in range(round(duration / STEP / substeps)):
        out = controller(data.time, read(model, data))
        asked = out[torque_at]
        torque = torque if rows else asked.copy()
        state = _state(model, data, feet)
        applied = np.zeros(12)
        for _ in range(substeps):
            torque += share * (asked - torque)
            applied += torque / substeps
            _step(model, data, torque, push)
        rows.append((*state, out, applied))
        if data.qpos[2] < FALLEN or data.body("trunk").xmat[8] < 0.5:
            fell = data.time
            break
    columns: list[Any] = [np.array(column) for column in zip(*rows, strict=True)]
    return Record(fell, *columns)


def _step(model: Any, data: Any, torque: FloatArray, push: Push | None) -> None:
    data.qfrc_applied[6:] = torque
    if push is not None:
        pushed = push.start <= data.time < push.start + push.duration
        data.xfrc_applied[model.body("trunk").id, :3] = push.force if pushed else 0.0
    mujoco.mj_step(model, data)


def _state(model: Any, data: Any, feet: dict[int, int]) -> tuple[Any, ...]:
    """Return what a record keeps of the robot, in the record's order."""
    R = data.body("trunk").xmat.reshape(3, 3)
    angles = euler_of(R)
    level = about_z(angles[2]).T @ data.qvel[:3]
    yaw_rate = float(R[2] @ data.qvel[3:6])
    standing, sliding = slipping(model, data, feet)
    joints, speeds = data.qpos[7:].copy(), data.qvel[6:].copy()
    return data.time, data.qpos[:3].copy(), level, angles, yaw_rate, sliding, standing, joints, speeds
