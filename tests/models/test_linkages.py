"""The quadruped's linkages: range, stroke, moment arms, and which way standing pushes."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from arthur_acausal.models.arthur.dimensions import JOINT_NAMES, JOINTS
from arthur_acausal.models.arthur.linkages import LINKAGES, all_triangles, middle_lengths
from arthur_acausal.models.arthur.mjcf import quadruped_mjcf


@pytest.mark.parametrize("joint", JOINTS)
def test_the_range_fits_the_stroke(joint: str) -> None:
    linkage = LINKAGES[joint]
    triangle = linkage.triangle()
    ends = np.array([triangle.length(linkage.low), triangle.length(linkage.high)])
    assert linkage.stroke - 0.6e-3 < ends[1] - ends[0] < linkage.stroke
    arms = triangle.arm(np.linspace(linkage.low, linkage.high, 50))
    assert 0.014 < arms.min() < arms.max() < 0.0265


def test_twelve_at_once() -> None:
    triangles, angles = all_triangles(), np.tile([0.1, 0.7, -1.5, -0.1, 0.7, -1.5], 2)
    y = triangles.length(angles) - middle_lengths()
    assert y[0] == pytest.approx(y[3], abs=1e-15)  # mirrored: both feet outward
    assert y[1] == y[4] == y[7] == y[10]
    assert np.abs(y).max() < 0.018
    assert triangles.angle(y + middle_lengths()) == pytest.approx(angles, abs=1e-12)


def test_standing_pushes() -> None:
    """Weight on the feet: cylinders of knees and abduction push; by the feet's Jacobians of MuJoCo."""
    model = mujoco.MjModel.from_xml_string(quadruped_mjcf())
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    torque = np.zeros(model.nv)
    for leg in ("FL", "FR", "RL", "RR"):
        jacobian = np.zeros((3, model.nv))
        mujoco.mj_jacSite(model, data, jacobian, None, model.site(f"{leg}_foot").id)
        torque -= jacobian.T @ [0.0, 0.0, 24.2]
    force = torque[6:] / all_triangles().arm(data.qpos[7:])
    pushes = dict(zip(JOINT_NAMES, force, strict=True))
    assert pushes["FL_knee"] == pytest.approx(24.2 * 0.115 / 0.0256, rel=0.05)
    assert all(pushes[name] > 40.0 for name in JOINT_NAMES if not name.endswith("hip"))
