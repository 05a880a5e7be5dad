"""Gears, play, sources and sensors against closed forms."""

from __future__ import annotations

from math import pi

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
from arthur_acausal.components import translational as lin
from arthur_acausal.components.blocks import Sine, Step
from arthur_acausal.components.rotational import (
    AccelerationSensor,
    AngleSensor,
    AngleSource,
    ConstantSpeed,
    ConstantTorque,
    Damper,
    Disc,
    ElastoBacklash,
    Fixed,
    IdealGear,
    IdealGearR2T,
    Inertia,
    LossyGear,
    PowerSensor,
    QuadraticTorque,
    RelativeAngleSensor,
    RelativeSpeedSensor,
    SpeedSensor,
    TorqueSensor,
)

PRECISE = SolverOptions(rtol=1e-9)


class Drive(Component):
    """A torque on one wheel turns another one through a lossy gear."""

    tau: Real = parameter("N*m", default=10.0)
    load: Real = parameter("N*m", default=0.0)
    gear: LossyGear = LossyGear(ratio=2.0, losses=((0.0, 0.8, 0.5, 0.0, 0.0),))
    first = Inertia(J=1.0)
    second = Inertia(J=1.5, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    drive = ConstantTorque(tau_constant=lambda self: self.tau)
    pull = ConstantTorque(tau_constant=lambda self: self.load)

    def equations(self) -> Equations:
        yield connect(self.drive.flange, self.first.flange_a)
        yield connect(self.first.flange_b, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.second.flange_a)
        yield connect(self.second.flange_b, self.pull.flange)


def test_the_mesh_takes_its_share_by_the_side_that_drives() -> None:
    """a drives: J_2 w' = i eta_1 (tau - J_1 i w'). b drives: the gear hands tau_b eta_2 / i to a."""
    drive = translate(Drive())
    forward = drive.simulate(1.0, options=PRECISE)
    assert forward.final("second.w") == pytest.approx(2 * 0.8 * 10.0 / (1.5 + 4 * 0.8), rel=1e-8)
    assert forward.final("gear.mode") == 1.0
    back = drive.simulate(1.0, options=PRECISE, parameters={"tau": 0.0, "load": -10.0})
    assert back.final("second.w") == pytest.approx(-10.0 / (1.5 + 4 / 0.5), rel=1e-8)
    assert back.final("gear.mode") == -1.0
    lost = np.trapezoid(back["gear.P_loss"], back.t)
    energy = back["first.E_kinetic"] + back["second.E_kinetic"]
    assert energy[-1] + lost == pytest.approx(-10.0 * back.final("second.phi"), rel=1e-5)


def test_a_lossy_gear_locks_between_both_torques() -> None:
    """The load 10 N m could be held by 10/2 * 0.5 = 2.5 to 10/2/0.8 = 6.25 N m: nothing turns with 4 N m."""
    for tau, mode in ((2.4, -1.0), (2.6, 0.0), (6.2, 0.0), (6.3, 1.0)):
        solution = translate(Drive()).simulate(0.5, options=PRECISE, parameters={"tau": tau, "load": -10.0})
        assert solution.final("gear.mode") == mode
        assert (solution.final("second.w") == 0.0) == (mode == 0.0)


def test_bearing_friction_stops_a_gear_and_holds_it() -> None:
    class Coasting(Component):
        gear = LossyGear(ratio=1.0, losses=((0.0, 1.0, 1.0, 2.0, 2.0),))
        first = Inertia(J=1.0)
        second = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(3.0, fixed=True))

        def equations(self) -> Equations:
            yield connect(self.first.flange_b, self.gear.flange_a)
            yield connect(self.gear.flange_b, self.second.flange_a)

    solution = simulate(Coasting(), 5.0, options=PRECISE)
    assert solution.at(1.0, "second.w") == pytest.approx(2.0, rel=1e-8)
    assert solution.final("second.phi") == pytest.approx(3.0**2 / 2.0, rel=1e-8)
    assert solution.final("gear.mode") == 0.0


def test_the_housing_of_a_gear_takes_the_difference_of_torques() -> None:
    class Housed(Component):
        ground = Fixed()
        gear = IdealGear(use_support=True, ratio=3.0)
        wheel = Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
        drive = ConstantTorque(tau_constant=4.0)

        def equations(self) -> Equations:
            yield connect(self.ground.flange, self.gear.support)
            yield connect(self.drive.flange, self.gear.flange_a)
            yield connect(self.gear.flange_b, self.wheel.flange_a)

    solution = simulate(Housed(), 1.0, options=PRECISE)
    assert solution.final("wheel.w") == pytest.approx(6.0, rel=1e-9)
    assert solution.final("gear.support.tau") == pytest.approx(8.0, rel=1e-9)


