"""Translational and rotational elements against solutions in closed form."""

from __future__ import annotations

from math import cos, exp, pi, sqrt

import numpy as np
import pytest

from arthur_acausal import Component, Equations, SolverOptions, connect, simulate, start, translate
from arthur_acausal.components import rotational as rot
from arthur_acausal.components import translational as lin
from arthur_acausal.components.blocks import Constant

PRECISE = SolverOptions(rtol=1e-9)


class Oscillator(Component):
    """Wall, spring and damper, mass, force; sensors beside."""

    wall = lin.Fixed(s0=1.0)
    spring = lin.Spring(c=100.0, s_rel0=0.5)
    damper = lin.Damper(d=1.0)
    mass: lin.Mass = lin.Mass(m=1.0, s=start(2.0, fixed=True), v=start(0.0, fixed=True))
    force = lin.ForceSource(f=0.0)
    position = lin.PositionSensor()
    speed = lin.SpeedSensor()

    def equations(self) -> Equations:
        yield connect(self.wall.flange, self.spring.flange_a)
        yield connect(self.wall.flange, self.damper.flange_a)
        yield connect(self.spring.flange_b, self.mass.flange)
        yield connect(self.damper.flange_b, self.mass.flange)
        yield connect(self.force.flange, self.mass.flange)
        yield connect(self.position.flange, self.mass.flange)
        yield connect(self.speed.flange, self.mass.flange)


def test_a_damped_oscillator() -> None:
    """s = 1.5 + 0.5 exp(-D t) (cos w t + D/w sin w t), D = d/2m, w^2 = c/m - D^2."""
    t, D = 0.7, 0.5
    w = sqrt(100 - D**2)
    solution = simulate(Oscillator(), t, options=PRECISE)
    expected = 1.5 + 0.5 * exp(-D * t) * (cos(w * t) + D / w * np.sin(w * t))
    assert solution.final("position.s") == pytest.approx(expected, rel=1e-7)
    assert solution.final("speed.v") == pytest.approx(solution.final("mass.v"))
    energy = solution["mass.E_kinetic"] + solution["spring.E_elastic"]
    lost = np.trapezoid(solution["damper.P_loss"], solution.t)
    assert energy[0] - energy[-1] == pytest.approx(lost, rel=1e-4)


def test_a_force_pushes_forwards_and_a_load_backwards() -> None:
    class Pushed(Component):
        mass = lin.Mass(m=2.0)
        force = lin.ForceSource(f=10.0)
        load = lin.LoadForce(F=4.0)

        def equations(self) -> Equations:
            yield connect(self.force.flange, self.mass.flange)
            yield connect(self.load.flange, self.mass.flange)

    solution = simulate(Pushed(), 1.0, options=PRECISE)
    assert solution.final("mass.v") == pytest.approx(3.0, rel=1e-9)
    assert solution.final("load.P_work") == pytest.approx(4.0 * 3.0, rel=1e-9)


class Bouncer(Component):
    """A mass that flies against a stop."""

    wall = lin.Fixed()
    gap: lin.ElastoGap = lin.ElastoGap(c=1e4, d=0.0)
    mass = lin.Mass(m=1.0, s=start(1.0, fixed=True), v=start(-2.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.wall.flange, self.gap.flange_a)
        yield connect(self.gap.flange_b, self.mass.flange)


def test_an_elastic_stop_gives_all_energy_back() -> None:
    solution = simulate(Bouncer(), 1.0, options=PRECISE)
    assert solution.final("mass.v") == pytest.approx(2.0, rel=1e-6)
    assert len(solution.events) == 2
    assert solution.final("mass.s") == pytest.approx(2.0 * (1.0 - 0.5 - pi / 100.0), rel=1e-5)


def test_a_damped_stop_never_pulls() -> None:
    solution = simulate(Bouncer(gap=lin.ElastoGap(c=1e4, d=60.0)), 1.0, options=SolverOptions(intervals=5000))
    assert np.max(solution["gap.f"]) <= 1e-9
    assert 0 < solution.final("mass.v") < 1.5


class Shaft(Component):
    """Torque, inertia, spring and damper, second inertia."""

    torque = rot.TorqueSource(tau=0.0)
    first: rot.Inertia = rot.Inertia(J=1.0, phi=start(0.1, fixed=True), w=start(0.0, fixed=True))
    spring = rot.SpringDamper(c=100.0, d=0.0)
    second = rot.Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    angle = rot.AngleSensor()
    speed = rot.SpeedSensor()

    def equations(self) -> Equations:
        yield connect(self.torque.flange, self.first.flange_a)
        yield connect(self.first.flange_b, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.second.flange_a)
        yield connect(self.angle.flange, self.second.flange_b)
        yield connect(self.speed.flange, self.second.flange_b)


def test_two_inertias_on_a_spring() -> None:
    """phi_rel oscillates with sqrt(c (1/J1 + 1/J2)); the centre of inertia rests."""
    t = 0.9
    solution = simulate(Shaft(), t, options=PRECISE)
    w = sqrt(100 * 1.5)
    assert solution.final("spring.phi_rel") == pytest.approx(-0.1 * cos(w * t), rel=1e-6)
    assert solution.final("first.phi") + 2 * solution.final("angle.phi") == pytest.approx(0.1, rel=1e-9)


class Rigid(Component):
    """Two inertias joined rigidly through a gear, a torque sensor and a fixed damper."""

    torque = rot.TorqueSource(tau=6.0)
    first = rot.Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    gear = rot.IdealGear(ratio=2.0)
    sensor = rot.TorqueSensor()
    second = rot.Inertia(J=8.0)
    damper = rot.Damper(d=0.0)
    spring = rot.Spring(c=0.0)
    wall = rot.Fixed()

    def equations(self) -> Equations:
        yield connect(self.torque.flange, self.first.flange_a)
        yield connect(self.first.flange_b, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.sensor.flange_a)
        yield connect(self.sensor.flange_b, self.second.flange_a)
        yield connect(self.second.flange_b, self.damper.flange_a)
        yield connect(self.second.flange_b, self.spring.flange_a)
        yield connect(self.damper.flange_b, self.wall.flange)
        yield connect(self.spring.flange_b, self.wall.flange)


def test_rigidly_joined_inertias_add_up() -> None:
    """J1 + J2/ratio^2 = 3 kg m^2 under 6 N m; higher index, reduced by the framework."""
    rig = translate(Rigid())
    solution = rig.simulate(1.0, options=PRECISE)
    assert solution.final("first.w") == pytest.approx(2.0, rel=1e-8)
    assert solution.final("second.w") == pytest.approx(1.0, rel=1e-8)
    assert solution.final("sensor.tau") == pytest.approx(8.0, rel=1e-8)


def test_a_position_source_moves_a_compliant_load() -> None:
    class Dragged(Component):
        place = Constant.of("m")(k=0.2)
        hand = lin.PositionSource()
        spring = lin.SpringDamper(c=50.0, d=0.0)
        sensor = lin.ForceSensor()
        wall = lin.Fixed()

        def equations(self) -> Equations:
            yield connect(self.place.y, self.hand.s)
            yield connect(self.hand.flange, self.sensor.flange_a)
            yield connect(self.sensor.flange_b, self.spring.flange_a)
            yield connect(self.spring.flange_b, self.wall.flange)

    solution = simulate(Dragged(), 1.0)
    assert abs(solution.final("sensor.f")) == pytest.approx(10.0, rel=1e-9)
