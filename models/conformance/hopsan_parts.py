"""Counterparts of components of Hopsan's default library that take more than one component of ours.

Flanges are in Hopsan's coordinates: each component with inertia counts a port's position outwards, so that both ends
of a mass move away from it in positive direction. Laws and names are facts of Hopsan (Linkoping University, default
component library, Apache-2.0); no text of it is used.
"""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, connect, real_input, real_output
from arthur_acausal.components import rotational
from arthur_acausal.components.blocks import Gain
from arthur_acausal.components.hydraulic import (
    Accumulator,
    Cylinder,
    Fluid,
    HydraulicMotor,
    HydraulicPort,
    LinearResistance,
    LineSegment,
    Piston,
    Volume,
)
from arthur_acausal.components.translational import Damper, Fixed, Flange, Lever, Rod, Spring, StoppedMass


class Load(Component):
    """A mass between stops, with a damper and a spring to the ground."""

    flange = Flange()
    mass: StoppedMass = StoppedMass(m=1.0, s_min=0.0, s_max=1.0)
    damper: Damper = Damper(d=0.0)
    spring: Spring = Spring(c=0.0)
    ground = Fixed()

    def equations(self) -> Equations:
        yield connect(self.flange, self.mass.flange)
        for element in self.damper, self.spring:
            yield connect(self.ground.flange, element.flange_a)
            yield connect(element.flange_b, self.mass.flange)


class SlidingLoad(Load):
    """A load with two ends: ``back`` at the one that moves against its position."""

    back = Flange()
    lever = Lever(ratio=-1.0)
    rod: Rod = Rod(L=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.mass.flange, self.lever.flange_a)
        yield connect(self.lever.flange_b, self.rod.flange_a)
        yield connect(self.rod.flange_b, self.back)


class LoadedPiston(Component):
    """A piston without storage that moves a load."""

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    flange = Flange()
    fluid: Fluid = Fluid()
    piston: Piston = Piston(A_a=1e-3, A_b=1e-3)
    load: Load = Load()

    def equations(self) -> Equations:
        yield connect(self.port_a, self.piston.port_a)
        yield connect(self.port_b, self.piston.port_b)
        yield connect(self.piston.flange, self.load.flange)
        yield connect(self.load.flange, self.flange)


class RodOfCylinder(Component):
    """A cylinder without inertia, whose rod's coordinate falls as it extends."""

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    flange = Flange()
    fluid: Fluid = Fluid()
    cylinder: Cylinder = Cylinder(inertia=False)
    lever = Lever(ratio=-1.0)

    def equations(self) -> Equations:
        yield connect(self.port_a, self.cylinder.port_a)
        yield connect(self.port_b, self.cylinder.port_b)
        yield connect(self.cylinder.flange, self.lever.flange_a)
        yield connect(self.lever.flange_b, self.flange)


class FourChambers(RodOfCylinder):
    """Two cylinders on one rod: chambers a and c extend it, b and d retract it; all of them leak into each other."""

    port_c = HydraulicPort()
    port_d = HydraulicPort()
    second: Cylinder = Cylinder(inertia=False)
    leaks: tuple[tuple[int, int, float], ...] = ()

    def build(self) -> None:
        self.leak = [LinearResistance(R=1 / conductance) for _, _, conductance in self.leaks]

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.port_c, self.second.port_a)
        yield connect(self.port_d, self.second.port_b)
        yield connect(self.second.flange, self.lever.flange_a)
        ports = (self.port_a, self.port_b, self.port_c, self.port_d)
        for leak, (one, other, _) in zip(self.leak, self.leaks, strict=True):
            yield connect(ports[one], leak.port_a)
            yield connect(leak.port_b, ports[other])


class LineVolume(Component):
    """A volume between two ports as Hopsan's transmission line of one time step: two halves, and the line's inertance.

    That inertance, beta step^2/V, is the reference's, not the oil's: a piston of area A beside the volume is heavier
    by A^2 times as much. ``bypass`` damps the ringing of the halves, as Hopsan's filter does.
    """

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    fluid: Fluid = Fluid()
    half_a: Volume = Volume(V=1e-3)
    half_b: Volume = Volume(V=1e-3)
    segment: LineSegment = LineSegment(L=1.0, d=0.01, friction="none")
    bypass: LinearResistance = LinearResistance(R=1e9)

    def equations(self) -> Equations:
        yield connect(self.port_a, self.half_a.port)
        yield connect(self.port_b, self.half_b.port)
        for between in self.segment, self.bypass:
            yield connect(self.half_a.port, between.port_a)
            yield connect(between.port_b, self.half_b.port)


