"""Torques of standing and swinging legs, in MuJoCo with the trunk held."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from arthur_acausal.models.arthur.dimensions import LEGS, Dimensions
from arthur_acausal.models.arthur.locomotion.actuation import Cylinders
from arthur_acausal.models.arthur.locomotion.foot_placement import hips
from arthur_acausal.models.arthur.locomotion.kernel import Kernel
from arthur_acausal.models.arthur.locomotion.leg_torques import leg_torques
from arthur_acausal.models.arthur.locomotion.settings import Settings
from arthur_acausal.models.arthur.mjcf import quadruped_mjcf

ROBOT = Dimensions()
NONE = np.zeros(12)


def test_standing_torques_balance_gravity_and_the_feet() -> None:
    """In MuJoCo's statics: bias = torques + J^T f, for the joints of all legs."""
    model = mujoco.MjModel.from_xml_string(quadruped_mjcf())
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    data.qpos[2] = 2.0
    data.qpos[3:7] = 0.99, 0.08, -0.05, 0.1
    data.qpos[3:7] /= np.linalg.norm(data.qpos[3:7])
    mujoco.mj_forward(model, data)
    R = data.body("trunk").xmat.reshape(3, 3)
    force = np.random.default_rng(1).uniform([-5, -5, 10], [5, 5, 30], (4, 3))
    kernel = Kernel(leg_torques(ROBOT, Cylinders(), Settings()))
    q = data.qpos[7:]
    (torques,) = kernel(np.ones(4), R.T.ravel(), q, NONE, force.ravel(), NONE[:4], 0.25, *[NONE] * 4, 0.05)
    total = data.qfrc_bias[6:] - torques
    for i, leg in enumerate(LEGS):
        lowest = data.site(f"{leg}_foot").xpos - [0, 0, ROBOT.foot_radius]
        J = np.zeros((3, model.nv))
        mujoco.mj_jac(model, data, J, None, lowest, model.body(f"{leg}_calf").id)
        total -= J[:, 6:].T @ force[i]
    assert total == pytest.approx(0.0, abs=1e-10)


def test_a_swinging_foot_follows_its_trajectory() -> None:
    """All four feet swing while the trunk is held, as if of infinite mass: they stay within a tenth of a millimetre."""
    specification = mujoco.MjSpec.from_string(quadruped_mjcf())
    specification.delete(specification.joint("base"))
    specification.delete(specification.key("stand"))
    model = specification.compile()
    assert model.nv == 12
    model.opt.timestep = 5e-4
    data = mujoco.MjData(model)
    data.qpos[:] = np.tile(ROBOT.stand, 4)
    mujoco.mj_forward(model, data)
    trunk = np.array([0.0, 0.0, ROBOT.stand_height])
    start = hips(ROBOT, 0.0) - np.array([0.0, 0.0, ROBOT.stand_height - ROBOT.foot_radius])
    end = start + np.array([0.08, 0.01, 0.0])
    kernel = Kernel(leg_torques(ROBOT, Cylinders(), Settings()))
    paths = (start.ravel(), NONE, end.ravel(), NONE)
    R = np.eye(3).ravel()
    heights = []
    for k in range(500):
        S = np.full(4, k / 500)
        (data.qfrc_applied[:],) = kernel(NONE[:4], R, data.qpos, data.qvel, NONE, S, 0.25, *paths, 0.05)
        mujoco.mj_step(model, data)
        heights.append(data.site("FL_foot").xpos[2] - ROBOT.foot_radius)
    feet = np.array([data.site(f"{leg}_foot").xpos for leg in LEGS]) - trunk
    assert feet == pytest.approx(end, abs=1e-4)
    assert max(heights) == pytest.approx(0.05, abs=2e-4)