def test_a_rack_turns_torque_to_force() -> None:
    """Pinion of 0.1 m radius: a mass of 2 kg feels 10 N from 1 N m and carries the wheel's 0.03 kg m^2 as 3 kg."""

    class Rack(Component):
        pinion = Inertia(J=0.03)
        rack = IdealGearR2T(ratio=10.0)
        mass = lin.Mass(m=2.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
        drive = ConstantTorque(tau_constant=1.0)

        def equations(self) -> Equations:
            yield connect(self.drive.flange, self.pinion.flange_a)
            yield connect(self.pinion.flange_b, self.rack.flange_r)
            yield connect(self.rack.flange_t, self.mass.flange)

    solution = simulate(Rack(), 1.0, options=PRECISE)
    assert solution.final("mass.v") == pytest.approx(10.0 / 5.0, rel=1e-9)
    assert solution.final("pinion.phi") == pytest.approx(10.0 * solution.final("mass.s"), rel=1e-12)


class Play(Component):
    """A wheel between springs with a play of 0.2 rad."""

    d: Real = parameter("N*m*s/rad", default=0.0)
    ground = Fixed()
    backlash: ElastoBacklash = ElastoBacklash(c=400.0, b=0.2, d=lambda self: self.d)
    wheel = Inertia(J=1.0, phi=start(0.3, fixed=True), w=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.ground.flange, self.backlash.flange_a)
        yield connect(self.backlash.flange_b, self.wheel.flange_a)


def test_play_has_a_period_of_contact_and_flight() -> None:
    """0.2 rad of deflection at 20 rad/s: half a turn of the phase in each contact, 0.2 rad of flight at 4 rad/s."""
    period = 2 * pi / 20.0 + 2 * 0.2 / 4.0
    solution = simulate(Play(), 10 * period, options=PRECISE)
    for k in (1, 5, 10):
        assert solution.at(k * period, "wheel.phi") == pytest.approx(0.3, abs=1e-6)
    assert solution.at(0.25 * 2 * pi / 20.0 + 0.025, "wheel.phi") == pytest.approx(0.0, abs=1e-7)
    assert len([e for e in solution.events if e.kind == "state"]) == 40


def test_play_with_a_damper_never_pulls() -> None:
    solution = translate(Play()).simulate(3.0, options=PRECISE, parameters={"d": 30.0})
    assert float((solution["backlash.tau"] * solution["backlash.depth"]).min()) >= 0.0
    energy = solution["wheel.E_kinetic"] + 200.0 * solution["backlash.depth"] ** 2
    assert float(np.diff(energy).max()) < 1e-6
    lost = np.trapezoid(solution["backlash.P_loss"], solution.t)
    assert energy[0] - energy[-1] == pytest.approx(lost, rel=1e-3)


def test_sensors_read_what_there_is() -> None:
    """A shaft turns a damper of 2 N m s at 3 rad/s past sensors: 6 N m, 18 W."""

    class Sensed(Component):
        source = ConstantSpeed(w_constant=3.0)
        torque = TorqueSensor()
        power = PowerSensor()
        disc = Disc(delta_phi=0.5)
        damper = Damper(d=2.0)
        ground = Fixed()
        angle = AngleSensor()
        speed = SpeedSensor()
        between = RelativeAngleSensor()
        faster = RelativeSpeedSensor()

        def equations(self) -> Equations:
            yield connect(self.source.flange, self.torque.flange_a)
            yield connect(self.torque.flange_b, self.power.flange_a)
            yield connect(self.power.flange_b, self.disc.flange_a)
            yield connect(self.disc.flange_b, self.damper.flange_a)
            yield connect(self.damper.flange_b, self.ground.flange)
            yield connect(self.angle.flange, self.source.flange)
            yield connect(self.speed.flange, self.source.flange)
            for sensor in (self.between, self.faster):
                yield connect(sensor.flange_a, self.ground.flange)
                yield connect(sensor.flange_b, self.damper.flange_a)

    solution = simulate(Sensed(), 1.0, options=PRECISE)
    read = {p: solution.final(p) for p in ("torque.tau", "power.P", "angle.phi", "speed.w")}
    assert read == pytest.approx({"torque.tau": 6.0, "power.P": 18.0, "angle.phi": 3.0, "speed.w": 3.0})
    assert solution.final("between.phi_rel") == pytest.approx(3.5)
    assert solution.final("faster.w_rel") == pytest.approx(3.0)


def test_a_fan_slows_down_along_a_hyperbola() -> None:
    class Fan(Component):
        wheel = Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(10.0, fixed=True))
        fan = QuadraticTorque(tau_n=5.0, w_n=10.0)
        sensor = AccelerationSensor()

        def equations(self) -> Equations:
            yield connect(self.wheel.flange_a, self.fan.flange)
            yield connect(self.wheel.flange_a, self.sensor.flange)

    solution = simulate(Fan(), 4.0, options=PRECISE)
    assert solution.final("wheel.w") == pytest.approx(10.0 / (1.0 + 0.25 * 4.0), rel=1e-8)
    assert solution.final("sensor.a") == pytest.approx(-2.5 * 0.25, rel=1e-7)


@pytest.mark.parametrize("exact", [True, False])
def test_an_angle_source_follows_its_signal(exact: bool) -> None:
    class Follower(Component):
        source: AngleSource = AngleSource(exact=exact, f_crit=100.0)
        sine: Sine = Sine.of("rad")(f=1.0 / (2.0 * pi))
        wheel = Inertia(J=3.0)

        def equations(self) -> Equations:
            yield connect(self.sine.y, self.source.phi_ref)
            yield connect(self.source.flange, self.wheel.flange_a)

    solution = simulate(Follower(), 2.0, options=PRECISE)
    w_c = 2.0 * pi * 100.0
    gain = 1.0 if exact else 1.0 / (1.0 + 1.3617j / w_c - 0.6180 / w_c**2)
    turning = gain * np.exp(2.0j)  # phi = Im(turning), once the start has died away
    assert solution.final("wheel.w") == pytest.approx(turning.real, abs=1e-6)
    assert solution.final("source.flange.tau") == pytest.approx(3.0 * turning.imag, abs=1e-3)


def test_a_step_of_the_angle_is_filtered() -> None:
    class Stepped(Component):
        source = AngleSource(f_crit=10.0)
        step: Step = Step.of("rad")(start_time=0.1)

        def equations(self) -> Equations:
            yield connect(self.step.y, self.source.phi_ref)

    solution = simulate(Stepped(), 1.0, options=PRECISE)
    assert solution.at(0.09, "source.phi") == 0.0
    assert solution.final("source.phi") == pytest.approx(1.0, abs=1e-6)
    assert float(solution["source.phi"].max()) < 1.01
