"""Bearing friction, clutches and brakes against exact piecewise solutions."""

from __future__ import annotations

from math import exp, pi
from typing import Any

import numpy as np
import pytest

from arthur_acausal import (
    Component,
    Equations,
    Real,
    SolverOptions,
    connect,
    parameter,
    simulate,
    start,
    translate,
)
from arthur_acausal.components.blocks import Ramp, Step
from arthur_acausal.components.rotational import (
    BearingFriction,
    Brake,
    Clutch,
    ConstantTorque,
    Fixed,
    Inertia,
    OneWayClutch,
    Spring,
    TorqueSource,
)
from arthur_acausal.models.examples.clutch_engagement import ClutchEngagement

PRECISE = SolverOptions(rtol=1e-9)


class Wheel(Component):
    """A wheel of 1 kg m^2 in a bearing; a torque rises from 3 s on by 1 N m in each second."""

    w_0: Real = parameter("rad/s", default=2.0)
    slope: Real = parameter("N*m", default=10.0)
    wheel = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(lambda self: self.w_0, fixed=True))
    bearing: BearingFriction = BearingFriction(tau_pos=((0.0, 1.0),), peak=1.5)
    ramp: Ramp = Ramp.of("N*m")(height=lambda self: self.slope, start_time=3.0, duration=10.0)
    torque = TorqueSource()

    def equations(self) -> Equations:
        yield connect(self.ramp.y, self.torque.tau)
        yield connect(self.torque.flange, self.wheel.flange_a)
        yield connect(self.wheel.flange_b, self.bearing.flange_a)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_wheel_stops_sticks_and_is_torn_off(sign: float) -> None:
    """Braked by 1 N m it stops at 2 s; 1.5 N m tear it off at 4.5 s; then w' = (t - 3) - 1."""
    solution = translate(Wheel()).simulate(
        6.0, options=PRECISE, parameters={"w_0": sign * 2.0, "slope": sign * 10.0}
    )
    assert solution.at(3.0, "wheel.phi") == pytest.approx(sign * 2.0, rel=1e-8)
    assert solution.at(4.4, "wheel.phi") == pytest.approx(sign * 2.0, rel=1e-8)
    assert solution.at(4.4, "bearing.tau") == pytest.approx(sign * 1.4, rel=1e-8)
    assert solution.final("wheel.w") == pytest.approx(sign * 1.875, rel=1e-7)
    assert solution.final("wheel.phi") == pytest.approx(sign * (2.0 + 1.125), rel=1e-7)
    modes = [solution.at(t, "bearing.mode") for t in (1.0, 3.0, 5.0)]
    assert modes == [sign, 0.0, sign]
    assert np.abs(solution["wheel.w"][(solution.t > 2.01) & (solution.t < 4.49)]).max() < 1e-9


def test_the_start_is_on_the_right_branch() -> None:
    solution = translate(Wheel()).simulate(0.5, options=PRECISE, parameters={"w_0": 0.0})
    assert solution["bearing.mode"].tolist() == [0.0] * len(solution.t)
    assert solution["bearing.locked"].tolist() == [1.0] * len(solution.t)


class Oscillator(Component):
    """A wheel on a spring, in a bearing with Coulomb friction."""

    wall = Fixed()
    spring = Spring(c=100.0)
    wheel = Inertia(J=1.0, phi=start(1.0, fixed=True), w=start(0.0, fixed=True))
    bearing = BearingFriction(tau_pos=((0.0, 6.0),))

    def equations(self) -> Equations:
        yield connect(self.wall.flange, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.wheel.flange_a)
        yield connect(self.wheel.flange_b, self.bearing.flange_a)


def test_coulomb_friction_takes_an_equal_step_from_each_swing() -> None:
    """Each half period pi/10 takes 2 tau/c = 0.12 rad: 1, -0.88, ..., 0.04, where the spring is too weak."""
    solution = simulate(Oscillator(), 3.0, options=PRECISE)
    for k in range(8):
        expected = (-1.0) ** k * (1.0 - 0.12 * k)
        assert solution.at(k * pi / 10, "wheel.phi") == pytest.approx(expected, abs=1e-6)
    assert solution.final("wheel.phi") == pytest.approx(0.04, abs=2e-7)
    assert solution.final("bearing.mode") == 0.0
    assert solution.final("bearing.tau") == pytest.approx(-4.0, abs=2e-5)


def test_friction_that_grows_with_speed() -> None:
    """tau = 1 + 2 w: J w' = -tau ends at w = 0 after ln(1 + 2 w_0)/2 seconds."""

    class Coasting(Component):
        wheel = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(3.0, fixed=True))
        bearing = BearingFriction(tau_pos=((0.0, 1.0), (1.0, 3.0), (2.0, 5.0)))

        def equations(self) -> Equations:
            yield connect(self.wheel.flange_a, self.bearing.flange_a)

    solution = simulate(Coasting(), 2.0, options=PRECISE)
    assert solution.at(0.5, "wheel.w") == pytest.approx((7.0 * exp(-1.0) - 1.0) / 2.0, rel=1e-6)
    stop = np.log(7.0) / 2.0
    assert solution.at(stop - 1e-3, "bearing.mode") == 1.0
    assert solution.at(stop + 1e-3, "bearing.mode") == 0.0


