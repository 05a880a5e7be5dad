"""More examples of the Modelica Standard Library 4.1.0, Mechanics.Translational.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from arthur_acausal import Component, Equations, connect, start
from arthur_acausal.components import translational
from arthur_acausal.components.blocks import Constant, Sine, Step
from arthur_acausal.components.translational import (
    AccelerationSensor,
    AccelerationSource,
    Brake,
    ElastoGap,
    Fixed,
    ForceSensor,
    ForceSource,
    PositionSensor,
    Rod,
    SlidingMass,
    SpeedSensor,
    Spring,
    SpringDamper,
)
from arthur_acausal.models.conformance.case import Case, precise


class Accelerate(Component):
    """A mass moved by a given acceleration (Accelerate)."""

    accelerate = AccelerationSource()
    mass = SlidingMass(m=1.0, L=1.0)
    constant: Constant = Constant.of("m/s^2")(k=1.0)

    def equations(self) -> Equations:
        yield connect(self.constant.y, self.accelerate.a)
        yield connect(self.accelerate.flange, self.mass.flange_a)


class Braking(Component):
    """Two masses with brakes, one grounded by a flange (Brake)."""

    brake = Brake(f_n_max=1.0)
    brake1 = Brake(f_n_max=1.0, use_support=True)
    mass1 = SlidingMass(m=1.0, s=start(0.0, fixed=True), v=start(1.0, fixed=True))
    mass2 = SlidingMass(m=1.0, s=start(0.0, fixed=True), v=start(1.0, fixed=True))
    step = Step(height=2.0, start_time=0.1)
    fixed = Fixed()

    def equations(self) -> Equations:
        for mass, brake in ((self.mass1, self.brake), (self.mass2, self.brake1)):
            yield connect(mass.flange_b, brake.flange_a)
            yield connect(self.step.y, brake.f_normalized)
        yield connect(self.fixed.flange, self.brake1.support)


class Damped(Component):
    """A mass on a damper, on damper and spring, and on both in one (Damper)."""

    fixed1 = Fixed(s0=4.5)
    fixed2 = Fixed(s0=4.5)
    fixed3 = Fixed(s0=4.5)
    damper1 = translational.Damper(d=25.0)
    damper2 = translational.Damper(d=25.0)
    spring2 = Spring(c=1.0, s_rel0=1.0)
    spring_damper3 = SpringDamper(c=1.0, d=25.0, s_rel0=1.0)
    mass1 = SlidingMass(m=1.0, L=1.0, s=start(3.0, fixed=True), v=start(10.0, fixed=True))
    mass2 = SlidingMass(m=1.0, L=1.0, s=start(3.0, fixed=True), v=start(10.0, fixed=True))
    mass3 = SlidingMass(m=1.0, L=1.0, s=start(3.0, fixed=True), v=start(10.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.mass1.flange_b, self.damper1.flange_a)
        yield connect(self.damper1.flange_b, self.fixed1.flange)
        for element in (self.damper2, self.spring2):
            yield connect(self.mass2.flange_b, element.flange_a)
            yield connect(element.flange_b, self.fixed2.flange)
        yield connect(self.mass3.flange_b, self.spring_damper3.flange_a)
        yield connect(self.spring_damper3.flange_b, self.fixed3.flange)


class InitialConditions(Component):
    """Two chains of masses and springs, one started by positions, one by lengths of springs (InitialConditions)."""

    fixed1 = Fixed(s0=-1.0)
    s1 = Spring(c=1e3, s_rel0=1.0, s_rel=start(0.5, fixed=True))
    m1 = SlidingMass(m=1.0, L=1.0, v=start(0.0, fixed=True))
    sd1 = SpringDamper(c=111.0, d=1.0, s_rel0=1.0, s_rel=start(1.0, fixed=True), v_rel=start(0.0, fixed=True))
    m2 = SlidingMass(m=1.0, L=2.0)
    fixed2 = Fixed(s0=1.0)
    s2 = Spring(c=1e3, s_rel0=2.0)
    m3 = SlidingMass(m=1.0, L=3.0, s=start(4.5, fixed=True), v=start(0.0, fixed=True))
    sd2 = SpringDamper(c=111.0, d=1.0, s_rel0=4.0)
    m4 = SlidingMass(m=1.0, L=5.0, s=start(12.5, fixed=True), v=start(0.0, fixed=True))

    def equations(self) -> Equations:
        for fixed, spring, first, between, last in (
            (self.fixed1, self.s1, self.m1, self.sd1, self.m2),
            (self.fixed2, self.s2, self.m3, self.sd2, self.m4),
        ):
            yield connect(fixed.flange, spring.flange_a)
            yield connect(spring.flange_b, first.flange_a)
            yield connect(first.flange_b, between.flange_a)
            yield connect(between.flange_b, last.flange_a)


class WhyArrows(Component):
    """Two masses on springs, one of them turned round (WhyArrows)."""

    fixed1 = Fixed(s0=-1.9)
    fixed2 = Fixed(s0=-1.9)
    spring1 = Spring(c=11.0, s_rel0=2.0)
    spring2 = Spring(c=11.0, s_rel0=2.0)
    mass1 = SlidingMass(m=1.0, L=2.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    inertia2 = SlidingMass(m=1.0, L=2.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True))

    def equations(self) -> Equations:
        for fixed, spring, mass in (
            (self.fixed1, self.spring1, self.mass1),
            (self.fixed2, self.spring2, self.inertia2),
        ):
            yield connect(fixed.flange, spring.flange_a)
            yield connect(spring.flange_b, mass.flange_b)


class Sensors(Component):
    """A force on a mass, past sensors (Sensors)."""

    force_sensor = ForceSensor()
    position1 = PositionSensor()
    position2 = PositionSensor()
    speed1 = SpeedSensor()
    acceleration1 = AccelerationSensor()
    mass = SlidingMass(m=1.0, L=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    force = ForceSource()
    sine: Sine = Sine.of("N")(amplitude=10.0, f=4.0)

    def equations(self) -> Equations:
        yield connect(self.sine.y, self.force.f)
        yield connect(self.force.flange, self.force_sensor.flange_a)
        yield connect(self.force_sensor.flange_b, self.mass.flange_a)
        for sensor in (self.position1, self.speed1, self.acceleration1):
            yield connect(self.mass.flange_a, sensor.flange)
        yield connect(self.mass.flange_b, self.position2.flange)


class PreLoad(Component):
    """A spool, held by one spring between two plates until the force exceeds its preload (PreLoad)."""

    fixed = Fixed(s0=-0.0955)
    housing = Rod(L=0.0305)
    rod1 = Rod(L=0.007)
    rod2 = Rod(L=0.007)
    rod3 = Rod(L=0.00575)
    rod4 = Rod(L=0.00575)
    inner_a = ElastoGap(c=1e6, d=250.0, s_rel0=0.001)
    inner_b = ElastoGap(c=1e6, d=250.0, s_rel0=0.001)
    outer_a = ElastoGap(c=1e6, d=250.0, s_rel0=0.0015)
    outer_b = ElastoGap(c=1e6, d=250.0, s_rel0=0.0015)
    spring = Spring(c=20e3, s_rel0=0.025)
    friction = translational.Damper(d=2500.0)
    spool = SlidingMass(m=0.15, L=0.19, s=start(0.01475, fixed=True), v=start(0.0, fixed=True))
    plate_a = SlidingMass(m=0.01, L=0.002, s=start(-0.093, fixed=True), v=start(0.0, fixed=True))
    plate_b = SlidingMass(m=0.01, L=0.002, s=start(-0.06925, fixed=True), v=start(0.0, fixed=True))
    force = ForceSource()
    sine: Sine = Sine.of("N")(amplitude=150.0, f=0.01)

    def equations(self) -> Equations:
        yield connect(self.sine.y, self.force.f)
        yield connect(self.force.flange, self.spool.flange_a)
        yield connect(self.fixed.flange, self.outer_a.flange_a)
        yield connect(self.outer_a.flange_b, self.plate_a.flange_a)
        yield connect(self.plate_a.flange_b, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.plate_b.flange_a)
        yield connect(self.plate_b.flange_b, self.outer_b.flange_a)
        yield connect(self.outer_b.flange_b, self.housing.flange_b)
        yield connect(self.housing.flange_a, self.fixed.flange)
        yield connect(self.plate_a.flange_b, self.rod1.flange_a)
        yield connect(self.rod1.flange_b, self.inner_a.flange_b)
        yield connect(self.inner_a.flange_a, self.rod3.flange_a)
        yield connect(self.rod2.flange_b, self.plate_b.flange_a)
        yield connect(self.rod2.flange_a, self.inner_b.flange_a)
        yield connect(self.inner_b.flange_b, self.rod4.flange_b)
        yield connect(self.rod3.flange_b, self.rod4.flange_a)
        yield connect(self.spool.flange_a, self.rod4.flange_a)
        yield connect(self.friction.flange_b, self.rod3.flange_a)
        yield connect(self.friction.flange_a, self.fixed.flange)


def _same(quantities: tuple[str, ...], *names: str) -> dict[str, str]:
    return {f"{name}.{q}": f"{name}.{q}" for name in names for q in quantities}


_MOTION, _RELATIVE = ("s", "v"), ("s_rel", "v_rel")
_MODES = {"mode": "mode", "startForward": "start_forward", "startBackward": "start_backward"}
_PRELOAD = {
    "innerContactA": "inner_a",
    "innerContactB": "inner_b",
    "outerContactA": "outer_a",
    "outerContactB": "outer_b",
    "friction": "friction",
}

_CASES = (
    Case(
        "msl_Mechanics_Translational_Accelerate",
        Accelerate,
        _same(_MOTION, "accelerate", "mass"),
        1.0,
        precise(1000),
    ),
    Case(
        "msl_Mechanics_Translational_Brake",
        Braking,
        _same(_MOTION, "mass1", "mass2")
        | {f"{b}.{theirs}": f"{b}.{ours}" for b in ("brake", "brake1") for theirs, ours in _MODES.items()},
        2.0,
        precise(2000),
    ),
    Case(
        "msl_Mechanics_Translational_Damper",
        Damped,
        _same(_RELATIVE, "damper1", "damper2")
        | {f"springDamper3.{q}": f"spring_damper3.{q}" for q in _RELATIVE},
        1.0,
        precise(2000),
    ),
    Case(
        "msl_Mechanics_Translational_InitialConditions",
        InitialConditions,
        _same(_MOTION, "m1", "m3") | _same(_RELATIVE, "sd1", "sd2"),
        5.0,
        precise(10000),
    ),
    Case(
        "msl_Mechanics_Translational_WhyArrows",
        WhyArrows,
        _same(_MOTION, "mass1", "inertia2"),
        1.0,
        precise(1000),
    ),
    Case("msl_Mechanics_Translational_Sensors", Sensors, _same(_MOTION, "mass"), 1.0, precise(2000)),
    Case(
        "msl_Mechanics_Translational_PreLoad",
        PreLoad,
        {f"{t}.{q}": f"{o}.{q}" for t, o in _PRELOAD.items() for q in _RELATIVE},
        100.0,
        precise(2000),
    ),
)
CASES: dict[str, Case] = {case.name: case for case in _CASES}
