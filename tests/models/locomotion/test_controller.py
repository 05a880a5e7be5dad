"""The whole stack in plain MuJoCo: short runs. ``python -m benchmarks.locomotion`` has the long ones."""

from __future__ import annotations

from dataclasses import asdict, replace

import numpy as np
import pytest

from arthur_acausal.models.arthur.locomotion.commands import Command, Constant, Table
from arthur_acausal.models.arthur.locomotion.controller import Configuration, Controller
from arthur_acausal.models.arthur.mjcf import quadruped_mjcf
from benchmarks.locomotion import SCENARIOS, meets, run, worst
from benchmarks.walking import Record, walk

MASS = 9.88


def record(
    command: Command, duration: float, seed: int | None = 1, true_velocity: bool = False
) -> tuple[Controller, Record]:
    """Let the robot walk on flat ground."""
    import mujoco

    model = mujoco.MjModel.from_xml_string(quadruped_mjcf())
    controller = Controller(Configuration(Constant(command), seed=seed, true_velocity=true_velocity))
    return controller, walk(model, controller, duration, seed=seed)


@pytest.mark.parametrize(
    ("name", "duration"),
    [("stand", 1.6), ("trot 0.5", 3.0), ("walk", 3.0), ("pace", 2.5), ("turn", 2.5), ("lag 3 ms", 2.5)],
)
def test_gaits(name: str, duration: float) -> None:
    scenario = next(s for s in SCENARIOS if name in s.name)
    figures = run(replace(scenario, duration=duration), seed=3)
    assert meets(worst([figures])), asdict(figures)


def test_a_run_repeats_bit_by_bit_and_seeds_differ() -> None:
    command = Command(v_x=0.5)
    controller, first = record(command, 0.5)
    _, second = record(command, 0.5)
    _, other = record(command, 0.5, seed=2)
    assert (first.outputs == second.outputs).all() and (first.position == second.position).all()
    assert (first.position != other.position).any()
    fresh = controller.fresh()
    assert fresh is not controller and fresh.configuration is controller.configuration


def test_standing_forces_carry_the_weight() -> None:
    controller, standing = record(Command(gait="stand"), 1.0, seed=None)
    forces = standing.outputs[-1, controller.places["force"]].reshape(4, 3)
    assert forces[:, 2].sum() == pytest.approx(MASS * 9.81, rel=0.01)
    assert standing.position[-1, 2] == pytest.approx(0.25, abs=0.004)


def test_the_estimate_is_near_the_truth_and_the_option_takes_it() -> None:
    controller, walked = record(Command(v_x=0.4), 2.0)
    error = walked.outputs[:, controller.places["velocity"]] - walked.velocity
    assert np.sqrt(np.mean(error[300:] ** 2, axis=0)).max() < 0.03
    controller, walked = record(Command(v_x=0.4), 0.5, seed=None, true_velocity=True)
    error = walked.outputs[:, controller.places["velocity"]] - walked.velocity
    assert np.abs(error).max() < 1e-12


def test_planned_joint_rates_come_true() -> None:
    """What is planned 60 ms ahead correlates with what the joints then do, and the plan begins with the present."""
    controller, walked = record(Command(v_x=0.5), 2.5, seed=None)
    steps = controller.configuration.settings.horizon + 1
    planned = walked.outputs[:, controller.places["rates"]].reshape(-1, steps, 12)
    ahead = round(2 * controller.configuration.settings.step / controller.configuration.settings.period)
    start = 600
    for hip_or_knee in (1, 2, 4, 5):
        now = np.corrcoef(planned[start:, 0, hip_or_knee], walked.speeds[start:, hip_or_knee])[0, 1]
        later = np.corrcoef(
            planned[start:-ahead, 2, hip_or_knee], walked.speeds[start + ahead :, hip_or_knee]
        )[0, 1]
        assert now > 0.95 and later > 0.9


def test_it_stops_and_changes_its_gait() -> None:
    import mujoco

    commands = Table(
        (0.0, 1.0, 2.0), (Command(v_x=0.3), Command(v_x=0.15, gait="walk"), Command(gait="stand"))
    )
    model = mujoco.MjModel.from_xml_string(quadruped_mjcf())
    controller = Controller(Configuration(commands, seed=5))
    record = walk(model, controller, 3.2, seed=5)
    swinging = record.outputs[:, controller.places["S_sw"]] > 0.0
    assert swinging[:500].sum(axis=1).max() == 2
    assert swinging[650:1000].sum(axis=1).max() == 1 and swinging[650:1000].any(axis=0).all()
    assert not swinging[1200:].any()
    assert record.fell is None and np.abs(record.velocity[-50:]).max() < 0.05
