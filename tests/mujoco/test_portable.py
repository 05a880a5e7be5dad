"""Models with a MuJoCo body travel to other processes as bytes, and are swept."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from arthur_acausal import Component, Equations, SolverOptions, Translation, connect, translate
from arthur_acausal.codegen.cache import Cache
from arthur_acausal.codegen.portable import from_bytes
from arthur_acausal.components.rotational import Inertia
from arthur_acausal.models.arthur.quadruped import Quadruped
from arthur_acausal.mujoco import MujocoBody
from arthur_acausal.result.simulated import run
from arthur_acausal.sweep import sweep
from tests.mujoco.models import PENDULUM


class Clock(Component):
    """A pendulum with a wheel on its shaft."""

    body = MujocoBody(mjcf=PENDULUM, hinge_phi=0.05)
    wheel: Inertia = Inertia(J=0.1)

    def equations(self) -> Equations:
        yield connect(self.body.hinge, self.wheel.flange_a)


def same_bits(translation: Translation, stop_time: float, options: SolverOptions, cache: Path) -> None:
    copy = from_bytes(translation.to_bytes(), Cache(cache))
    here = translation.simulate(stop_time, options=options)
    there = run(
        copy,
        None,
        stop_time=stop_time,
        start_time=0.0,
        options=options,
        parameters=None,
        inputs=None,
        start=None,
        progress=None,
    )
    assert here.paths == there.paths
    np.testing.assert_array_equal(here.t, there.t)
    np.testing.assert_array_equal(here.values(here.paths), there.values(there.paths))


def test_a_body_gives_the_same_bits_elsewhere(tmp_path: Path) -> None:
    same_bits(translate(Clock()), 1.0, SolverOptions(), tmp_path)


def test_the_walking_robot_gives_the_same_bits_elsewhere(tmp_path: Path) -> None:
    """Its controller with the noise of its sensors, and MuJoCo's bodies on the ground."""
    robot = translate(Quadruped(gait="trot", v_x=0.5, seed=3))
    same_bits(robot, 0.02, SolverOptions(rtol=1e-4, intervals=10), tmp_path)


def test_a_sweep_of_a_body(tmp_path: Path) -> None:
    """The pendulum's slow swing T = 2 pi sqrt((J + I) / (m g l)), from its first passage of the vertical."""
    found = sweep(
        Clock,
        vary={"wheel.J": [0.1, 0.2, 0.4, 0.8]},
        stop_time=2.0,
        tolerance=1e-8,
        folder=tmp_path / "sweep",
        workers=2,
        progress=False,
        output={"variables": ["body.hinge_phi"], "reductions": ["first(body.hinge_phi < 0)"]},
    )
    table = found.table
    assert list(table["status"]) == ["ok"] * 4
    inertia = table["wheel.J"].to_numpy(float) + 2 / 5 * 2 * 0.05**2 + 2 * 0.25
    quarter = 2 * np.pi * np.sqrt(inertia / (2 * 9.81 * 0.5)) / 4 * (1 + 0.05**2 / 16)  # the swing is small
    assert table["first(body.hinge_phi < 0)"].to_numpy() == pytest.approx(quarter, rel=1e-4)
