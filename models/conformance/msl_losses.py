"""Examples of the Modelica Standard Library 4.1.0, Mechanics: where elements lose power as heat.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from arthur_acausal import Component, Equations, connect, start
from arthur_acausal.components import rotational, translational
from arthur_acausal.components.blocks import Constant, Sine
from arthur_acausal.components.rotational import (
    ElastoBacklash,
    Inertia,
    LossyGear,
    OneWayClutch,
    TorqueSource,
)
from arthur_acausal.components.thermal import Convection, FixedTemperature, HeatPort
from arthur_acausal.components.translational import (
    ElastoGap,
    ForceSource,
    MassWithStopAndFriction,
    SlidingMass,
    SupportFriction,
)
from arthur_acausal.models.conformance.case import Case, precise


class _HeatLosses(Component):
    """What both examples HeatLosses share: the heat of all elements passes by convection to the ambient."""

    convection = Convection()
    TAmbient = FixedTemperature(T=298.15)
    const: Constant = Constant.of("W/K")(k=20.0)

    def warming(self, *ports: HeatPort) -> Equations:
        """Yield the thermal part: what joins the heat ports of the elements with the convection."""
        for port in ports:
            yield connect(port, self.convection.port_a)
        yield connect(self.const.y, self.convection.Gc)
        yield connect(self.convection.port_b, self.TAmbient.port)


class HeatLosses(_HeatLosses):
    """A drive train of all elements that turn power to heat (Rotational.HeatLosses).

    Several elements may be stuck at once; each has a creep of 1e-9, so that they share what they hold.
    """

    sine: Sine = Sine.of("N*m")(amplitude=20.0, f=5.0)
    sine2 = Sine(f=0.2)
    torque = TorqueSource()
    damper = rotational.Damper(use_heat_port=True, d=10.0)
    fixed = rotational.Fixed()
    springDamper = rotational.SpringDamper(use_heat_port=True, c=1e4, d=20.0)
    elastoBacklash = ElastoBacklash(use_heat_port=True, c=1e5, d=100.0, b=1e-3)
    bearingFriction = rotational.BearingFriction(use_heat_port=True)
    spring3 = rotational.Spring(c=1e4)
    lossyGear = LossyGear(
        use_heat_port=True,
        ratio=2.0,
        losses=((0.0, 0.8, 0.8, 1.0, 1.0), (1.0, 0.7, 0.7, 2.0, 2.0)),
        creep=1e-9,
    )
    clutch = rotational.Clutch(
        use_heat_port=True,
        f_n_max=10.0,
        phi_rel=start(0.0, fixed=True),
        w_rel=start(0.0, fixed=True),
        creep=1e-9,
    )
    oneWayClutch = OneWayClutch(
        use_heat_port=True, f_n_max=1.0, phi_rel=start(0.0, fixed=True), w_rel=start(0.0, fixed=True)
    )
    brake = rotational.Brake(use_heat_port=True, f_n_max=2.0, creep=1e-9)

    def build(self) -> None:
        wheels = [Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)) for _ in range(4)]
        self.inertia1, self.inertia2, self.inertia3, self.inertia4 = wheels
        self.inertia5, self.inertia6 = Inertia(J=2.0), Inertia(J=2.0)

    def equations(self) -> Equations:
        yield connect(self.sine.y, self.torque.tau)
        for element in (self.clutch, self.oneWayClutch, self.brake):
            yield connect(self.sine2.y, element.f_normalized)
        yield connect(self.torque.flange, self.inertia1.flange_a)
        yield connect(self.inertia1.flange_b, self.damper.flange_b)
        yield connect(self.damper.flange_a, self.fixed.flange)
        yield connect(self.inertia1.flange_b, self.springDamper.flange_a)
        yield connect(self.springDamper.flange_b, self.inertia2.flange_a)
        yield connect(self.inertia2.flange_b, self.elastoBacklash.flange_a)
        yield connect(self.elastoBacklash.flange_b, self.inertia3.flange_a)
        yield connect(self.inertia3.flange_b, self.bearingFriction.flange_a)
        yield connect(self.bearingFriction.flange_b, self.spring3.flange_a)
        yield connect(self.spring3.flange_b, self.inertia4.flange_a)
        yield connect(self.inertia4.flange_b, self.lossyGear.flange_a)
        yield connect(self.lossyGear.flange_b, self.clutch.flange_a)
        yield connect(self.clutch.flange_b, self.inertia5.flange_a)
        yield connect(self.inertia5.flange_b, self.oneWayClutch.flange_a)
        yield connect(self.oneWayClutch.flange_b, self.inertia6.flange_a)
        yield connect(self.inertia6.flange_b, self.brake.flange_a)
        yield from self.warming(
            self.damper.heat_port,
            self.springDamper.heat_port,
            self.elastoBacklash.heat_port,
            self.bearingFriction.heat_port,
            self.lossyGear.heat_port,
            self.clutch.heat_port,
            self.oneWayClutch.heat_port,
            self.brake.heat_port,
        )


class SlidingHeatLosses(_HeatLosses):
    """A train of all sliding elements that turn power to heat (Translational.HeatLosses)."""

    sine1: Sine = Sine.of("N")(amplitude=20.0, f=1.0)
    sine2 = Sine(amplitude=10.0, f=2.0)
    force = ForceSource()
    mass1 = SlidingMass(m=1.0, L=0.1, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    springDamper = translational.SpringDamper(
        use_heat_port=True, c=100.0, d=10.0, s_rel=start(0.0, fixed=True), v_rel=start(0.0, fixed=True)
    )
    damper = translational.Damper(use_heat_port=True, d=10.0)
    elastoGap = ElastoGap(use_heat_port=True, c=100.0, d=20.0, s_rel0=-0.02)
    fixed1 = translational.Fixed()
    fixed2 = translational.Fixed()
    mass2 = SlidingMass(m=1.0, L=0.1)
    supportFriction = SupportFriction(use_heat_port=True)
    spring = translational.Spring(c=100.0, s_rel=start(0.0, fixed=True))
    mass3 = SlidingMass(m=1.0, L=0.1, v=start(0.0, fixed=True))
    brake = translational.Brake(use_heat_port=True, f_n_max=10.0)
    springDamper1 = translational.SpringDamper(use_heat_port=True, c=1e4, d=1e3, s_rel=start(0.0, fixed=True))
    massWithStopAndFriction = MassWithStopAndFriction(
        use_heat_port=True,
        L=0.1,
        m=1.0,
        F_v=0.5,
        F_C=1.0,
        F_St=2.0,
        f_exp=2.0,
        s_min=0.0,
        s_max=0.4,
        v=start(0.0, fixed=True),
    )

    def equations(self) -> Equations:
        yield connect(self.sine1.y, self.force.f)
        yield connect(self.sine2.y, self.brake.f_normalized)
        yield connect(self.force.flange, self.mass1.flange_a)
        yield connect(self.mass1.flange_a, self.damper.flange_a)
        yield connect(self.damper.flange_b, self.fixed1.flange)
        yield connect(self.elastoGap.flange_b, self.mass1.flange_a)
        yield connect(self.elastoGap.flange_a, self.fixed2.flange)
        yield connect(self.mass1.flange_b, self.springDamper.flange_a)
        yield connect(self.springDamper.flange_b, self.mass2.flange_a)
        yield connect(self.mass2.flange_b, self.supportFriction.flange_a)
        yield connect(self.supportFriction.flange_b, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.mass3.flange_a)
        yield connect(self.mass3.flange_b, self.brake.flange_a)
        yield connect(self.brake.flange_b, self.springDamper1.flange_a)
        yield connect(self.springDamper1.flange_b, self.massWithStopAndFriction.flange_a)
        yield from self.warming(
            self.damper.heat_port,
            self.springDamper.heat_port,
            self.springDamper1.heat_port,
            self.elastoGap.heat_port,
            self.supportFriction.heat_port,
            self.brake.heat_port,
            self.massWithStopAndFriction.heat_port,
        )


CASES: dict[str, Case] = {
    case.name: case
    for case in (
        Case("msl_Mechanics_Rotational_HeatLosses", HeatLosses, {}, 1.0, precise(10000)),
        Case("msl_Mechanics_Translational_HeatLosses", SlidingHeatLosses, {}, 2.0, precise(4000)),
    )
}