class GasAccumulator(Component):
    """An accumulator behind a laminar inlet; the volume ``V_g`` and the pressure ``p`` of its gas are signals."""

    port = HydraulicPort()
    fluid: Fluid = Fluid()
    inlet: LinearResistance = LinearResistance(R=1e8)
    accumulator: Accumulator = Accumulator(V_0=1e-3, p_pre=1e7)
    V_g: Real = real_output("m^3")
    p: Real = real_output("Pa")

    def equations(self) -> Equations:
        yield connect(self.port, self.inlet.port_a)
        yield connect(self.inlet.port_b, self.accumulator.port)
        gas = self.accumulator
        yield self.V_g == gas.V_g
        yield "gas", self.p == gas.p_pre * (gas.V_0 / gas.V_g) ** gas.n


class LoadedMotor(Component):
    """A motor with the inertia of its load."""

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    flange = rotational.Flange()
    fluid: Fluid = Fluid()
    setting: Real = real_input("1", default=1.0)
    motor: HydraulicMotor = HydraulicMotor(D=1e-5)
    inertia: rotational.Inertia = rotational.Inertia(J=0.1)

    def equations(self) -> Equations:
        yield connect(self.port_a, self.motor.port_a)
        yield connect(self.port_b, self.motor.port_b)
        yield connect(self.setting, self.motor.setting)
        yield connect(self.motor.flange, self.inertia.flange_a)
        yield connect(self.inertia.flange_b, self.flange)


class MachineWithVolumes(Component):
    """A motor or pump with a volume at either port, whose shaft's coordinate runs against the driven inertia's."""

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    flange = rotational.Flange()
    fluid: Fluid = Fluid()
    setting: Real = real_input("1", default=1.0)
    motor: HydraulicMotor = HydraulicMotor(D=1e-5)
    volume_a: Volume = Volume(V=1e-3)
    volume_b: Volume = Volume(V=1e-3)
    gear = rotational.IdealGear(ratio=-1.0)

    def equations(self) -> Equations:
        yield connect(self.setting, self.motor.setting)
        yield connect(self.port_a, self.volume_a.port)
        yield connect(self.port_b, self.volume_b.port)
        yield connect(self.port_a, self.motor.port_a)
        yield connect(self.port_b, self.motor.port_b)
        yield connect(self.motor.flange, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.flange)


class TwoEndedInertia(Component):
    """An inertia with friction; ``back`` at the end that turns against its angle."""

    flange = rotational.Flange()
    back = rotational.Flange()
    inertia: rotational.Inertia = rotational.Inertia(J=1.0)
    damper: rotational.Damper = rotational.Damper(d=0.0)
    ground = rotational.Fixed()
    gear = rotational.IdealGear(ratio=-1.0)

    def equations(self) -> Equations:
        yield connect(self.flange, self.inertia.flange_a)
        yield connect(self.ground.flange, self.damper.flange_a)
        yield connect(self.damper.flange_b, self.inertia.flange_b)
        yield connect(self.inertia.flange_b, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.back)


class TwoEndedSpring(Component):
    """A spring between two bodies, each of which counts its position towards the spring."""

    flange_a = Flange()
    flange_b = Flange()
    spring: Spring = Spring(c=0.0)
    lever = Lever(ratio=-1.0)

    def equations(self) -> Equations:
        yield connect(self.flange_a, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.lever.flange_a)
        yield connect(self.lever.flange_b, self.flange_b)


class LoadTorque(Component):
    """A torque ``T`` [N m] that turns the connected inertia back."""

    flange = rotational.Flange()
    T: Real = real_input("N*m", default=0.0)
    source = rotational.TorqueSource()
    sign: Gain = Gain.of("N*m")(k=-1.0)

    def equations(self) -> Equations:
        yield connect(self.T, self.sign.u)
        yield connect(self.sign.y, self.source.tau)
        yield connect(self.source.flange, self.flange)
