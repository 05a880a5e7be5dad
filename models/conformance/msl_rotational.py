"""More examples of the Modelica Standard Library 4.1.0, Mechanics.Rotational: clutches and gears with losses.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from math import pi

from arthur_acausal import Component, Equations, connect, start
from arthur_acausal.components.blocks import Constant, Pulse, Ramp, Sine, Step
from arthur_acausal.components.rotational import (
    BearingFriction,
    Clutch,
    ConstantTorque,
    Fixed,
    IdealGear,
    IdealGearR2T,
    Inertia,
    LossyGear,
    OneWayClutch,
    Spring,
    SpringDamper,
    TorqueSource,
)
from arthur_acausal.components.translational import QuadraticForce, SlidingMass
from arthur_acausal.models.conformance.case import Case, precise


class CoupledClutches(Component):
    """Four wheels and three clutches, engaged one after the other (CoupledClutches)."""

    torque = TorqueSource()
    sin1: Sine = Sine.of("N*m")(amplitude=10.0, f=5.0)
    sin2 = Sine(amplitude=1.0, f=0.2, phase=pi / 2)
    step1 = Step(start_time=0.4)
    step2 = Step(start_time=0.9)

    def build(self) -> None:
        self.J = [Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(w, fixed=True)) for w in (10.0, 0, 0, 0)]
        self.clutch = [Clutch(peak=1.1, f_n_max=20.0) for _ in range(3)]

    def equations(self) -> Equations:
        yield connect(self.sin1.y, self.torque.tau)
        yield connect(self.torque.flange, self.J[0].flange_a)
        for k, signal in enumerate((self.sin2.y, self.step1.y, self.step2.y)):
            yield connect(signal, self.clutch[k].f_normalized)
            yield connect(self.J[k].flange_b, self.clutch[k].flange_a)
            yield connect(self.clutch[k].flange_b, self.J[k + 1].flange_a)


class LossyDrive(Component):
    """A sine against a load, through a gear whose mesh takes a half (LossyGearDemo1)."""

    gear = LossyGear(ratio=2.0, losses=((0.0, 0.5, 0.5, 0.0, 0.0),), use_support=True)
    Inertia1 = Inertia(J=1.0)
    Inertia2 = Inertia(
        J=1.5, phi=start(0.0, fixed=True, nominal=1e-3), w=start(0.0, fixed=True, nominal=1e-2)
    )
    torque1 = TorqueSource(use_support=True)
    torque2 = TorqueSource(use_support=True)
    drive: Sine = Sine.of("N*m")(amplitude=10.0, f=1.0)
    load: Ramp = Ramp.of("N*m")(height=5.0, duration=2.0, offset=-10.0)
    fixed = Fixed()

    def equations(self) -> Equations:
        yield connect(self.drive.y, self.torque1.tau)
        yield connect(self.load.y, self.torque2.tau)
        yield from self.shaft()
        yield connect(self.Inertia1.flange_b, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.Inertia2.flange_a)
        yield connect(self.Inertia2.flange_b, self.torque2.flange)
        for part in (self.gear, self.torque1, self.torque2):
            yield connect(part.support, self.fixed.flange)

    def shaft(self) -> Equations:
        """Yield what connects the drive with the first wheel."""
        yield connect(self.torque1.flange, self.Inertia1.flange_a)


class LossyDriveWithBearing(LossyDrive):
    """The same with friction in a bearing as well: both may be stuck, and share what they hold (LossyGearDemo2)."""

    gear = LossyGear(ratio=2.0, losses=((0.0, 0.5, 0.5, 0.0, 0.0),), use_support=True, creep=1e-9)
    bearing = BearingFriction(tau_pos=((0.0, 0.5), (1.0, 1.0)), use_support=True, creep=1e-9)

    def shaft(self) -> Equations:
        yield connect(self.torque1.flange, self.bearing.flange_a)
        yield connect(self.bearing.flange_b, self.Inertia1.flange_a)
        yield connect(self.bearing.support, self.fixed.flange)


class Undriven(Component):
    """Two wheels stop in a lossy gear of which neither side drives; a torque cannot move them (LossyGearDemo3)."""

    gear = LossyGear(ratio=1.0, losses=((0.0, 0.25, 0.25, 0.625, 2.5),))
    Inertia1 = Inertia(J=0.001)
    Inertia2 = Inertia(J=0.001, phi=start(0.0, fixed=True), w=start(10.0, fixed=True))
    torque = TorqueSource()
    step: Step = Step.of("N*m")(start_time=0.5)

    def equations(self) -> Equations:
        yield connect(self.Inertia1.flange_b, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.Inertia2.flange_a)
        yield connect(self.Inertia2.flange_b, self.torque.flange)
        yield connect(self.step.y, self.torque.tau)


class FreewheelDrive(Component):
    """A sine on one wheel, another one behind a one-way clutch that is pressed now and then (OneWayClutch)."""

    inertiaIn = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(-0.5, fixed=True))
    inertiaOut = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    clutch = OneWayClutch(peak=25.0, f_n_max=3.0)
    torque = TorqueSource()
    sine: Sine = Sine.of("N*m")(amplitude=10.0, f=3.0)
    engagement = Pulse(duty=0.5, period=1.3, start_time=0.3)

    def equations(self) -> Equations:
        yield connect(self.sine.y, self.torque.tau)
        yield connect(self.torque.flange, self.inertiaIn.flange_a)
        yield connect(self.inertiaIn.flange_b, self.clutch.flange_a)
        yield connect(self.clutch.flange_b, self.inertiaOut.flange_a)
        yield connect(self.engagement.y, self.clutch.f_normalized)


class FreewheelLoad(Component):
    """A sine on one wheel, another one with a load behind a freewheel (OneWayClutchDisengaged)."""

    inertiaIn = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(-0.5, fixed=True))
    inertiaOut = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    clutch = OneWayClutch(peak=25.0, f_n_max=3.0)
    torque = TorqueSource()
    load = ConstantTorque(tau_constant=-0.3)
    sine: Sine = Sine.of("N*m")(amplitude=10.0, f=2.0, offset=0.3)
    released = Constant(k=0.0)

    def equations(self) -> Equations:
        yield connect(self.sine.y, self.torque.tau)
        yield connect(self.torque.flange, self.inertiaIn.flange_a)
        yield connect(self.inertiaIn.flange_b, self.clutch.flange_a)
        yield connect(self.clutch.flange_b, self.inertiaOut.flange_a)
        yield connect(self.inertiaOut.flange_b, self.load.flange)
        yield connect(self.released.y, self.clutch.f_normalized)


class ElasticBearing(Component):
    """A gear whose housing stands on a spring with a damper (ElasticBearing)."""

    shaft = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    load = Inertia(J=50.0, w=start(0.0, fixed=True))
    housing = Inertia(J=5.0)
    spring = Spring(c=1e3, phi_rel=start(0.0, fixed=True))
    mount = SpringDamper(
        c=1e5, d=5.0, phi_rel=start(0.0, fixed=True), w_rel=start(0.0, fixed=True, nominal=1e-4)
    )
    gear = IdealGear(ratio=3.0, use_support=True)
    torque = TorqueSource(use_support=True)
    ramp: Ramp = Ramp.of("N*m")(height=100.0, duration=5.0)
    fixed = Fixed()

    def equations(self) -> Equations:
        yield connect(self.ramp.y, self.torque.tau)
        yield connect(self.torque.support, self.fixed.flange)
        yield connect(self.torque.flange, self.shaft.flange_a)
        yield connect(self.shaft.flange_b, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.load.flange_a)
        yield connect(self.gear.support, self.housing.flange_b)
        yield connect(self.housing.flange_a, self.mount.flange_b)
        yield connect(self.mount.flange_a, self.fixed.flange)


class RollingWheel(Component):
    """A torque on a wheel that rolls moves a mass against the air (RollingWheel)."""

    inertia = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    wheel = IdealGearR2T(ratio=1.0)
    mass = SlidingMass(m=1.0)
    air = QuadraticForce(f_n=10.0, v_n=5.0)
    torque = TorqueSource()
    step: Step = Step.of("N*m")(height=10.0, start_time=0.1)

    def equations(self) -> Equations:
        yield connect(self.step.y, self.torque.tau)
        yield connect(self.torque.flange, self.inertia.flange_a)
        yield connect(self.inertia.flange_b, self.wheel.flange_r)
        yield connect(self.wheel.flange_t, self.mass.flange_a)
        yield connect(self.mass.flange_b, self.air.flange)


def _named(names: dict[str, str], *quantities: str) -> dict[str, str]:
    """Reference name -> path, for the same quantities of several elements."""
    return {f"{theirs}.{q}": f"{ours}.{q}" for theirs, ours in names.items() for q in quantities}


_MODES = {"mode": "mode", "startForward": "start_forward", "startBackward": "start_backward"}
_CLUTCHES = {f"clutch{k + 1}": f"clutch[{k}]" for k in range(3)}
_FREEWHEEL = _named({"inertiaIn": "inertiaIn"}, "phi", "w") | _named(
    {"oneWayClutch": "clutch"}, "phi_rel", "w_rel"
)
_GEAR = {"Inertia2.phi": "Inertia2.phi", "Inertia2.w": "Inertia2.w", "gear.mode": "gear.mode"}

_CASES = (
    Case(
        "msl_Mechanics_Rotational_CoupledClutches",
        CoupledClutches,
        _named({"J1": "J[0]"}, "phi", "w")
        | _named(_CLUTCHES, "phi_rel", "w_rel")
        | {f"{t}.{theirs}": f"{o}.{ours}" for t, o in _CLUTCHES.items() for theirs, ours in _MODES.items()},
        1.5,
        precise(3000),
    ),
    Case("msl_Mechanics_Rotational_LossyGearDemo1", LossyDrive, _GEAR, 0.5, precise(2000)),
    Case(
        "msl_Mechanics_Rotational_LossyGearDemo2",
        LossyDriveWithBearing,
        _GEAR | {f"bearingFriction.{theirs}": f"bearing.{ours}" for theirs, ours in _MODES.items()},
        0.5,
        precise(2000),
    ),
    Case("msl_Mechanics_Rotational_LossyGearDemo3", Undriven, _GEAR, 1.0, precise(2000)),
    Case("msl_Mechanics_Rotational_OneWayClutch", FreewheelDrive, _FREEWHEEL, 2.0, precise(4000)),
    Case("msl_Mechanics_Rotational_OneWayClutchDisengaged", FreewheelLoad, _FREEWHEEL, 2.0, precise(4000)),
    Case(
        "msl_Mechanics_Rotational_ElasticBearing",
        ElasticBearing,
        _named({"load": "load", "shaft": "shaft"}, "phi", "w")
        | _named({"springDamper": "mount"}, "phi_rel", "w_rel"),
        10.0,
        precise(5000),
    ),
    Case(
        "msl_Mechanics_Rotational_RollingWheel",
        RollingWheel,
        _named({"inertia": "inertia"}, "phi", "w") | _named({"mass": "mass"}, "s", "v"),
        5.0,
        precise(2000),
    ),
)
CASES: dict[str, Case] = {case.name: case for case in _CASES}
