"""Foot placement, the trunk's, the stance legs' and the swing legs' trajectories."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import casadi as ca
import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from arthur_acausal.models.arthur.dimensions import Dimensions
from arthur_acausal.models.arthur.locomotion.base_trajectory import BaseReference
from arthur_acausal.models.arthur.locomotion.commands import Command
from arthur_acausal.models.arthur.locomotion.estimation import Estimate
from arthur_acausal.models.arthur.locomotion.foot_placement import foot_placement, hips
from arthur_acausal.models.arthur.locomotion.kernel import Kernel
from arthur_acausal.models.arthur.locomotion.rotation import about_z, cross, euler_of, matrix_of, wrapped
from arthur_acausal.models.arthur.locomotion.settings import Settings
from arthur_acausal.models.arthur.locomotion.stance_trajectory import FootPlan, foot_plan, stance_vectors
from arthur_acausal.models.arthur.locomotion.swing_trajectory import (
    MATCHED,
    spline_coefficients,
    swing_trajectory,
)

STANDING: dict[str, Any] = {name: np.zeros(3) for name in ("velocity", "rate", "rate_B", "centre")}
FEET = hips(Dimensions(), 0.0) - [0.0, 0.0, 0.25]


def moved(x: float, y: float = 0.0, z: float = 0.0) -> np.ndarray:
    """The standing feet, all moved by this."""
    shifted: np.ndarray = FEET + np.array([x, y, z])
    return shifted


def estimate(**changes: Any) -> Estimate:
    """A robot that stands at the origin, its heading along x."""
    still = Estimate(
        R=np.eye(3),
        roll=0.0,
        pitch=0.0,
        yaw=0.0,
        position=np.array([0.0, 0.0, 0.25]),
        angles=np.zeros(12),
        speeds=np.zeros(12),
        contact=np.ones(4, dtype=bool),
        foot=moved(0.0, 0.0, 0.02),
        foot_velocity=np.zeros((4, 3)),
        point=FEET,
        **STANDING,
    )
    return replace(still, **changes)


def test_rotations() -> None:
    random = np.random.default_rng(1)
    for _ in range(20):
        roll, pitch, yaw = random.uniform(-1.4, 1.4, 3)
        half = np.array([roll, pitch, yaw]) / 2
        (cr, cp, cy), (sr, sp, sy) = np.cos(half), np.sin(half)
        q = [cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy]
        q += [cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy]
        R = matrix_of(3.0 * np.array(q))
        assert R @ R.T == pytest.approx(np.eye(3), abs=1e-14)
        assert euler_of(R) == pytest.approx((roll, pitch, yaw), abs=1e-12)
    a, b = random.normal(size=3), random.normal(size=(4, 3))
    assert cross(a, b) == pytest.approx(np.cross(a, b), abs=1e-15)
    assert wrapped(7.0) == pytest.approx(7.0 - 2 * np.pi)


def test_feet_are_placed_half_a_stance_ahead() -> None:
    hip, v = hips(Dimensions(), 0.0), np.array([0.4, 0.1, 0.0])
    still = foot_placement(hip, np.zeros(3), np.zeros(3), 0.0, 0.4, 0.1)
    assert still == pytest.approx(hip)
    assert hip[0] == pytest.approx([0.17, 0.11, 0.0])
    moving = foot_placement(hip, v, v, 0.0, 0.4, 0.1)
    assert moving - hip == pytest.approx(np.tile(v * 0.2, (4, 1)))
    pushed = foot_placement(hip, v + np.array([0.0, 0.5, 0.0]), v, 0.0, 0.4, 0.1)
    assert pushed - moving == pytest.approx(np.tile([0.0, 0.05, 0.0], (4, 1)))


def test_feet_of_a_turn_are_placed_on_the_circle_ahead() -> None:
    hip = hips(Dimensions(), 0.0)
    ahead = foot_placement(hip, np.zeros(3), np.zeros(3), 0.5, 0.4, 0.1) - hip
    assert np.sum(ahead * hip, axis=1) == pytest.approx(0.0, abs=1e-15)
    assert np.linalg.norm(ahead, axis=1) == pytest.approx(0.5 * 0.2 * np.linalg.norm(hip, axis=1))


def test_a_twist_is_followed_along_an_arc() -> None:
    settings = Settings(acceleration=1e6)
    reference = BaseReference(settings)
    reference.update(Command(v_x=0.5, yaw_rate=1.0), estimate(), walking=True)
    wanted = reference.trajectory()
    t = settings.step * np.arange(1, 11) + settings.period
    assert wanted.pose[:, 2] == pytest.approx(t)
    radius = 0.5
    assert wanted.pose[:, 3] == pytest.approx(radius * np.sin(t), abs=3e-3)
    assert wanted.pose[:, 4] == pytest.approx(radius * (1 - np.cos(t)), abs=3e-3)
    assert wanted.twist[:, 3:5] == pytest.approx(0.5 * np.array([np.cos(t), np.sin(t)]).T)
    assert not wanted.pose[:, :2].any() and (wanted.pose[:, 5] == 0.25).all()


def test_the_reference_does_not_run_away_from_a_robot_that_is_held() -> None:
    settings = Settings()
    reference = BaseReference(settings)
    for _ in range(2000):
        reference.update(Command(v_x=0.5, yaw_rate=0.5), estimate(), walking=True)
    assert reference.velocity == pytest.approx([0.5, 0.0, 0.0])
    pose = reference.trajectory().pose[0]
    assert (
        pose[2] <= settings.yaw_reach + settings.step and pose[3] <= settings.position_reach + settings.step
    )


def test_a_standing_robot_is_kept_over_its_feet() -> None:
    reference = BaseReference(Settings())
    shifted = estimate(position=np.array([1.0, 2.0, 0.25]), point=moved(0.02, -0.01, 0.0))
    reference.update(Command(v_x=0.5), shifted, walking=False)
    assert reference.trajectory().pose[-1, 3:] == pytest.approx([1.02, 1.99, 0.25])


def test_splines_are_cubic_hermite() -> None:
    numbers = [0.3, -0.2, 1.5, 0.7]
    c = np.array(ca.evalf(spline_coefficients(ca.SX(0.3), ca.SX(-0.2), ca.SX(1.5), ca.SX(0.7), 0.5))).ravel()
    same = CubicHermiteSpline([0.0, 0.5], numbers[:2], numbers[2:])
    x = np.linspace(0.0, 0.5, 7)
    assert np.polyval(c, x) == pytest.approx(same(x), abs=1e-13)


def swing(S: float) -> tuple[np.ndarray, ...]:
    """The first foot's position, velocity, acceleration in a swing of 0.25 s."""
    start, end = np.tile([0.1, 0.1, -0.23], 4), np.tile([0.25, 0.12, -0.22], 4)
    v_0, v_1 = np.tile([-0.5, 0.0, 0.0], 4), np.tile([-0.4, 0.05, -0.1], 4)
    kernel = Kernel(swing_trajectory())
    found = kernel(np.full(4, S), np.full(4, 0.25), start, v_0, end, v_1, np.full(4, 0.05))
    return tuple(part.reshape(4, 3)[0].copy() for part in found)


