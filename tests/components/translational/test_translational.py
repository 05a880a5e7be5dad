"""Translational friction, stops, links and sensors against exact piecewise solutions."""

from __future__ import annotations

from math import atan, exp, log, pi, sqrt

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
from arthur_acausal.components.blocks import Step
from arthur_acausal.components.translational import (
    AccelerationSensor,
    Brake,
    ConstantForce,
    ConstantSpeed,
    Damper,
    EndStops,
    Fixed,
    ForceSource,
    Lever,
    Mass,
    MassWithFriction,
    PowerSensor,
    RelativePositionSensor,
    RelativeSpeedSensor,
    Rod,
    SlidingMass,
    Spring,
    SpringDamper,
    StoppedMass,
    SupportFriction,
)
from arthur_acausal.models.examples.stick_slip import StickSlip

PRECISE = SolverOptions(rtol=1e-9)


class Belt(Component):
    """A block on a belt of 0.1 m/s, on a spring: 15 N tear it off, 10 N rub while it slips."""

    belt = ConstantSpeed(v_constant=0.1)
    friction = SupportFriction(use_support=True, f_pos=((0.0, 10.0),), peak=1.5)
    block = Mass(m=1.0, s=start(0.0, fixed=True), v=start(0.1, fixed=True))
    spring = Spring(c=100.0)
    wall = Fixed()

    def equations(self) -> Equations:
        yield connect(self.belt.flange, self.friction.support)
        yield connect(self.block.flange, self.friction.flange_a)
        yield connect(self.wall.flange, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.block.flange)


def test_stick_slip_on_a_belt_is_periodic() -> None:
    """Stuck from 0.05 m to 0.15 m in 1 s; slipping turns about 0.1 m with w = 10/s from (0.05 m, 0.1 m/s)."""
    slip = (2 * pi - 2 * atan(0.05 * 10.0 / 0.1)) / 10.0
    period = 1.0 + slip
    solution = simulate(Belt(), 1.5 + 5 * period + 0.1, options=SolverOptions(rtol=1e-9, intervals=5000))
    for k in range(6):
        assert solution.at(1.5 + k * period - 1e-4, "friction.mode") == 0.0
        assert solution.at(1.5 + k * period + 1e-3, "friction.mode") == -1.0
        assert solution.at(1.5 + k * period, "block.s") == pytest.approx(0.15, abs=2e-6)
    t = 0.25
    expected = 0.1 + 0.05 * np.cos(10 * t) + 0.01 * np.sin(10 * t)
    assert solution.at(1.5 + 3 * period + t, "block.s") == pytest.approx(expected, abs=5e-6)
    assert solution.at(1.5 + slip - 1e-3, "friction.mode") == -1.0
    assert solution.at(1.5 + slip + 1e-3, "friction.mode") == 0.0


def test_the_stribeck_block_is_torn_off_at_the_largest_friction() -> None:
    """It rides until the spring of 100 N/m pulls with 15 N; energy from the belt is lost or stored."""
    solution = simulate(StickSlip(), 4.0, options=PRECISE)
    torn = [e.time for e in solution.events if e.kind == "state" and "< -" in e.what]
    assert solution.at(torn[0], "block.s") == pytest.approx(0.15, rel=1e-5)
    assert float(solution["block.s"].max()) < 0.16
    assert {0.0, -1.0} == set(solution["block.mode"].tolist())


class Sliding(Component):
    """A mass with Stribeck friction, pushed."""

    push: Real = parameter("N", default=0.0)
    v_0: Real = parameter("m/s", default=0.0)
    mass: MassWithFriction = MassWithFriction(
        m=2.0,
        F_C=10.0,
        F_v=4.0,
        F_St=5.0,
        f_exp=2.0,
        s=start(0.0, fixed=True),
        v=start(lambda self: self.v_0, fixed=True),
    )
    force = ConstantForce(f_constant=lambda self: self.push)

    def equations(self) -> Equations:
        yield connect(self.force.flange, self.mass.flange)


@pytest.mark.parametrize(("push", "mode"), [(14.9, 0.0), (15.1, 1.0), (-14.9, 0.0), (-15.1, -1.0)])
def test_a_mass_sticks_up_to_coulomb_and_stribeck(push: float, mode: float) -> None:
    solution = translate(Sliding()).simulate(20.0, options=PRECISE, parameters={"push": push})
    assert solution.final("mass.mode") == mode
    v = abs(float(solution.final("mass.v")))
    if mode:
        assert 10.0 + 4.0 * v + 5.0 * exp(-2.0 * v) == pytest.approx(abs(push), rel=1e-6)
    else:
        assert v == 0.0
        assert solution.final("mass.f") == pytest.approx(push)