def test_a_clutch_keeps_the_momentum_and_takes_the_energy() -> None:
    """0.2 and 0.3 kg m^2, 40 N m: both turn with 40 rad/s after 0.3 s; 0.12 * 100^2 / 2 = 600 J are lost."""
    solution = simulate(ClutchEngagement(), 0.8, options=PRECISE)
    assert solution.final("driving.w") == pytest.approx(40.0, rel=1e-9)
    assert solution.final("driven.w") == pytest.approx(40.0, rel=1e-9)
    energy = solution["driving.E_kinetic"] + solution["driven.E_kinetic"]
    assert energy[0] - energy[-1] == pytest.approx(600.0, rel=1e-8)
    assert np.trapezoid(solution["clutch.P_loss"], solution.t) == pytest.approx(600.0, rel=1e-8)
    assert solution.at(0.39, "clutch.mode") == -1.0
    assert solution.at(0.41, "clutch.mode") == 0.0
    assert solution.at(0.05, "clutch.mode") == 2.0
    times = {round(e.time, 9) for e in solution.events}
    assert times == {0.1, 0.4}


class ClutchChain(Component):
    """Four wheels and three clutches that are pressed one after the other."""

    def build(self) -> None:
        speeds = (10.0, 0.0, -4.0, 2.0)
        self.wheels = [Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(w, fixed=True)) for w in speeds]
        self.clutches = [Clutch(f_n_max=20.0, peak=1.1) for _ in range(3)]
        self.press = [Step(start_time=t) for t in (0.0, 0.1, 0.2)]

    def equations(self) -> Equations:
        for k, clutch in enumerate(self.clutches):
            yield connect(self.wheels[k].flange_b, clutch.flange_a)
            yield connect(clutch.flange_b, self.wheels[k + 1].flange_a)
            yield connect(self.press[k].y, clutch.f_normalized)


def test_coupled_clutches_end_with_one_speed() -> None:
    solution = simulate(ClutchChain(), 3.0, options=PRECISE)
    momentum = sum(solution[f"wheels[{k}].w"] for k in range(4))
    assert np.abs(momentum - 8.0).max() < 1e-7
    assert [solution.final(f"wheels[{k}].w") for k in range(4)] == pytest.approx([2.0] * 4, rel=1e-7)
    assert [solution.final(f"clutches[{k}].mode") for k in range(3)] == [0.0, 0.0, 0.0]
    loss = sum(np.trapezoid(solution[f"clutches[{k}].P_loss"], solution.t) for k in range(3))
    assert loss == pytest.approx((100.0 + 16.0 + 4.0) / 2.0 - 4.0 * 4.0 / 2.0, rel=1e-4)


class Braked(Component):
    """A wheel, and a brake whose housing stands on the ground."""

    wheel = Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(10.0, fixed=True))
    brake: Brake = Brake(use_support=True, f_n_max=40.0)
    ground = Fixed()
    press = Step(start_time=1.0)
    push = ConstantTorque(tau_constant=0.0)

    def equations(self) -> Equations:
        yield connect(self.wheel.flange_b, self.brake.flange_a)
        yield connect(self.brake.support, self.ground.flange)
        yield connect(self.press.y, self.brake.f_normalized)
        yield connect(self.push.flange, self.brake.flange_b)


@pytest.mark.parametrize(("push", "mode"), [(0.0, 0.0), (10.0, 0.0), (30.0, 1.0)])
def test_a_brake_holds_up_to_its_torque(push: float, mode: float) -> None:
    """0.5 * 40 N * 1 m = 20 N m against the push."""
    solution = translate(Braked()).simulate(6.0, options=PRECISE, parameters={"push.tau_constant": push})
    w_1 = 10.0 + push / 2.0
    assert solution.at(0.999999, "wheel.w") == pytest.approx(w_1, rel=1e-5)
    assert solution.final("brake.mode") == mode
    expected = w_1 + 5.0 * (push - 20.0) / 2.0 if mode else 0.0
    assert solution.final("wheel.w") == pytest.approx(expected, abs=1e-7)
    if not mode:
        stop = w_1 * 2.0 / (20.0 - push)
        turned = (10.0 + w_1) / 2.0 + w_1 * stop / 2.0
        assert solution.final("wheel.phi") == pytest.approx(turned, rel=1e-7)
        assert solution.final("brake.tau") == pytest.approx(push, abs=1e-7)


def test_a_freewheel_pulls_and_lets_overrun() -> None:
    """A driven wheel of 1 kg m^2: pulled by 2 N m for 1 s, then the driving wheel is braked and it runs on."""

    class Freewheel(Component):
        a = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
        b = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
        clutch = OneWayClutch(f_n_max=1.0)
        step: Step = Step.of("N*m")(offset=2.0, height=-3.0, start_time=1.0)
        torque = TorqueSource()

        def equations(self) -> Equations:
            yield connect(self.step.y, self.torque.tau)
            yield connect(self.torque.flange, self.a.flange_a)
            yield connect(self.a.flange_b, self.clutch.flange_a)
            yield connect(self.clutch.flange_b, self.b.flange_a)

    solution = simulate(Freewheel(), 1.5, options=PRECISE)
    assert solution.at(0.5, "b.w") == pytest.approx(0.5, rel=1e-6)
    assert solution.at(0.5, "clutch.locked") == 1.0
    assert solution.final("a.w") == pytest.approx(1.0 - 0.5, rel=1e-7)
    assert solution.final("b.w") == pytest.approx(1.0, rel=1e-7)
    assert solution.final("clutch.tau") == 0.0
    assert float(solution["clutch.w_rel"].min()) > -1e-9


def test_what_is_at_rest_is_cheap() -> None:
    """A wheel that sticks makes no events and hardly any steps."""
    parameters: dict[str, Any] = {"w_0": 0.0, "slope": 0.9}
    solution = translate(Wheel()).simulate(13.0, options=PRECISE, parameters=parameters)
    assert [e for e in solution.events if e.kind == "state"] == []
    assert solution.final("wheel.phi") == 0.0
    assert solution.final("bearing.tau") == pytest.approx(0.9, rel=1e-9)
    assert solution.statistics.steps < 300
