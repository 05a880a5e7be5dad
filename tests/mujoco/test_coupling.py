"""A cylinder drives a pendulum, of MuJoCo or of planar parts: the same motion, whatever hangs on the joint."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from arthur_acausal import Component, Equations, Solution, SolverOptions, connect, start, translate
from arthur_acausal.components import planar
from arthur_acausal.components.hydraulic import Cylinder, Orifice, PressureSource
from arthur_acausal.components.robotics import CylinderLinkage, Triangle
from arthur_acausal.components.rotational import Fixed, Flange, Inertia, SpringDamper
from arthur_acausal.mujoco import MujocoBody
from tests.mujoco.models import PENDULUM

M, LENGTH, RADIUS, PHI = 2.0, 0.5, 0.05, 0.3
TRIANGLE = Triangle(a=0.05, b=0.25, psi_0=1.2, direction=1.0)
RTOL = 1e-7


class PlanarPendulum(Component):
    """What PENDULUM is in MuJoCo: a ball on a massless rod, the angle counted from where it hangs."""

    hinge = Flange()
    ground = planar.Fixed(phi0=-np.pi / 2)
    pin = planar.Revolute(use_flange=True, phi=start(PHI, fixed=True), w=start(0.0, fixed=True))
    rod = planar.FixedTranslation(r_x=LENGTH)
    ball = planar.Body(m=M, J=2 / 5 * M * RADIUS**2)

    def equations(self) -> Equations:
        yield connect(self.ground.frame, self.pin.frame_a)
        yield connect(self.pin.frame_b, self.rod.frame_a)
        yield connect(self.rod.frame_b, self.ball.frame)
        yield connect(self.pin.flange, self.hinge)


class Driven(Component):
    """A cylinder between two throttles lifts the pendulum.

    ``loaded``: the piston has a mass, and a wheel and a spring hang on the joint: all of them move with the
    pendulum's own acceleration, which must be found together with theirs.
    """

    in_mujoco: bool = True
    loaded: bool = False
    supply = PressureSource(p="70 bar")
    tank = PressureSource(p="1 bar")
    inlet = Orifice(area="0.05 mm^2")
    outlet = Orifice(area="0.05 mm^2")

    def build(self) -> None:
        drawn = MujocoBody(mjcf=PENDULUM, hinge_phi=PHI, observe=("energy",))
        self.body: MujocoBody | PlanarPendulum = drawn if self.in_mujoco else PlanarPendulum()
        t = TRIANGLE
        length = float(t.length(PHI))
        self.linkage = CylinderLinkage(a=t.a, b=t.b, psi_0=t.psi_0, direction=t.direction, l_0=length)
        p_A, p_B = start("40 bar", fixed=True), start("10 bar", fixed=True)
        self.cylinder = Cylinder(inertia=self.loaded, m=0.5, p_A=p_A, p_B=p_B)
        if self.loaded:
            self.wheel, self.spring, self.wall = Inertia(J=0.3), SpringDamper(c=20.0, d=0.1), Fixed()

    def equations(self) -> Equations:
        yield connect(self.supply.port, self.inlet.port_a)
        yield connect(self.inlet.port_b, self.cylinder.port_a)
        yield connect(self.cylinder.port_b, self.outlet.port_a)
        yield connect(self.outlet.port_b, self.tank.port)
        yield connect(self.cylinder.flange, self.linkage.rod)
        yield connect(self.linkage.joint, self.body.hinge)
        if self.loaded:
            yield connect(self.body.hinge, self.wheel.flange_a)
            yield connect(self.body.hinge, self.spring.flange_b)
            yield connect(self.spring.flange_a, self.wall.flange)


@cache
def lifted(in_mujoco: bool, loaded: bool) -> Solution:
    model = translate(Driven(in_mujoco=in_mujoco, loaded=loaded))
    return model.simulate(0.3, options=SolverOptions(rtol=RTOL, intervals=1500))


@pytest.mark.parametrize("loaded", [False, True])
def test_mujoco_and_planar_parts_agree(loaded: bool) -> None:
    here, there = lifted(True, loaded), lifted(False, loaded)
    names = {"linkage.phi": 1.0, "cylinder.y": 0.01, "cylinder.p_A": 1e7, "cylinder.p_B": 1e7}
    for name, nominal in names.items():
        scale = max(nominal, float(np.abs(there[name]).max()))
        assert np.abs(here[name] - there[name]).max() < 10 * RTOL * scale, name
    assert np.ptp(here["linkage.phi"]) > 0.05


@pytest.mark.parametrize("loaded", [False, True])
def test_the_cylinder_s_work_is_the_joint_s_and_lifts_the_ball(loaded: bool) -> None:
    run = lifted(True, loaded)
    cylinder = np.trapezoid(-run["cylinder.flange.f"] * run["cylinder.v"], run.t)
    joint = float(np.trapezoid(run["linkage.tau"] * run["body.hinge_w"], run.t))
    assert cylinder == pytest.approx(joint, rel=1e-4)
    gained = np.ptp((run["body.E_kinetic"] + run["body.E_potential"])[[0, -1]])
    if loaded:
        w, phi = run["body.hinge_w"], run["linkage.phi"]
        gained += 0.3 * w[-1] ** 2 / 2 + 20.0 * (phi[-1] ** 2 - phi[0] ** 2) / 2
        gained += 0.1 * np.trapezoid(w**2, run.t)  # the damper's heat
    assert abs(joint) > 0.2
    assert joint == pytest.approx(gained, rel=1e-4)