def test_a_swing_begins_and_ends_as_asked() -> None:
    p, v, _ = swing(0.0)
    assert p == pytest.approx([0.1, 0.1, -0.23]) and v == pytest.approx([-0.5, 0.0, 0.0])
    p, v, _ = swing(0.5)
    assert p[2] == pytest.approx(-0.18) and v[2] == pytest.approx(0.0, abs=1e-12)
    p, v, _ = swing(1.0 - 1e-12)
    assert p == pytest.approx([0.25, 0.12, -0.22]) and v == pytest.approx([-0.4, 0.05, -0.1])


@pytest.mark.parametrize("S", [MATCHED + 1e-9, 0.95, 1.0 - 1e-9])
def test_a_foot_that_lands_early_does_not_slide(S: float) -> None:
    """It has the ground's velocity already, on the way to the place where it shall land."""
    p, v, _ = swing(S)
    assert v[:2] == pytest.approx([-0.4, 0.05])
    assert p[:2] == pytest.approx(np.array([0.25, 0.12]) - 0.25 * (1.0 - S) * np.array([-0.4, 0.05]))
    assert swing(MATCHED - 1e-9)[1] == pytest.approx(swing(MATCHED)[1], abs=1e-6)


def test_a_late_foot_goes_on_downward() -> None:
    p, v, a = swing(1.2)
    assert p == pytest.approx([0.25, 0.12, -0.22] + 0.05 * np.array([-0.4, 0.05, -0.1]))
    assert v == pytest.approx([-0.4, 0.05, -0.1]) and a == pytest.approx(0.0)


