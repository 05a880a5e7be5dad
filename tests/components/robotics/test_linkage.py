"""The triangle of cylinder and joint: closed forms, and energy through it."""

from __future__ import annotations

from math import acos, cos, pi, radians, sqrt

import casadi
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from arthur_acausal import Component, Equations, SolverOptions, connect, simulate, start, translate
from arthur_acausal.components import rotational as rot
from arthur_acausal.components import translational as lin
from arthur_acausal.components.robotics import CylinderLinkage, Triangle

sides = st.floats(0.01, 0.5)
angles = st.floats(0.3, pi - 0.3)


@settings(max_examples=100, deadline=None)
@given(a=sides, b=sides, psi=angles, phi=st.floats(-1.0, 1.0), direction=st.sampled_from([1.0, -1.0]))
def test_triangle(a: float, b: float, psi: float, phi: float, direction: float) -> None:
    """By the distance of two points; the arm is the height of the triangle; the inverse finds the angle again."""
    triangle = Triangle(a, b, psi - direction * phi, direction)
    l = float(np.hypot(a - b * np.cos(psi), b * np.sin(psi)))
    assert triangle.length(phi) == pytest.approx(l, rel=1e-12)
    height = a * b * np.sin(psi) / l
    assert triangle.arm(phi) == pytest.approx(direction * height, rel=1e-10)
    assert triangle.angle(triangle.length(phi)) == pytest.approx(phi, abs=1e-9)


def test_right_angle() -> None:
    """3-4-5, where the arm is 3 4 / 5."""
    triangle = Triangle(0.03, 0.04, pi / 2, 1.0)
    assert triangle.length(0.0) == pytest.approx(0.05)
    assert triangle.arm(0.0) == pytest.approx(0.024)


def test_arrays_and_expressions_agree() -> None:
    triangle = Triangle(0.026, 0.15, radians(51), 1.0)
    phi = np.linspace(0.0, pi / 2, 7)
    x = casadi.SX.sym("x")
    f = casadi.Function(
        "f", [x], [triangle.length(x), triangle.arm(x), casadi.jacobian(triangle.length(x), x)]
    )
    length, arm, slope = (np.array(value).ravel() for value in f(phi))
    assert triangle.length(phi) == pytest.approx(length, rel=1e-14)
    assert triangle.arm(phi) == pytest.approx(arm, rel=1e-14)
    assert slope == pytest.approx(arm, rel=1e-12)


class Swing(Component):
    """An inertia, turned by a spring at the rod, with a mass there."""

    linkage: CylinderLinkage = CylinderLinkage(a=0.026, b=0.15, psi_0=radians(96), l_0=0.15)
    inertia: rot.Inertia = rot.Inertia(J=0.01, phi=start(0.4, fixed=True), w=start(0.0, fixed=True))
    mass: lin.Mass = lin.Mass(m=5.0)
    spring: lin.Spring = lin.Spring(c=2e3)
    wall: lin.Fixed = lin.Fixed()

    def equations(self) -> Equations:
        yield connect(self.linkage.joint, self.inertia.flange_a)
        yield connect(self.linkage.rod, self.mass.flange)
        yield connect(self.spring.flange_a, self.wall.flange)
        yield connect(self.spring.flange_b, self.linkage.rod)


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_energy_goes_through_without_loss(direction: float) -> None:
    """A mass on the rod makes the joint's inertia depend on its angle: J + m arm^2. Energy stays."""
    model = translate(
        Swing(linkage=CylinderLinkage(a=0.026, b=0.15, psi_0=1.7, direction=direction, l_0=0.15))
    )
    assert model.report.index == 3
    run = model.simulate(0.5, options=SolverOptions(rtol=1e-9))
    energy = run["inertia.E_kinetic"] + run["mass.E_kinetic"] + run["spring.E_elastic"]
    assert run["inertia.E_kinetic"].max() > 0.2 * energy[0]
    assert energy == pytest.approx(np.full(run.t.size, energy[0]), rel=1e-6)
    work, done = run["linkage.tau"] * run["inertia.w"], run["linkage.f"] * run["mass.v"]
    assert work == pytest.approx(done, abs=1e-9 * np.abs(done).max())


class Held(Component):
    """A force on the rod, held by a torsion spring at the joint."""

    linkage = CylinderLinkage(a=0.03, b=0.04, psi_0=pi / 2, l_0=0.05)
    force: lin.ForceSource = lin.ForceSource(f=100.0)
    spring: rot.Spring = rot.Spring(c=1e6)
    ground: rot.Fixed = rot.Fixed()

    def equations(self) -> Equations:
        yield connect(self.force.flange, self.linkage.rod)
        yield connect(self.linkage.joint, self.spring.flange_b)
        yield connect(self.spring.flange_a, self.ground.flange)


def test_a_pushing_rod_turns_the_joint_forward() -> None:
    """100 N at an arm of 24 mm: 2.4 N m."""
    run = simulate(Held(), 0.1)
    assert run.final("linkage.tau") == pytest.approx(2.4, rel=1e-5)
    assert run.final("spring.phi_rel") == pytest.approx(2.4e-6, rel=1e-4)


def test_stroke_of_a_quarter_turn() -> None:
    """a = 26 mm, b = 150 mm about 96 degrees: 36 mm of stroke, by the distance of the pins at both ends."""
    ends = [sqrt(0.026**2 + 0.15**2 - 2 * 0.026 * 0.15 * cos(radians(psi))) for psi in (51, 141)]
    triangle = Triangle(0.026, 0.15, radians(51), 1.0)
    assert [triangle.length(0.0), triangle.length(pi / 2)] == pytest.approx(ends)
    assert ends[1] - ends[0] == pytest.approx(0.036, abs=3e-4)
    assert acos((0.026**2 + 0.15**2 - ends[0] ** 2) / (2 * 0.026 * 0.15)) == pytest.approx(radians(51))
