"""Exported models, simulated by rumoca: an oracle that has nothing in common with this project.

Agreement is asked within ten times TOLERANCE of the largest value of each unit, at all outputs that are not at an
event, for every variable of the model. Both sides integrate with a thousandth of it, since the errors of the steps add
up along a run.

Not here: what samples by a function in Python has no form in Modelica; rumoca 0.10.2 stops at an event of a gear with
losses (LossyDrive), and holds a freewheel and a bearing in another one of their modes.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest

from arthur_acausal import Component
from arthur_acausal.models.arthur.powertrain import Powertrain
from arthur_acausal.models.conformance import (
    msl_blocks,
    msl_electrical,
    msl_mechanics,
    msl_rotational,
    msl_thermal,
    msl_translational,
)
from arthur_acausal.models.examples.accumulator_charge import AccumulatorCharge
from arthur_acausal.models.examples.bouncing_ball import BouncingBall
from arthur_acausal.models.examples.clutch_engagement import ClutchEngagement
from arthur_acausal.models.examples.double_pendulum import DoublePendulum
from arthur_acausal.models.examples.four_bar import FourBar
from arthur_acausal.models.examples.jack import Jack
from arthur_acausal.models.examples.motor_control import MotorControl
from arthur_acausal.models.examples.power_supply import PowerSupply
from arthur_acausal.models.examples.rc_ladder import RCLadder
from arthur_acausal.models.examples.room_heating import RoomHeating
from arthur_acausal.models.examples.slider_crank import SliderCrank
from arthur_acausal.models.examples.stick_slip import StickSlip
from tests.exchange.compare import differences

TOLERANCE = 1e-6

CASES: list[tuple[Callable[[], Component], float]] = [
    (lambda: Powertrain(n=2), 0.05),
    (Jack, 1.0),
    (AccumulatorCharge, 1.0),
    (lambda: BouncingBall(e=0.8), 1.5),
    (lambda: RCLadder(n=20), 1.0),
    (PowerSupply, 0.05),
    (RoomHeating, 3600.0),
    (MotorControl, 1.0),
    (DoublePendulum, 0.5),
    (FourBar, 0.5),
    (SliderCrank, 0.5),
    (msl_blocks.PIDController, 2.0),
    (msl_electrical.CauerLowPass, 5.0),
    (msl_mechanics.First, 1.0),
    (msl_mechanics.Backlash, 1.0),
    (msl_mechanics.Gap, 1.0),
    (msl_mechanics.Oscillator, 1.0),
    (msl_rotational.ElasticBearing, 0.5),
    (msl_rotational.RollingWheel, 1.0),
    (msl_thermal.TwoMasses, 1.0),
    (msl_thermal.ControlledTemperature, 10.0),
    (msl_translational.Damped, 1.0),
    (msl_translational.Sensors, 1.0),
]
FRICTION: list[tuple[Callable[[], Component], float]] = [
    (ClutchEngagement, 1.0),
    (StickSlip, 1.0),
    (msl_mechanics.Friction, 1.0),
    (msl_rotational.CoupledClutches, 1.5),
    (msl_translational.Braking, 1.0),
]


@pytest.mark.parametrize(("model", "stop_time"), CASES)
def test_every_variable_agrees(model: Callable[[], Component], stop_time: float) -> None:
    found = differences(model(), stop_time, 1e-3 * TOLERANCE)
    assert found[0].size <= 10.0 * TOLERANCE, found[:3]


@pytest.mark.parametrize(("model", "stop_time"), FRICTION)
def test_dry_friction_agrees(model: Callable[[], Component], stop_time: float) -> None:
    """But for the steps of the state machine on its way through an event, which are no one's business."""
    found = [d for d in differences(model(), stop_time, 1e-3 * TOLERANCE) if d.kind != "discrete"]
    assert found[0].size <= 10.0 * TOLERANCE, found[:3]


def test_parameters_are_exported() -> None:
    found = differences(Jack(), 0.5, 1e-3 * TOLERANCE, {"orifice.area": 3e-6, "load.m": 400.0})
    assert found[0].size <= 10.0 * TOLERANCE, found[:3]
