"""Kinematics and dynamics of the legs against MuJoCo, whose model is written from the same dimensions."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from arthur_acausal.models.arthur.dimensions import LEGS, Dimensions
from arthur_acausal.models.arthur.locomotion.kernel import Kernel
from arthur_acausal.models.arthur.locomotion.leg_model import dynamics, inverse_kinematics, kinematics
from arthur_acausal.models.arthur.mjcf import quadruped_mjcf

ROBOT = Dimensions()


@pytest.fixture(scope="module")
def posed() -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The robot high in the air, tilted, its joints moving and its trunk at rest."""
    model = mujoco.MjModel.from_xml_string(quadruped_mjcf())
    data = mujoco.MjData(model)
    random = np.random.default_rng(3)
    data.qpos[:3] = 0.1, -0.2, 2.0
    data.qpos[3:7] = [0.95, 0.1, -0.2, 0.21]
    data.qpos[3:7] /= np.linalg.norm(data.qpos[3:7])
    data.qpos[7:] = np.tile(ROBOT.stand, 4) + random.uniform(-0.3, 0.3, 12)
    data.qvel[6:] = random.uniform(-5.0, 5.0, 12)
    mujoco.mj_forward(model, data)
    return model, data


def test_positions_velocities_and_centre_of_mass(posed: tuple[mujoco.MjModel, mujoco.MjData]) -> None:
    model, data = posed
    R = data.body("trunk").xmat.reshape(3, 3)
    kernel = Kernel(kinematics(ROBOT))
    foot, velocity, contact, jacobian, centre = kernel(data.qpos[7:], data.qvel[6:], R[2])
    origin = data.qpos[:3]
    assert origin + R @ centre == pytest.approx(data.subtree_com[1], abs=1e-12)
    for i, leg in enumerate(LEGS):
        mine = slice(3 * i, 3 * i + 3)
        place = data.site(f"{leg}_foot").xpos
        assert origin + R @ foot[mine] == pytest.approx(place, abs=1e-12)
        lowest = place - [0, 0, ROBOT.foot_radius]
        assert origin + R @ contact[mine] == pytest.approx(lowest, abs=1e-12)
        J = np.zeros((3, model.nv))
        mujoco.mj_jac(model, data, J, None, lowest, model.body(f"{leg}_calf").id)
        mine_jacobian = jacobian[9 * i : 9 * i + 9].reshape(3, 3, order="F")
        assert R @ mine_jacobian == pytest.approx(J[:, 6 + 3 * i : 9 + 3 * i], abs=1e-12)
        mujoco.mj_jac(model, data, J, None, place, model.body(f"{leg}_calf").id)
        assert R @ velocity[mine] == pytest.approx(J @ data.qvel, abs=1e-12)


def test_torques_give_the_feet_their_accelerations(posed: tuple[mujoco.MjModel, mujoco.MjData]) -> None:
    """Inverse dynamics through the whole mass matrix of MuJoCo, with the trunk's acceleration held at zero."""
    model, data = posed
    R = data.body("trunk").xmat.reshape(3, 3)
    wanted = np.random.default_rng(4).uniform(-20.0, 20.0, 12)
    kernel = Kernel(dynamics(ROBOT))
    load, swing = kernel(data.qpos[7:], data.qvel[6:], R.T @ model.opt.gravity, wanted)
    assert load == pytest.approx(data.qfrc_bias[6:], abs=1e-10)
    M = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, M)
    rates = np.linalg.solve(M[6:, 6:], swing - data.qfrc_bias[6:])
    for i, leg in enumerate(LEGS):
        J, change = np.zeros((3, model.nv)), np.zeros((3, model.nv))
        body = model.body(f"{leg}_calf").id
        mujoco.mj_jac(model, data, J, None, data.site(f"{leg}_foot").xpos, body)
        mujoco.mj_jacDot(model, data, change, None, data.site(f"{leg}_foot").xpos, body)
        found = R.T @ (J[:, 6:] @ rates + change @ data.qvel)
        assert found == pytest.approx(wanted[3 * i : 3 * i + 3], abs=1e-9)


def test_inverse_kinematics_inverts_kinematics(posed: tuple[mujoco.MjModel, mujoco.MjData]) -> None:
    _, data = posed
    foot, velocity, *_ = Kernel(kinematics(ROBOT))(data.qpos[7:], data.qvel[6:], np.array([0.0, 0.0, 1.0]))
    q, rate = Kernel(inverse_kinematics(ROBOT, 2))(np.tile(foot, 2), np.tile(velocity, 2))
    assert q == pytest.approx(np.tile(data.qpos[7:], 2), abs=1e-12)
    assert rate == pytest.approx(np.tile(data.qvel[6:], 2), abs=1e-10)


def test_a_foot_out_of_reach_is_pointed_at() -> None:
    far = np.array([0.17, 0.11, -1, 0.17, -0.11, -1, -0.17, 0.11, -1, -0.17, -0.11, -1])
    q, rate = Kernel(inverse_kinematics(ROBOT, 1))(far, np.ones(12))
    assert np.isfinite(rate).all()
    foot = Kernel(kinematics(ROBOT))(q, rate, np.array([0.0, 0.0, 1.0]))[0].reshape(4, 3)
    assert foot[:, 2] == pytest.approx(-0.98 * 0.32, abs=1e-12)


def test_a_displaced_robot_stands_on_feet_of_one_height() -> None:
    model = mujoco.MjModel.from_xml_string(quadruped_mjcf())
    data = mujoco.MjData(model)
    shifts = np.random.default_rng(5).uniform(-0.05, 0.05, 8)
    angles = np.array(ROBOT.standing(shifts.tolist()))
    data.qpos[7:] = angles
    data.qpos[2] = ROBOT.stand_height
    mujoco.mj_forward(model, data)
    heights = [data.site(f"{leg}_foot").xpos[2] for leg in LEGS]
    assert heights == pytest.approx([ROBOT.foot_radius] * 4, abs=1e-12)
    assert angles.reshape(4, 3)[:, :2] == pytest.approx(ROBOT.stand[:2] + shifts.reshape(4, 2), abs=1e-15)
    assert ROBOT.standing([0.0] * 8) == pytest.approx(ROBOT.stand * 4, abs=1e-12)
