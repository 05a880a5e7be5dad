"""A controller that was described in one process and made again in another is the same, bit by bit."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from arthur_acausal import UsageError
from arthur_acausal.models.arthur.dimensions import Dimensions, Link
from arthur_acausal.models.arthur.locomotion.commands import Command, Constant, Table
from arthur_acausal.models.arthur.locomotion.controller import Configuration
from arthur_acausal.models.arthur.locomotion.portable import as_data, of_data
from arthur_acausal.models.arthur.locomotion.settings import Settings, Weights
from arthur_acausal.models.arthur.walking import Walking

CHANGING = Table((0.0, 0.01), (Command(v_x=0.3), Command(v_x=0.1, gait="walk")))
OTHER = Configuration(
    commands=CHANGING,
    robot=Dimensions(trunk=Link(7.0, (0.01, 0.0, 0.0), (0.02, 0.07, 0.08))),
    settings=Settings(horizon=8, weights=Weights(force=2e-6)),
    seed=4,
    true_velocity=True,
)


@pytest.mark.parametrize("configuration", [Configuration(), OTHER])
def test_a_configuration_comes_back_as_it_was(configuration: Configuration) -> None:
    assert of_data(json.loads(json.dumps(as_data(configuration)))) == configuration


def test_a_restored_controller_does_the_same() -> None:
    walking = Walking(replace(Configuration(), commands=Constant(Command(v_x=0.5)), seed=3))
    copy = Walking.restore(json.loads(json.dumps(walking.describe())))
    sensors = np.concatenate([np.zeros(3), [1.0], np.zeros(9), Dimensions().stand * 4, np.zeros(19)])
    sensors[2], sensors[37:41], sensors[43] = 0.25, 24.0, 9.81
    here = np.zeros(0)
    for k in range(40):
        here, there = walking(0.002 * k, sensors), copy(0.002 * k, sensors)
        assert np.isfinite(here).all() and (here == there).all()
    assert np.abs(here[12:24]).max() > 10.0  # N


def test_commands_that_are_a_function_stay_here() -> None:
    with pytest.raises(UsageError, match=r"Table"):
        as_data(Configuration(commands=lambda t: Command()))
