"""The gait pattern modulator: times of 7.6.3, shares and order of the phases, start and stop."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from arthur_acausal.models.arthur.locomotion.gait_modulator import GaitModulator, stance_time
from arthur_acausal.models.arthur.locomotion.gaits import GAITS

LIMITS = (0.2, 0.5)
PERIOD = 0.002


def run(
    modulator: GaitModulator, gait: str, ticks: int, speed: float = 0.5, walking: bool = True
) -> np.ndarray:
    """Return the swing states of some ticks (ticks, 4)."""
    rows = []
    for _ in range(ticks):
        modulator.update(PERIOD, walking, GAITS[gait], 0.094, speed, LIMITS)
        rows.append(modulator.S_sw)
    return np.array(rows)


def test_stance_time() -> None:
    trot = GAITS["trot"]
    assert stance_time(trot, 0.094, 0.5, LIMITS) == pytest.approx(2 * 0.094 / 0.5)
    assert stance_time(trot, 0.094, 0.0, LIMITS) == 0.5  # the report's grows without bound
    assert stance_time(trot, 0.094, 9.0, LIMITS) == 0.2
    assert stance_time(GAITS["walk"], 0.094, 0.15, LIMITS) == pytest.approx(0.75)


@pytest.mark.parametrize(("gait", "duty"), [("trot", 0.376 / 0.626), ("walk", 0.75), ("pace", 0.6)])
def test_each_leg_swings_its_share(gait: str, duty: float) -> None:
    modulator = GaitModulator()
    run(modulator, gait, 1)
    stride = (modulator.T_st + modulator.T_sw) / PERIOD
    swinging = run(modulator, gait, round(20 * stride)) > 0.0
    assert swinging.mean(axis=0) == pytest.approx(1.0 - duty, abs=0.01)


def test_who_swings_together() -> None:
    trot = run(GaitModulator(), "trot", 1000) > 0.0
    assert (trot[:, 0] == trot[:, 3]).all() and (trot[:, 1] == trot[:, 2]).all()
    assert not (trot[:, 0] & trot[:, 1]).any()
    walk = run(GaitModulator(), "walk", 1200) > 0.0
    assert walk.sum(axis=1).max() == 1
    lifts = [int(np.argmax(row)) for before, row in pairwise(walk) if (row > before).any()]
    rear_left, front_left, rear_right, front_right = 2, 0, 3, 1
    start = lifts.index(rear_left)
    assert lifts[start : start + 4] == [rear_left, front_left, rear_right, front_right]


def test_a_change_of_speed_does_not_make_the_phase_jump() -> None:
    modulator = GaitModulator()
    run(modulator, "trot", 777, speed=0.2)
    before = np.array(modulator.S)
    run(modulator, "trot", 1, speed=0.9)
    step = (modulator.S - before) % 1.0
    assert step == pytest.approx(PERIOD / (modulator.T_st + modulator.T_sw))


def test_it_begins_with_all_feet_on_the_ground() -> None:
    assert not run(GaitModulator(), "trot", 10).any()


def test_at_a_stop_feet_in_the_air_land_and_none_lifts() -> None:
    modulator = GaitModulator()
    while max(modulator.S_sw) <= 0.3:
        run(modulator, "trot", 1)
    flying = np.array(modulator.S_sw) > 0.0
    rows = run(modulator, "trot", 400, walking=False)
    assert not rows[:, ~flying].any()
    assert flying.sum() == 2 and rows[50, flying].all() and not rows[-1].any() and not any(modulator.S_st)


def test_a_new_gait_waits_for_all_feet() -> None:
    modulator = GaitModulator()
    run(modulator, "trot", 300)
    run(modulator, "walk", 1)
    assert modulator.gait == GAITS["trot"] and not modulator.running
    run(modulator, "walk", 400)
    assert modulator.gait == GAITS["walk"] and modulator.running
