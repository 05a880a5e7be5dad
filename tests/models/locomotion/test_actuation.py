"""Torques, forces and flow through the linkages."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from arthur_acausal.models.arthur.dimensions import Dimensions
from arthur_acausal.models.arthur.linkages import all_triangles
from arthur_acausal.models.arthur.locomotion.actuation import Cylinders, actuator_forces, limited, moment_arms
from arthur_acausal.models.arthur.locomotion.flow import (
    compression_flow,
    piston_forces,
    predicted_flow,
    required_pressure,
)
from arthur_acausal.models.arthur.locomotion.kernel import Kernel
from arthur_acausal.models.arthur.locomotion.leg_model import kinematics

ANGLES = np.tile(Dimensions().stand, 4) + np.linspace(-0.2, 0.2, 12)


def test_power_is_conserved() -> None:
    random = np.random.default_rng(1)
    torques, rates, h = random.normal(size=12), random.normal(size=12), 1e-5
    triangles = all_triangles()
    speeds = (triangles.length(ANGLES + h * rates) - triangles.length(ANGLES - h * rates)) / (2 * h)
    assert actuator_forces(torques, ANGLES) * speeds == pytest.approx(torques * rates, rel=1e-6)


def able(torques: np.ndarray) -> np.ndarray:
    """The torques that the cylinders can give."""
    arms = moment_arms(ANGLES)
    return np.array(ca.evalf(limited(ca.SX(torques), ca.SX(arms), Cylinders()))).ravel()


def test_cylinders_push_harder_than_they_pull() -> None:
    cylinders = Cylinders()
    assert (cylinders.push, cylinders.pull) == pytest.approx((948.0, 711.0), abs=1.0)
    for sign in (1.0, -1.0):
        forces = actuator_forces(able(np.full(12, sign * 1e3)), ANGLES)
        extended = forces > 0
        assert forces[extended] == pytest.approx(cylinders.push)
        assert forces[~extended] == pytest.approx(-cylinders.pull)
    small = np.full(12, 0.1)
    assert able(small) == pytest.approx(small)


def test_flow_is_the_volume_swept_on_the_side_that_is_fed() -> None:
    """One hip turns through its range and back; the volumes follow from its cylinder's length alone."""
    cylinders = Cylinders(leakage=1e-6)
    t = np.linspace(0.0, 1.0, 2001)
    angles, rates = np.tile(ANGLES, (len(t), 1)), np.zeros((len(t), 12))
    angles[:, 1] = 0.8 - 0.4 * np.cos(2 * np.pi * t)
    rates[:, 1] = 0.8 * np.pi * np.sin(2 * np.pi * t)
    volume = np.trapezoid(predicted_flow(angles, rates, cylinders), t)
    lengths = all_triangles().length(angles[[0, 1000]])[:, 1]
    stroke = lengths[1] - lengths[0]
    assert volume == pytest.approx((cylinders.A_A + cylinders.A_B) * stroke + 1e-6, rel=1e-6)


def test_planned_forces_do_the_work_of_the_ground() -> None:
    """Whatever the legs do: pistons and ground give the same power, with opposite signs."""
    random = np.random.default_rng(2)
    R = np.linalg.qr(random.normal(size=(3, 3)))[0]
    rates, ground = random.normal(size=12), random.normal(size=(1, 4, 3))
    _, _, _, jacobian, _ = Kernel(kinematics(Dimensions()))(ANGLES, rates, R[2])
    J = np.array([jacobian[9 * i : 9 * i + 9].reshape(3, 3, order="F") for i in range(4)])
    forces = piston_forces(ground, J[None], R, ANGLES[None])[0]
    feet = np.array([R @ J[i] @ rates[3 * i : 3 * i + 3] for i in range(4)])
    assert forces @ (moment_arms(ANGLES) * rates) == pytest.approx(-np.sum(ground[0] * feet))


def test_a_jump_of_the_force_fills_a_chamber() -> None:
    """100 N more on a piston at rest: p_A rises and p_B falls alike, and chamber A takes beta^-1 V dp."""
    c, h = Cylinders(), 0.03
    forces = np.zeros((5, 12))
    forces[2:, 4] = 100.0
    volume = compression_flow(forces, h, c).sum() * h
    rise = 100.0 / (c.A_A + c.A_B)
    assert rise * c.A_A + rise * c.A_B == pytest.approx(100.0)
    assert volume == pytest.approx(c.V_A * rise / c.beta)
    assert compression_flow(-forces, h, c).sum() * h == pytest.approx(c.V_B * rise / c.beta)
    assert compression_flow(forces, h, c)[[0, 1, 3, 4]] == pytest.approx(np.zeros(4))


@pytest.mark.parametrize(("force", "speed"), [(400.0, 0.1), (400.0, -0.1), (-300.0, 0.15), (250.0, 0.0)])
def test_with_the_required_pressure_a_piston_gives_its_force(force: float, speed: float) -> None:
    """A valve fully open passes q = q_rated sqrt(dp/35 bar) a land: its chambers then bear the force, and no more."""
    c, forces, rates = Cylinders(), np.zeros(12), np.zeros(12)
    forces[4], rates[4] = force, speed / moment_arms(ANGLES)[4]
    p_s = float(required_pressure(forces, ANGLES, rates, c))
    drop_A, drop_B = (35e5 * (A * speed / (2e-3 / 60)) ** 2 for A in (c.A_A, c.A_B))
    p_A, p_B = (p_s - drop_A, 3e5 + drop_B) if speed > 0 else (3e5 + drop_A, p_s - drop_B)
    given = p_A * c.A_A - p_B * c.A_B
    if speed == 0.0:
        assert p_s == pytest.approx(
            force / 0.95 / c.A_A + 3e5
        )  # as the valve holds it, chamber B at the return
    elif force * speed > 0:
        assert given == pytest.approx(force / 0.95)
    else:
        assert given * np.sign(speed) > force * np.sign(speed)  # braking, the other chamber's land does it
