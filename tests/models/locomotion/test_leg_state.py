"""The leg state machine: pulses, early and late contacts."""

from __future__ import annotations

from arthur_acausal.models.arthur.locomotion.leg_state import Leg, LegState
from arthur_acausal.models.arthur.locomotion.settings import Settings
from arthur_acausal.models.arthur.locomotion.walk_state import Walk, walk_state

SETTINGS = Settings(early=0.6, patience=0.04, period=0.002)


def state_of(leg: LegState) -> Leg:
    return leg.state


def swinging() -> LegState:
    leg = LegState(SETTINGS)
    leg.update(0.0, 0.1, False)
    return leg


def test_it_waits_in_init_and_carries() -> None:
    leg = LegState(SETTINGS)
    leg.update(0.0, 0.0, True)
    assert state_of(leg) is Leg.INIT and leg.c_sync
    leg.update(0.1, 0.0, True)
    assert state_of(leg) is Leg.STANCE and leg.e_st


def test_events_are_pulses() -> None:
    leg = LegState(SETTINGS)
    leg.update(0.9, 0.0, True)
    leg.update(0.0, 0.01, True)
    assert leg.e_sw and not leg.c_sync and not leg.e_st
    leg.update(0.0, 0.02, True)
    assert not leg.e_sw and not leg.c_sync
    leg.update(0.01, 0.0, True)
    assert leg.e_st and leg.c_sync
    leg.update(0.02, 0.0, True)
    assert not leg.e_st


def test_a_late_stumble_ends_the_swing_an_early_one_does_not() -> None:
    leg = swinging()
    leg.update(0.0, 0.5, True)
    assert state_of(leg) is Leg.SWING
    leg.update(0.0, 0.61, True)
    assert state_of(leg) is Leg.STANCE and leg.e_st
    leg.update(0.0, 0.7, True)
    assert state_of(leg) is Leg.STANCE  # the rest of this swing does not lift it again
    leg.update(0.1, 0.0, True)
    leg.update(0.0, 0.01, True)
    assert leg.e_sw


def test_it_waits_for_the_ground_but_not_for_ever() -> None:
    leg = swinging()
    ticks = 0
    while state_of(leg) is Leg.SWING:
        leg.update(0.1, 0.0, False)
        ticks += 1
    assert ticks == 20  # 40 ms
    leg = swinging()
    leg.update(0.1, 0.0, False)
    assert leg.waiting == SETTINGS.period
    leg.update(0.1, 0.0, True)
    assert state_of(leg) is Leg.STANCE and leg.waiting == 0.0


def test_walking_is_commanded_by_speed() -> None:
    assert walk_state(0.0, 0.01, "trot") is Walk.STAND
    assert walk_state(0.1, 0.01, "trot") is Walk.WALK
    assert walk_state(0.1, 0.01, "stand") is Walk.STAND
