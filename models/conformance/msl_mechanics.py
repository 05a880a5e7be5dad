"""Examples of the Modelica Standard Library 4.1.0, Mechanics.Rotational and Translational, built from the library.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from math import pi

from arthur_acausal import Component, Equations, Real, connect, parameter, start
from arthur_acausal.components import rotational, translational
from arthur_acausal.components.blocks import Constant, Product, Sine, Step
from arthur_acausal.components.rotational import (
    Brake,
    Clutch,
    ElastoBacklash,
    IdealGear,
    Inertia,
    TorqueSource,
)
from arthur_acausal.components.translational import ElastoGap, ForceSource, Rod, SlidingMass
from arthur_acausal.models.conformance.case import Case, precise


class First(Component):
    """A motor drives a load through a gear, a damped bearing and an elastic shaft (Rotational.First)."""

    fixed = rotational.Fixed()
    torque = TorqueSource(use_support=True)
    inertia1 = Inertia(J=0.1)
    gear = IdealGear(ratio=10.0, use_support=True)
    inertia2 = Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    spring = rotational.Spring(c=1e4, phi_rel=start(0.0, fixed=True))
    inertia3 = Inertia(J=2.0, w=start(0.0, fixed=True))
    damper = rotational.Damper(d=10.0)
    sine: Sine = Sine.of("N*m")(amplitude=10.0, f=5.0)

    def equations(self) -> Equations:
        yield connect(self.sine.y, self.torque.tau)
        yield connect(self.torque.flange, self.inertia1.flange_a)
        yield connect(self.inertia1.flange_b, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.inertia2.flange_a)
        yield connect(self.inertia2.flange_b, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.inertia3.flange_a)
        yield connect(self.damper.flange_a, self.inertia2.flange_b)
        yield connect(self.damper.flange_b, self.fixed.flange)
        yield connect(self.torque.support, self.fixed.flange)
        yield connect(self.gear.support, self.fixed.flange)


class Friction(Component):
    """A drive train whose motor slips in a clutch until a brake stops the far end at 0.5 s (Rotational.Friction)."""

    start_time: Real = parameter("s", default=0.5)
    fixed = rotational.Fixed()
    torque = TorqueSource(use_support=True)
    inertia3 = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(100.0, fixed=True))
    clutch = Clutch(f_n_max=160.0)
    inertia2 = Inertia(J=0.05, phi=start(0.0, fixed=True), w=start(90.0, fixed=True))
    spring = rotational.SpringDamper(c=160.0, d=1.0)
    brake = Brake(f_n_max=1600.0, use_support=True)
    inertia1 = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(90.0, fixed=True))
    pressed = Constant(k=1.0)
    braking = Step(start_time=lambda self: self.start_time)
    driving = Step(height=-1.0, offset=1.0, start_time=lambda self: self.start_time)
    sine: Sine = Sine.of("N*m")(amplitude=200.0, f=50.0 / pi)
    product: Product = Product.of("N*m")()

    def equations(self) -> Equations:
        yield connect(self.sine.y, self.product.u1)
        yield connect(self.driving.y, self.product.u2)
        yield connect(self.product.y, self.torque.tau)
        yield connect(self.pressed.y, self.clutch.f_normalized)
        yield connect(self.braking.y, self.brake.f_normalized)
        yield connect(self.torque.flange, self.inertia3.flange_a)
        yield connect(self.inertia3.flange_b, self.clutch.flange_a)
        yield connect(self.clutch.flange_b, self.inertia2.flange_a)
        yield connect(self.inertia2.flange_b, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.brake.flange_a)
        yield connect(self.brake.flange_b, self.inertia1.flange_a)
        yield connect(self.torque.support, self.fixed.flange)
        yield connect(self.brake.support, self.fixed.flange)


class Backlash(Component):
    """Two wheels on springs with dampers, one of them with play (Rotational.Backlash)."""

    fixed1 = rotational.Fixed()
    fixed2 = rotational.Fixed()
    spring_damper = rotational.SpringDamper(c=20e3, d=50.0)
    backlash = ElastoBacklash(c=20e3, d=50.0, b=pi / 4)
    inertia1 = Inertia(J=5.0, phi=start(pi / 2, fixed=True), w=start(0.0, fixed=True))
    inertia2 = Inertia(J=5.0, phi=start(pi / 2, fixed=True), w=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.fixed1.flange, self.spring_damper.flange_a)
        yield connect(self.spring_damper.flange_b, self.inertia1.flange_a)
        yield connect(self.fixed2.flange, self.backlash.flange_a)
        yield connect(self.backlash.flange_b, self.inertia2.flange_a)


class Gap(Component):
    """A mass between springs with dampers, and one between springs that only push (Translational.ElastoGap)."""

    fixed = translational.Fixed()
    rod1 = Rod(L=2.0)
    rod2 = Rod(L=2.0)
    spring_damper1 = translational.SpringDamper(c=10.0, d=1.5, s_rel0=1.0)
    spring_damper2 = translational.SpringDamper(c=10.0, d=1.5, s_rel0=1.0)
    mass1 = SlidingMass(m=1.0, s=start(2.0, fixed=True), v=start(0.0, fixed=True))
    gap1 = ElastoGap(c=10.0, d=1.5, s_rel0=1.5)
    gap2 = ElastoGap(c=10.0, d=1.5, s_rel0=1.5)
    mass2 = SlidingMass(m=1.0, s=start(2.0, fixed=True), v=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.rod1.flange_b, self.fixed.flange)
        yield connect(self.fixed.flange, self.rod2.flange_a)
        yield connect(self.spring_damper1.flange_a, self.rod1.flange_a)
        yield connect(self.spring_damper1.flange_b, self.mass1.flange_a)
        yield connect(self.mass1.flange_b, self.spring_damper2.flange_a)
        yield connect(self.spring_damper2.flange_b, self.rod2.flange_b)
        yield connect(self.gap1.flange_a, self.rod1.flange_a)
        yield connect(self.gap1.flange_b, self.mass2.flange_a)
        yield connect(self.mass2.flange_b, self.gap2.flange_a)
        yield connect(self.gap2.flange_b, self.rod2.flange_b)


class Oscillator(Component):
    """Two masses on springs, driven at resonance, one of them damped (Translational.Oscillator)."""

    fixed1 = translational.Fixed(s0=1.0)
    fixed2 = translational.Fixed(s0=1.0)
    mass1 = SlidingMass(m=1.0, L=1.0, s=start(-0.5, fixed=True), v=start(0.0, fixed=True))
    mass2 = SlidingMass(m=1.0, L=1.0, s=start(-0.5, fixed=True), v=start(0.0, fixed=True))
    spring1 = translational.Spring(c=1e4, s_rel0=1.0)
    spring2 = translational.Spring(c=1e4, s_rel0=1.0)
    damper1 = translational.Damper(d=10.0)
    force1 = ForceSource()
    force2 = ForceSource()
    sine1: Sine = Sine.of("N")(f=15.9155)
    sine2: Sine = Sine.of("N")(f=15.9155)

    def equations(self) -> Equations:
        yield connect(self.sine1.y, self.force1.f)
        yield connect(self.sine2.y, self.force2.f)
        yield connect(self.force1.flange, self.mass1.flange_a)
        yield connect(self.force2.flange, self.mass2.flange_a)
        yield connect(self.mass1.flange_b, self.spring1.flange_a)
        yield connect(self.spring1.flange_b, self.fixed1.flange)
        yield connect(self.mass2.flange_b, self.spring2.flange_a)
        yield connect(self.spring2.flange_b, self.fixed2.flange)
        yield connect(self.damper1.flange_a, self.spring2.flange_a)
        yield connect(self.damper1.flange_b, self.spring2.flange_b)


def _relative(names: dict[str, str], *quantities: str) -> dict[str, str]:
    """Reference name -> path, for the same quantities of several elements."""
    return {f"{theirs}.{q}": f"{ours}.{q}" for theirs, ours in names.items() for q in quantities}


_MODES = {"mode": "mode", "startForward": "start_forward", "startBackward": "start_backward"}

_CASES = (
    Case(
        "msl_Mechanics_Rotational_First",
        First,
        _relative({"damper": "damper"}, "phi_rel", "w_rel") | _relative({"inertia3": "inertia3"}, "phi", "w"),
        1.0,
        precise(1000),
    ),
    Case(
        "msl_Mechanics_Rotational_Friction",
        Friction,
        _relative({"clutch": "clutch", "spring": "spring"}, "phi_rel", "w_rel")
        | _relative({"inertia3": "inertia3"}, "phi", "w")
        | {
            f"{part}.{theirs}": f"{part}.{ours}"
            for part in ("brake", "clutch")
            for theirs, ours in _MODES.items()
        },
        3.0,
        precise(6000),
    ),
    Case(
        "msl_Mechanics_Rotational_Backlash",
        Backlash,
        _relative({"elastoBacklash": "backlash", "springDamper": "spring_damper"}, "phi_rel", "w_rel"),
        1.0,
        precise(2000),
    ),
    Case(
        "msl_Mechanics_Translational_ElastoGap",
        Gap,
        {
            "elastoGap1.v_rel": "gap1.v_rel",
            "elastoGap2.s_rel": "gap2.s_rel",
            "springDamper1.v_rel": "spring_damper1.v_rel",
            "springDamper2.s_rel": "spring_damper2.s_rel",
        },
        5.0,
        precise(1000),
    ),
    Case(
        "msl_Mechanics_Translational_Oscillator",
        Oscillator,
        _relative({"damper1": "damper1"}, "s_rel", "v_rel") | _relative({"mass1": "mass1"}, "s", "v"),
        1.0,
        precise(2000),
    ),
)
CASES: dict[str, Case] = {case.name: case for case in _CASES}
