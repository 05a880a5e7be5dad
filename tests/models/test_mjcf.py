"""The quadruped's rigid bodies, as MuJoCo understands them."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
import pytest

from arthur_acausal import UsageError
from arthur_acausal.models.arthur.dimensions import JOINT_NAMES, LEGS, Dimensions, front_of, side_of
from arthur_acausal.models.arthur.mjcf import Terrain, quadruped_mjcf

ROBOT = Dimensions()
GRAVITY = 9.81


def loaded(**options: Any) -> tuple[Any, Any]:
    """Return model and data in the standing pose."""
    model = mujoco.MjModel.from_xml_string(quadruped_mjcf(**options))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("stand").id)
    mujoco.mj_forward(model, data)
    return model, data


def held(model: Any, data: Any, seconds: float) -> None:
    """Let the robot settle, each joint held by a spring and a damper."""
    model.opt.timestep = 5e-4
    pose = data.qpos[7:].copy()
    for _ in range(round(seconds / model.opt.timestep)):
        data.qfrc_applied[6:] = 400 * (pose - data.qpos[7:]) - 4 * data.qvel[6:]
        mujoco.mj_step(model, data)


@pytest.mark.parametrize("payload", [0.0, 2.0])
def test_masses(payload: float) -> None:
    model, _ = loaded(payload=payload)
    assert model.body("trunk").subtreemass[0] == pytest.approx(9.88 + payload)
    assert ROBOT.mass == pytest.approx(9.88)


def test_inertia_of_the_whole_standing() -> None:
    """About its centre of mass the robot has the published inertia of a 10 kg quadruped, within 2 %."""
    model, data = loaded()
    mass = np.zeros((model.nv, model.nv))
    for column, unit in zip(mass, np.eye(model.nv), strict=True):
        mujoco.mj_mulM(model, data, column, unit)
    r = data.subtree_com[1] - data.qpos[:3]
    inertia = mass[3:6, 3:6] - ROBOT.mass * (r @ r * np.eye(3) - np.outer(r, r))
    assert np.diag(inertia) == pytest.approx([0.0755, 0.207, 0.237], rel=0.02)


def test_stands_with_its_feet_on_the_ground() -> None:
    _, data = loaded()
    for leg in LEGS:
        hip = [front_of(leg) * ROBOT.hip_x, side_of(leg) * (ROBOT.hip_y + ROBOT.offset)]
        assert data.geom(f"{leg}_foot").xpos == pytest.approx([*hip, ROBOT.foot_radius], abs=1e-12)
    assert data.qpos[2] == 0.25


def test_feet_carry_the_weight_and_sink_in_a_little() -> None:
    model, data = loaded()
    held(model, data, 1.0)
    touch = [data.sensor(f"{leg}_touch").data[0] for leg in LEGS]
    assert sum(touch) == pytest.approx(ROBOT.mass * GRAVITY, rel=1e-3)
    assert data.ncon == 4
    depth = [-contact.dist for contact in data.contact]
    assert 0 < min(depth) <= max(depth) < 3e-3
    assert data.sensor("accelerometer").data == pytest.approx([0, 0, GRAVITY], abs=0.02)


def test_order_of_the_joints() -> None:
    model, _ = loaded()
    assert tuple(model.joint(i + 1).name for i in range(12)) == JOINT_NAMES
    assert model.dof_armature[6:] == pytest.approx(np.full(12, 6e-5))


def test_a_contact_begins_smoothly() -> None:
    """The force of a foot that sinks in at 0.5 m/s grows with the square of the depth, from less than 10 mN."""
    model, data = loaded()
    forces = []
    for depth in (-1e-4, 1e-6, 1e-4, 2e-4):
        data.qpos[2] = ROBOT.stand_height - depth
        data.qvel[2] = -0.5
        mujoco.mj_forward(model, data)
        forces.append(data.sensor("FL_touch").data[0])
    assert forces[0] == 0.0
    assert forces[1] < 0.01  # MuJoCo's least impedance is 1e-4
    assert forces[3] / forces[2] == pytest.approx(4.0, rel=0.15)


def test_step_and_slope() -> None:
    for terrain, height in (("step", 0.03), (Terrain(slope=0.1, start=0.3), 0.7 * np.tan(0.1))):
        model, data = loaded(terrain=terrain)
        hit = np.zeros(1, np.int32)
        start = np.array([1.0, 0.0, 1.0])
        group = np.ones(6, np.uint8)
        depth = mujoco.mj_ray(model, data, start, np.array([0, 0, -1.0]), group, 1, -1, hit)
        assert 1.0 - depth == pytest.approx(height, abs=1e-9)


def test_an_unknown_terrain_is_refused() -> None:
    with pytest.raises(UsageError, match="terrain 'hill'"):
        quadruped_mjcf(terrain="hill")  # type: ignore[arg-type]