@pytest.mark.parametrize("S", [0.2, 0.7])
def test_velocity_and_acceleration_are_derivatives(S: float) -> None:
    h = 1e-4
    before, here, after = swing(S - h / 0.25), swing(S), swing(S + h / 0.25)
    assert here[1] == pytest.approx((after[0] - before[0]) / (2 * h), abs=1e-5)
    assert here[2] == pytest.approx((after[1] - before[1]) / (2 * h), abs=1e-4)


STEPS, H = 10, 0.03


def plan(swinging: float, remaining: float, v: tuple[float, float, float]) -> FootPlan:
    """Plan feet with T_st = 0.2 s, T_sw = 0.15 s for a trunk that moves with v."""
    start, end, after = FEET, moved(0.03), moved(0.05)
    phase = np.tile([remaining, 0.2, 0.15, 1.0 - remaining / 0.15 if swinging else 0.0], 4)
    touch = np.tile([-v[0], -v[1], -v[2] - 0.1], 4)
    found = Kernel(foot_plan(STEPS, H))(
        phase,
        np.full(4, swinging),
        start.ravel(),
        np.tile(np.negative(v), 4),
        end.ravel(),
        touch,
        np.full(4, 0.05),
        after.ravel(),
        np.tile(v, 4),
        np.zeros(12),
    )
    foot, velocity = (x.reshape(4, STEPS + 1, 3).transpose(1, 0, 2) for x in found[:2])
    return FootPlan(foot, velocity, found[2].reshape(4, STEPS).T > 0.5)


def test_a_planned_stance_foot_stays_on_the_ground() -> None:
    v = (0.5, 0.1, 0.0)
    planned = plan(0.0, 0.1, v)
    t = H * np.arange(STEPS + 1)
    world = planned.foot + t[:, None, None] * np.array(v)
    for k in range(4):  # until 0.1 s
        assert world[k] == pytest.approx(FEET)
    assert planned.foot[-2:, :, 0] + 0.5 * (t[-2:] - 0.25)[:, None] == pytest.approx(
        np.tile(FEET[:, 0] + 0.05, (2, 1))
    )
    assert planned.stance[:, 0].tolist() == [True] * 3 + [False] * 5 + [True] * 2
    assert planned.foot[5, 0, 2] > FEET[0, 2] + 0.02


def test_a_planned_swing_lands_stands_and_lifts_again() -> None:
    planned = plan(1.0, 0.06, (0.5, 0.0, 0.0))
    assert planned.stance[:, 0].tolist() == [False] * 2 + [True] * 7 + [False]
    assert planned.foot[2] == pytest.approx(moved(0.03))
    assert planned.foot[8] == pytest.approx(moved(0.03 - 0.5 * 0.18))


def test_planned_velocities_are_derivatives() -> None:
    """Of a cubic, the velocity in the middle follows from the ends exactly: 3/2 dp/dt - (v_0 + v_1) / 4."""
    planned = plan(0.0, 0.1, (0.5, 0.1, 0.0))
    p, v = planned.foot, planned.velocity
    for middle, axes in (
        (1, [0, 1, 2]),
        (5, [0, 1]),
        (7, [2]),
    ):  # in stance, in swing x and y, in the second half of the swing z
        before, after = middle - 1, middle + 1
        expected = 1.5 * (p[after] - p[before]) / (2 * H) - (v[after] + v[before]) / 4
        assert v[middle][:, axes] == pytest.approx(expected[:, axes], abs=1e-12)


def test_stance_vectors_point_from_the_centre_of_mass_in_the_world() -> None:
    planned = plan(0.0, 0.3, (0.0, 0.0, 0.0))
    R, centre = about_z(0.3), np.array([0.01, 0.0, -0.02])
    times: np.ndarray = H * np.arange(float(STEPS))
    arms = stance_vectors(planned, R, 0.5, centre, 0.02, times)
    assert arms[0] == pytest.approx(FEET @ R.T - centre - [0.0, 0.0, 0.02])
    assert arms[4] == pytest.approx(FEET @ about_z(0.3 + 0.5 * times[4]).T - centre - [0.0, 0.0, 0.02])
