"""Torques, forces and flow through the linkages."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from arthur_acausal.models.arthur.dimensions import Dimensions
from arthur_acausal.models.arthur.linkages import all_triangles
from arthur_acausal.models.arthur.locomotion.actuation import Cylinders, actuator_forces, limited, moment_arms
from arthur_acausal.models.arthur.locomotion.flow import predicted_flow

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
