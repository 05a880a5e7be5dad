"""More examples of the Modelica Standard Library 4.1.0, Mechanics: brakes, vehicles, friction, a gear shift.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from math import exp

from arthur_acausal import Component, Equations, connect, start
from arthur_acausal.components import rotational, translational
from arthur_acausal.components.blocks import Constant, Feedback, Gain, Ramp, Sine, Step, TimeTable
from arthur_acausal.components.rotational import (
    EddyCurrentTorque,
    IdealGear,
    IdealPlanetary,
    Inertia,
    QuadraticTorque,
    TorqueSource,
    Vehicle,
)
from arthur_acausal.components.thermal import HeatCapacitor
from arthur_acausal.components.translational import (
    EddyCurrentForce,
    ForceSource,
    MassWithStopAndFriction,
    QuadraticForce,
    SlidingMass,
    SupportFriction,
)
from arthur_acausal.models.conformance.case import Case, precise

ALPHA_COPPER = 3.92e-3
"""Temperature coefficient of the resistance of copper at 20 degrees Celsius, 1/K."""


class FirstGrounded(Component):
    """A motor drives a load through a gear, a damped bearing and an elastic shaft (Rotational.FirstGrounded)."""

    fixed = rotational.Fixed()
    torque = TorqueSource()
    inertia1 = Inertia(J=0.1)
    idealGear = IdealGear(ratio=10.0)
    inertia2 = Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    spring = rotational.Spring(c=1e4, phi_rel=start(0.0, fixed=True))
    inertia3 = Inertia(J=2.0, w=start(0.0, fixed=True))
    damper = rotational.Damper(d=10.0)
    sine: Sine = Sine.of("N*m")(amplitude=10.0, f=5.0)

    def equations(self) -> Equations:
        yield connect(self.sine.y, self.torque.tau)
        yield connect(self.torque.flange, self.inertia1.flange_a)
        yield connect(self.inertia1.flange_b, self.idealGear.flange_a)
        yield connect(self.idealGear.flange_b, self.inertia2.flange_a)
        yield connect(self.inertia2.flange_b, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.inertia3.flange_a)
        yield connect(self.damper.flange_a, self.inertia2.flange_b)
        yield connect(self.damper.flange_b, self.fixed.flange)


class EddyCurrentBrake(Component):
    """An eddy current brake, excited by a ramp, stops a wheel and warms up (Rotational.EddyCurrentBrake)."""

    eddyCurrentTorque = EddyCurrentTorque(w_n=10.0, alpha=ALPHA_COPPER)
    inertia = Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(20.0, fixed=True))
    heatCapacitor = HeatCapacitor(C=1.0, T=start(293.15, fixed=True))
    ramp: Ramp = Ramp.of("N*m")(height=100.0, duration=0.1, start_time=0.1)

    def equations(self) -> Equations:
        yield connect(self.ramp.y, self.eddyCurrentTorque.tau_n)
        yield connect(self.eddyCurrentTorque.flange, self.inertia.flange_a)
        yield connect(self.eddyCurrentTorque.heat_port, self.heatCapacitor.port)


class SlidingEddyCurrentBrake(Component):
    """An eddy current brake, excited by a ramp, stops a mass and warms up (Translational.EddyCurrentBrake)."""

    eddyCurrentForce = EddyCurrentForce(v_n=10.0, alpha=ALPHA_COPPER)
    mass = SlidingMass(m=1.0, s=start(0.0, fixed=True), v=start(20.0, fixed=True))
    heatCapacitor = HeatCapacitor(C=1.0, T=start(293.15, fixed=True))
    ramp: Ramp = Ramp.of("N")(height=100.0, duration=0.1, start_time=0.1)

    def equations(self) -> Equations:
        yield connect(self.ramp.y, self.eddyCurrentForce.f_n)
        yield connect(self.eddyCurrentForce.flange, self.mass.flange_a)
        yield connect(self.eddyCurrentForce.heat_port, self.heatCapacitor.port)


class CompareBrakingTorque(Component):
    """Four wheels stopped by torques of different laws (Rotational.CompareBrakingTorque)."""

    signTorque = rotational.SignTorque(tau_n=100.0, w_n=1.0)
    linearSpeedDependentTorque = rotational.LinearTorque(tau_n=100.0, w_n=100.0)
    quadraticSpeedDependentTorque = QuadraticTorque(tau_n=100.0, w_n=100.0)
    inverseSpeedDependentTorque = rotational.InverseTorque(tau_n=100.0, w_n=100.0, w_0=1.0)

    def build(self) -> None:
        wheels = [Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(100.0, fixed=True)) for _ in range(4)]
        self.inertia1, self.inertia2, self.inertia3, self.inertia4 = wheels

    def equations(self) -> Equations:
        yield connect(self.signTorque.flange, self.inertia1.flange_a)
        yield connect(self.linearSpeedDependentTorque.flange, self.inertia2.flange_a)
        yield connect(self.quadraticSpeedDependentTorque.flange, self.inertia3.flange_a)
        yield connect(self.inverseSpeedDependentTorque.flange, self.inertia4.flange_a)


class CompareBrakingForce(Component):
    """Four masses stopped by forces of different laws (Translational.CompareBrakingForce)."""

    signForce = translational.SignForce(f_n=100.0, v_n=1.0)
    linearSpeedDependentForce = translational.LinearForce(f_n=100.0, v_n=100.0)
    quadraticSpeedDependentForce = QuadraticForce(f_n=100.0, v_n=100.0)
    inverseSpeedDependentForce = translational.InverseForce(f_n=100.0, v_n=100.0, v_0=1.0)

    def build(self) -> None:
        masses = [SlidingMass(m=1.0, s=start(0.0, fixed=True), v=start(100.0, fixed=True)) for _ in range(4)]
        self.mass1, self.mass2, self.mass3, self.mass4 = masses

    def equations(self) -> Equations:
        yield connect(self.signForce.flange, self.mass1.flange_a)
        yield connect(self.linearSpeedDependentForce.flange, self.mass2.flange_a)
        yield connect(self.quadraticSpeedDependentForce.flange, self.mass3.flange_a)
        yield connect(self.inverseSpeedDependentForce.flange, self.mass4.flange_a)


class SimpleGearShift(Component):
    """A planetary gear shifted by a clutch and a brake (Rotational.SimpleGearShift)."""

    torqueStep = TorqueSource()
    drive: Step = Step.of("N*m")(height=20.0, start_time=0.5)
    engine = Inertia(J=1.0)
    idealPlanetary = IdealPlanetary(ratio=75 / 50)
    load = Inertia(J=10.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    quadraticSpeedDependentTorque = QuadraticTorque(tau_n=20.0, w_n=10.471975511966)
    clutch = rotational.Clutch(
        c_geo=2.0, f_n_max=100.0, phi_rel=start(0.0, fixed=True), w_rel=start(0.0, fixed=True)
    )
    brake = rotational.Brake(c_geo=2.0, f_n_max=100.0)
    feedback = Feedback()
    const1 = Constant(k=1.0)
    ramp = Ramp(height=1.0, start_time=2.0, duration=0.1)

    def equations(self) -> Equations:
        gear = self.idealPlanetary
        yield connect(self.drive.y, self.torqueStep.tau)
        yield connect(self.torqueStep.flange, self.engine.flange_a)
        yield connect(self.engine.flange_b, gear.sun)
        yield connect(gear.sun, self.clutch.flange_a)
        yield connect(gear.ring, self.clutch.flange_b)
        yield connect(gear.ring, self.brake.flange_a)
        yield connect(gear.carrier, self.load.flange_a)
        yield connect(self.load.flange_b, self.quadraticSpeedDependentTorque.flange)
        yield connect(self.const1.y, self.feedback.u1)
        yield connect(self.ramp.y, self.feedback.u2)
        yield connect(self.ramp.y, self.clutch.f_normalized)
        yield connect(self.feedback.y, self.brake.f_normalized)


def stribeck(v_max: float, points: int) -> tuple[tuple[float, float], ...]:
    """Return the table of a Stribeck curve: 5 + v + 10 exp(-2 v)."""
    speeds = [v_max * i / (points - 1) for i in range(points)]
    return tuple((v, 5.0 + v + 10.0 * exp(-2.0 * v)) for v in speeds)


class SlidingFriction(Component):
    """Masses with Stribeck friction, by its law and by a table, and one between stops (Translational.Friction)."""

    sineForce: Sine = Sine.of("N")(amplitude=25.0, f=0.25)
    force = ForceSource()
    force2 = ForceSource()
    stop1 = MassWithStopAndFriction(
        m=1.0, L=1.0, F_v=1.0, F_C=5.0, F_St=10.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)
    )
    mass = SlidingMass(m=1.0, L=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    supportFriction = SupportFriction(f_pos=stribeck(12.0, 50))
    stop2 = MassWithStopAndFriction(
        m=1.0,
        L=1.0,
        s_max=0.9,
        s_min=-0.9,
        F_v=1.0,
        F_C=3.0,
        F_St=5.0,
        s=start(0.0, fixed=True),
        v=start(-5.0, fixed=True),
    )
    spring = translational.Spring(c=500.0, s_rel0=1.0)
    fixed2 = translational.Fixed(s0=-1.75)

    def equations(self) -> Equations:
        yield connect(self.sineForce.y, self.force.f)
        yield connect(self.sineForce.y, self.force2.f)
        yield connect(self.force.flange, self.stop1.flange_a)
        yield connect(self.force2.flange, self.mass.flange_a)
        yield connect(self.mass.flange_b, self.supportFriction.flange_a)
        yield connect(self.fixed2.flange, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.stop2.flange_a)


class SignConvention(Component):
    """Three masses pushed and pulled (Translational.SignConvention)."""

    def build(self) -> None:
        masses = [
            SlidingMass(m=1.0, L=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)) for _ in "123"
        ]
        self.mass1, self.mass2, self.mass3 = masses
        self.force1, self.force2, self.force3 = ForceSource(), ForceSource(), ForceSource()
        self.constant1, self.constant2, self.constant3 = [Constant.of("N")(k=1.0) for _ in range(3)]

    def equations(self) -> Equations:
        yield connect(self.force1.flange, self.mass1.flange_a)
        yield connect(self.force2.flange, self.mass2.flange_b)
        yield connect(self.force3.flange, self.mass3.flange_b)
        yield connect(self.constant1.y, self.force1.f)
        yield connect(self.constant2.y, self.force2.f)
        yield connect(self.constant3.y, self.force3.f)


Points = tuple[tuple[float, float], ...]
TORQUES: Points = ((0, 0), (5, 0), (5, 5.6), (10.8, 5.6), (10.8, 1), (20, 1), (20, 2.8), (25, 2.8), (25, 1))
TORQUES += ((50, 1), (50, -5), (55, -5), (55, 0), (60, 0))
SLOPES: Points = ((0, 0), (20, 0), (20, 0.05), (25, 0.05), (25, 0), (60, 0))


class Vehicles(Component):
    """A vehicle, and one with a trailer, driven over a slope (Translational.Vehicle)."""

    torques = TimeTable(
        times=tuple(float(t) for t, _ in TORQUES), values=tuple(float(v) for _, v in TORQUES), events=True
    )
    slopes = TimeTable(
        times=tuple(float(t) for t, _ in SLOPES), values=tuple(float(v) for _, v in SLOPES), events=True
    )
    gain: Gain = Gain.of("N*m", "1")(k=0.25 * (0.5 * 1.18 * (25 / 3.5) ** 2 / 2 + 0.01 * 100.0 * 9.80665))
    gain1: Gain = Gain.of("N*m")(k=2.0)
    torque = TorqueSource()
    torque1 = TorqueSource()
    vehicle = Vehicle(m=100.0, R=0.25, C_r=0.01, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    vehicle1 = Vehicle(m=100.0, R=0.25, C_r=0.01, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    trailer = Vehicle(m=100.0, R=0.25, C_r=0.01)

    def equations(self) -> Equations:
        yield connect(self.torques.y, self.gain.u)
        yield connect(self.gain.y, self.torque.tau)
        yield connect(self.gain.y, self.gain1.u)
        yield connect(self.gain1.y, self.torque1.tau)
        for vehicle in (self.vehicle, self.vehicle1, self.trailer):
            yield connect(self.slopes.y, vehicle.inclination)
        yield connect(self.torque.flange, self.vehicle.flange_r)
        yield connect(self.torque1.flange, self.vehicle1.flange_r)
        yield connect(self.vehicle1.flange_t, self.trailer.flange_t)


_R, _T = "msl_Mechanics_Rotational_", "msl_Mechanics_Translational_"

_CASES = (
    Case(f"{_R}FirstGrounded", FirstGrounded, {}, 1.0, precise(1000)),
    Case(f"{_R}First_Grounded", FirstGrounded, {}, 1.0, precise(1000)),
    Case(f"{_R}EddyCurrentBrake", EddyCurrentBrake, {}, 1.0, precise(2000)),
    Case(f"{_R}CompareBrakingTorque", CompareBrakingTorque, {}, 5.0, precise(10000)),
    Case(f"{_R}SimpleGearShift", SimpleGearShift, {}, 5.0, precise(5000)),
    Case(f"{_T}EddyCurrentBrake", SlidingEddyCurrentBrake, {}, 1.0, precise(2000)),
    Case(f"{_T}CompareBrakingForce", CompareBrakingForce, {}, 5.0, precise(10000)),
    Case(f"{_T}Friction", SlidingFriction, {}, 5.0, precise(5000)),
    Case(f"{_T}SignConvention", SignConvention, {}, 1.0, precise(1000)),
    Case(f"{_T}Vehicle", Vehicles, {}, 60.0, precise(6000)),
)
CASES: dict[str, Case] = {case.name: case for case in _CASES}