def test_coulomb_and_viscous_friction_stop_a_mass() -> None:
    """m v' = -(F_C + F_v v): v = 0 after (m/F_v) ln(1 + F_v v_0/F_C), s = (m/F_v)(v_0 - (F_C/F_v) ln(...))."""
    solution = translate(Sliding()).simulate(2.0, options=PRECISE, parameters={"v_0": 5.0, "mass.F_St": 0.0})
    logarithm = log(1 + 4.0 * 5.0 / 10.0)
    stop = 0.5 * logarithm
    assert solution.final("mass.s") == pytest.approx(0.5 * (5.0 - 2.5 * logarithm), rel=1e-8)
    assert solution.at(stop - 1e-3, "mass.mode") == 1.0
    assert solution.at(stop + 1e-3, "mass.mode") == 0.0


def test_a_brake_stops_a_mass_on_its_housing() -> None:
    """From 1 s on 2 * 0.5 * 8 N against 2 kg at 10 m/s: at rest after 2.5 s and 12.5 m."""

    class Braked(Component):
        mass = SlidingMass(m=2.0, L=0.4, s=start(0.0, fixed=True), v=start(10.0, fixed=True))
        brake = Brake(f_n_max=8.0, c_geo=2.0)
        press = Step(start_time=1.0)

        def equations(self) -> Equations:
            yield connect(self.mass.flange_b, self.brake.flange_a)
            yield connect(self.press.y, self.brake.f_normalized)

    solution = simulate(Braked(), 5.0, options=PRECISE)
    assert solution.final("mass.s") == pytest.approx(10.0 + 12.5, rel=1e-8)
    assert solution.final("brake.s") == pytest.approx(22.7, rel=1e-8)
    assert solution.at(0.5, "brake.mode") == 2.0
    assert solution.at(3.4, "brake.mode") == 1.0
    assert solution.at(3.6, "brake.mode") == 0.0
    lost = np.trapezoid(solution["brake.P_loss"], solution.t)
    assert lost == pytest.approx(100.0, rel=1e-6)


def test_stops_give_back_the_energy_and_dampers_take_it() -> None:
    """A mass of 1 kg at 1 m/s between stops 1 m apart: flight 1 s, contact pi/w with w = 100/s."""

    class Between(Component):
        mass = Mass(m=1.0, s=start(0.5, fixed=True), v=start(1.0, fixed=True))
        stops: EndStops = EndStops(s_min=0.0, s_max=1.0, c=1e4, d=0.0)

        def equations(self) -> Equations:
            yield connect(self.mass.flange, self.stops.flange)

    between = translate(Between())
    period = 2.0 + 2 * pi / 100.0
    solution = between.simulate(3 * period, options=PRECISE)
    assert solution.final("mass.s") == pytest.approx(0.5, abs=1e-6)
    assert solution.final("mass.v") == pytest.approx(1.0, rel=1e-6)
    assert float(solution["mass.s"].min()) == pytest.approx(-0.01, rel=1e-3)
    damped = between.simulate(3 * period, options=PRECISE, parameters={"stops.d": 50.0})
    assert float((damped["stops.f"] * damped["stops.depth"]).max()) <= 0.0
    assert float(np.diff(np.abs(damped["mass.v"][damped["stops.depth"] == 0.0])).max()) < 1e-6


def test_a_rod_and_two_masses_are_one_body() -> None:
    class Train(Component):
        first = SlidingMass(m=1.0, L=0.2, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
        rod = Rod(L=0.5)
        second = SlidingMass(m=3.0, L=0.4)
        force = ConstantForce(f_constant=8.0)
        sensor = AccelerationSensor()

        def equations(self) -> Equations:
            yield connect(self.first.flange_b, self.rod.flange_a)
            yield connect(self.rod.flange_b, self.second.flange_a)
            yield connect(self.second.flange_b, self.force.flange)
            yield connect(self.first.flange_a, self.sensor.flange)

    solution = simulate(Train(), 1.0, options=PRECISE)
    assert solution.final("sensor.a") == pytest.approx(2.0, rel=1e-9)
    assert solution.final("second.s") - solution.final("first.s") == pytest.approx(0.1 + 0.5 + 0.2)
    assert solution.final("rod.flange_a.f") == pytest.approx(-2.0, rel=1e-9)


def test_sensors_between_flanges() -> None:
    class Sensed(Component):
        source = ConstantSpeed(v_constant=0.3)
        power = PowerSensor()
        damper = Damper(d=20.0)
        ground = Fixed(s0=-1.0)
        distance = RelativePositionSensor()
        speed = RelativeSpeedSensor()

        def equations(self) -> Equations:
            yield connect(self.source.flange, self.power.flange_a)
            yield connect(self.power.flange_b, self.damper.flange_b)
            yield connect(self.damper.flange_a, self.ground.flange)
            for sensor in (self.distance, self.speed):
                yield connect(sensor.flange_a, self.ground.flange)
                yield connect(sensor.flange_b, self.source.flange)

    solution = simulate(Sensed(), 2.0, options=PRECISE)
    assert solution.final("power.P") == pytest.approx(20.0 * 0.09)
    assert solution.final("distance.s_rel") == pytest.approx(1.6)
    assert solution.final("speed.v_rel") == pytest.approx(0.3)


def test_a_mass_on_spring_and_damper_reaches_its_rest() -> None:
    class Hung(Component):
        wall = Fixed()
        hanger = SpringDamper(c=50.0, d=2.0 * sqrt(50.0), s_rel0=0.1)
        mass = Mass(m=1.0, s=start(0.1, fixed=True), v=start(0.0, fixed=True))
        weight = ConstantForce(f_constant=10.0)

        def equations(self) -> Equations:
            yield connect(self.wall.flange, self.hanger.flange_a)
            yield connect(self.hanger.flange_b, self.mass.flange)
            yield connect(self.weight.flange, self.mass.flange)

    t, w = 0.3, sqrt(50.0)
    solution = simulate(Hung(), t, options=PRECISE)
    assert solution.final("mass.s") == pytest.approx(0.1 + 0.2 * (1 - (1 + w * t) * exp(-w * t)), rel=1e-8)


class Bounced(Component):
    """A mass that a force drives against a rigid stop, and that is pulled away from it later."""

    mass: StoppedMass = StoppedMass(
        m=2.0, s_min=0.0, s_max=0.5, s=start(0.1, fixed=True), v=start(0.0, fixed=True)
    )
    force = ForceSource()
    step: Step = Step.of("N")(offset=4.0, height=-6.0, start_time=1.0)

    def equations(self) -> Equations:
        yield connect(self.step.y, self.force.f)
        yield connect(self.force.flange, self.mass.flange)


def test_a_mass_stays_at_a_rigid_stop_until_it_is_pulled_away() -> None:
    """s = 0.1 + t^2 until 0.5; at rest there; from 1 s on back, -(t - 1)^2/2, until 0 at 2 s."""
    solution = translate(Bounced()).simulate(3.0, options=SolverOptions(rtol=1e-9))
    assert float(solution.at(0.5, "mass.s")) == pytest.approx(0.35, rel=1e-7)
    assert float(solution.at(0.9, "mass.s")) == pytest.approx(0.5, rel=1e-7)
    assert float(solution.at(0.9, "mass.v")) == pytest.approx(0.0, abs=1e-12)
    assert float(solution.at(0.9, "mass.f_stop")) == pytest.approx(-4.0)
    assert float(solution.at(1.5, "mass.s")) == pytest.approx(0.375, rel=1e-7)
    assert solution.final("mass.s") == pytest.approx(0.0, abs=1e-8)
    assert solution.t[np.flatnonzero(solution["mass.stop"] == 1.0)[0]] == pytest.approx(0.4**0.5, rel=1e-7)


class Levered(Component):
    """A mass that a force moves through a lever of ratio -3."""

    force = ConstantForce(f_constant=6.0)
    lever: Lever = Lever(ratio=-3.0)
    mass: Mass = Mass(m=2.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.force.flange, self.lever.flange_a)
        yield connect(self.lever.flange_b, self.mass.flange)


def test_a_lever_turns_force_into_way() -> None:
    """The mass feels -F/3: s = -F/3/m t^2/2, and the other end moves a third of that, the other way."""
    solution = translate(Levered()).simulate(2.0, options=SolverOptions(rtol=1e-9))
    assert solution.final("mass.s") == pytest.approx(-2.0, rel=1e-7)
    assert solution.final("lever.flange_a.s") == pytest.approx(2.0 / 3.0, rel=1e-7)
