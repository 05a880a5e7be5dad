"""Examples of the Modelica Standard Library 4.1.0, Electrical.Analog: switches, diodes, transformers.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from math import pi, sqrt

from casadi import SX

from arthur_acausal import Component, Equations, Real, SolverOptions, connect, parameter, start, variable
from arthur_acausal.components.blocks import (
    Constant,
    Pulse,
    Ramp,
)
from arthur_acausal.components.electrical import (
    Capacitor,
    ChuaDiode,
    CloserWithArc,
    Conductor,
    ConstantVoltage,
    ControlledCloserWithArc,
    ControlledIdealClosingSwitch,
    Ground,
    HeatingResistor,
    IdealClosingSwitch,
    IdealDiode,
    IdealTransformer,
    IdealTriac,
    Inductor,
    Resistor,
    SaturatingInductor,
    SignalCurrent,
    SineVoltage,
    Transformer,
    TwoPin,
    VariableResistor,
    ZenerDiode,
)
from arthur_acausal.components.thermal import FixedTemperature, ThermalConductor
from arthur_acausal.models.conformance.case import Case, precise


class ChuaCircuit(Component):
    """A circuit of chaotic behaviour, in nanoseconds (ChuaCircuit)."""

    L = Inductor(L=18.0, i=start(0.0, fixed=True))
    Ro = Resistor(R=12.5e-3)
    G = Conductor(G=0.565)
    C1 = Capacitor(C=10.0, v=start(4.0, fixed=True))
    C2 = Capacitor(C=100.0, v=start(0.0, fixed=True))
    Nr = ChuaDiode(G_a=-0.757576, G_b=-0.409091)
    Gnd = Ground()

    def equations(self) -> Equations:
        yield connect(self.L.pin_p, self.G.pin_p)
        yield connect(self.C2.pin_p, self.G.pin_p)
        yield connect(self.L.pin_n, self.Ro.pin_p)
        yield connect(self.G.pin_n, self.Nr.pin_p)
        yield connect(self.G.pin_n, self.C1.pin_p)
        for element in (self.Ro, self.C1, self.C2, self.Nr):
            yield connect(element.pin_n, self.Gnd.pin)


class Rectifier(Component):
    """A bridge of six diodes between three phases with inductors and a capacitor with a load (Rectifier)."""

    V_AC: Real = parameter("V", default=400.0, description="between phases, root of the mean square")
    L_AC: Real = parameter("H", default=60e-6)
    C_DC: Real = parameter("F", default=15e-3)
    Ground1 = Ground()
    SignalCurrent1 = SignalCurrent()
    Constant1: Constant = Constant.of("A")(k=500.0)
    Capacitor1 = Capacitor(
        C=lambda self: 2 * self.C_DC, v=start(lambda self: self.V_AC / sqrt(2), fixed=True)
    )
    Capacitor2 = Capacitor(
        C=lambda self: 2 * self.C_DC, v=start(lambda self: self.V_AC / sqrt(2), fixed=True)
    )
    uDC: Real = variable("V")
    Losses: Real = variable("W")

    def build(self) -> None:
        phases = [SineVoltage(V=self.V_AC * sqrt(2 / 3), f=50.0, phase=-2 * pi / 3 * k) for k in range(3)]
        self.SineVoltage1, self.SineVoltage2, self.SineVoltage3 = phases
        self.Inductor1 = Inductor(L=self.L_AC)
        self.Inductor2, self.Inductor3 = [Inductor(L=self.L_AC, i=start(0.0, fixed=True)) for _ in range(2)]
        diodes = [IdealDiode(Ron=1e-3, Goff=1e-3, Vknee=2.0) for _ in range(6)]
        self.IdealDiode1, self.IdealDiode2, self.IdealDiode3 = diodes[:3]
        self.IdealDiode4, self.IdealDiode5, self.IdealDiode6 = diodes[3:]

    def equations(self) -> Equations:
        sources = (self.SineVoltage1, self.SineVoltage2, self.SineVoltage3)
        inductors = (self.Inductor1, self.Inductor2, self.Inductor3)
        upper = (self.IdealDiode1, self.IdealDiode2, self.IdealDiode3)
        lower = (self.IdealDiode4, self.IdealDiode5, self.IdealDiode6)
        for source, inductor, up, down in zip(sources, inductors, upper, lower, strict=True):
            if source is not self.SineVoltage1:
                yield connect(source.pin_n, self.SineVoltage1.pin_n)
            yield connect(source.pin_p, inductor.pin_p)
            yield connect(inductor.pin_n, up.pin_p)
            yield connect(inductor.pin_n, down.pin_n)
            yield connect(up.pin_n, self.Capacitor1.pin_p)
            yield connect(down.pin_p, self.Capacitor2.pin_n)
        yield connect(self.Capacitor1.pin_n, self.Ground1.pin)
        yield connect(self.Capacitor2.pin_p, self.Ground1.pin)
        yield connect(self.Capacitor1.pin_p, self.SignalCurrent1.pin_p)
        yield connect(self.SignalCurrent1.pin_n, self.Capacitor2.pin_n)
        yield connect(self.Constant1.y, self.SignalCurrent1.I)
        yield self.uDC == self.Capacitor1.v + self.Capacitor2.v
        yield self.Losses == sum((d.P_loss for d in (*upper, *lower)), SX(0.0))


class CompareTransformers(Component):
    """Two coupled coils beside an ideal transformer with leakage inductances (CompareTransformers)."""

    n: Real = parameter("1", default=2.0)
    L1sigma: Real = parameter("H", default=0.05 / (20 * pi))
    L2sigma: Real = parameter("H", default=lambda self: self.L1sigma / self.n**2)
    M: Real = parameter("H", default=lambda self: 200 * self.L1sigma / self.n)
    sineVoltage1 = SineVoltage(V=0.1, f=10.0, phase=pi / 2, offset=0.1)
    sineVoltage2 = SineVoltage(V=0.1, f=10.0, phase=pi / 2, offset=0.1)
    resistor11 = Resistor(R=0.01)
    resistor21 = Resistor(R=0.01)
    resistor12 = Resistor(R=0.0025)
    resistor22 = Resistor(R=0.0025)
    load1 = Resistor(R=0.25)
    load2 = Resistor(R=0.25)
    basicTransformer = Transformer(
        L1=lambda self: self.L1sigma + self.M * self.n,
        L2=lambda self: self.L2sigma + self.M / self.n,
        M=lambda self: self.M,
        i1=start(0.0, fixed=True),
        i2=start(0.0, fixed=True),
    )
    inductor21 = Inductor(L=lambda self: self.L1sigma)
    inductor22 = Inductor(L=lambda self: self.L2sigma, i=start(0.0, fixed=True))
    idealTransformer = IdealTransformer(n=lambda self: self.n)
    ground = Ground()

    def equations(self) -> Equations:
        basic, ideal, zero = self.basicTransformer, self.idealTransformer, self.ground.pin
        for pin in (basic.pin_n1, basic.pin_n2, ideal.pin_n1, ideal.pin_n2):
            yield connect(pin, zero)
        for element in (self.sineVoltage1, self.sineVoltage2, self.load1, self.load2):
            yield connect(element.pin_n, zero)
        yield connect(self.sineVoltage1.pin_p, self.resistor11.pin_p)
        yield connect(self.resistor11.pin_n, basic.pin_p1)
        yield connect(basic.pin_p2, self.resistor12.pin_p)
        yield connect(self.resistor12.pin_n, self.load1.pin_p)
        yield connect(self.sineVoltage2.pin_p, self.resistor21.pin_p)
        yield connect(self.resistor21.pin_n, self.inductor21.pin_p)
        yield connect(self.inductor21.pin_n, ideal.pin_p1)
        yield connect(ideal.pin_p2, self.inductor22.pin_p)
        yield connect(self.inductor22.pin_n, self.resistor22.pin_p)
        yield connect(self.resistor22.pin_n, self.load2.pin_p)


class WarmResistor(Component):
    """A resistor that heats itself, on a sine (Resistor)."""

    resistor = HeatingResistor(R=100.0, T_ref=293.15, alpha=1e-3)
    G = Ground()
    SineVoltage1 = SineVoltage(V=220.0, f=1.0)
    thermalConductor = ThermalConductor(G=50.0)
    fixedTemperature = FixedTemperature(T=293.15)

    def equations(self) -> Equations:
        yield connect(self.SineVoltage1.pin_p, self.resistor.pin_p)
        yield connect(self.SineVoltage1.pin_n, self.G.pin)
        yield connect(self.resistor.pin_n, self.G.pin)
        yield connect(self.resistor.heat_port, self.thermalConductor.port_a)
        yield connect(self.thermalConductor.port_b, self.fixedTemperature.port)


class ShowSaturatingInductor(Component):
    """A saturating inductor beside a linear one (ShowSaturatingInductor)."""

    SineVoltage1 = SineVoltage(V=1.25, f=1 / (2 * pi), phase=pi / 2)
    SaturatingInductance1 = SaturatingInductor(
        L_zer=2.0, L_nom=1.0, I_nom=1.0, L_inf=0.5, i=start(0.0, fixed=True)
    )
    Inductance1 = Inductor(L=1.0, i=start(0.0, fixed=True))
    Ground1 = Ground()

    def equations(self) -> Equations:
        for element in (self.SaturatingInductance1, self.Inductance1):
            yield connect(element.pin_p, self.SineVoltage1.pin_p)
            yield connect(element.pin_n, self.SineVoltage1.pin_n)
        yield connect(self.SineVoltage1.pin_n, self.Ground1.pin)


class ShowVariableResistor(Component):
    """Two branches of three resistors, one of them varied by a ramp (ShowVariableResistor)."""

    VariableResistor = VariableResistor()
    Ground1 = Ground()
    SineVoltage1 = SineVoltage(V=1.0, f=1.0)
    Ramp1: Ramp = Ramp.of("ohm")(height=5.0, offset=2.0, duration=2.0)

    def build(self) -> None:
        self.R1, self.R2, self.R3, self.R4, self.R5 = [Resistor(R=1.0) for _ in range(5)]

    def equations(self) -> Equations:
        yield connect(self.SineVoltage1.pin_p, self.Ground1.pin)
        for branch in ((self.R1, self.R2, self.R3), (self.R4, self.VariableResistor, self.R5)):
            node = self.SineVoltage1.pin_n
            for element in branch:
                yield connect(node, element.pin_p)
                node = element.pin_n
            yield connect(node, self.Ground1.pin)
        yield connect(self.Ramp1.y, self.VariableResistor.R)


class _Switched(Component):
    """Two coils with resistors, each behind one of two switches."""

    def build(self) -> None:
        self.constantVoltage1, self.constantVoltage2 = [ConstantVoltage(V=50.0) for _ in range(2)]
        self.inductor1, self.inductor2 = [Inductor(L=0.1, i=start(0.0, fixed=True)) for _ in range(2)]
        self.resistor1, self.resistor2 = [Resistor(R=1.0) for _ in range(2)]
        self.ground1, self.ground2 = [Ground() for _ in range(2)]

    def circuits(self, switch1: TwoPin, switch2: TwoPin) -> Equations:
        """Yield the connections of both circuits."""
        for source, switch, inductor, resistor, ground in (
            (self.constantVoltage1, switch1, self.inductor1, self.resistor1, self.ground1),
            (self.constantVoltage2, switch2, self.inductor2, self.resistor2, self.ground2),
        ):
            yield connect(source.pin_p, switch.pin_p)
            yield connect(switch.pin_n, inductor.pin_p)
            yield connect(inductor.pin_n, resistor.pin_p)
            yield connect(resistor.pin_n, ground.pin)
            yield connect(source.pin_n, ground.pin)


class SwitchWithArc(_Switched):
    """Two coils with resistors, switched off without and with an arc (SwitchWithArc)."""

    booleanPulse = Pulse(period=1.0)
    switch1 = IdealClosingSwitch()
    switch2 = CloserWithArc()

    def equations(self) -> Equations:
        yield from self.circuits(self.switch1, self.switch2)
        yield connect(self.booleanPulse.y, self.switch1.control)
        yield connect(self.booleanPulse.y, self.switch2.control)


class ControlledSwitchWithArc(_Switched):
    """The same with switches that a voltage controls (ControlledSwitchWithArc)."""

    switch1 = ControlledIdealClosingSwitch()
    switch2 = ControlledCloserWithArc()
    sineVoltage = SineVoltage(V=1.0, f=1.0)
    ground = Ground()

    def equations(self) -> Equations:
        yield from self.circuits(self.switch1, self.switch2)
        yield connect(self.sineVoltage.pin_n, self.ground.pin)
        yield connect(self.sineVoltage.pin_p, self.switch1.control_pin)
        yield connect(self.sineVoltage.pin_p, self.switch2.control_pin)


class OvervoltageProtection(Component):
    """Two Zener diodes against each other hold the voltage of a load (OvervoltageProtection)."""

    sineVoltage = SineVoltage(V=10.0, f=5.0)
    Rv = Resistor(R=20.0)
    RL = Resistor(R=2000.0)
    CL = Capacitor(C=1e-7, v=start(0.0, fixed=True))
    zDiode = ZenerDiode()
    zDiode1 = ZenerDiode()
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.sineVoltage.pin_p, self.Rv.pin_p)
        for pin in (self.RL.pin_p, self.CL.pin_p, self.zDiode1.pin_p):
            yield connect(self.Rv.pin_n, pin)
        yield connect(self.zDiode1.pin_n, self.zDiode.pin_n)
        for pin in (self.sineVoltage.pin_n, self.RL.pin_n, self.CL.pin_n, self.zDiode.pin_p):
            yield connect(pin, self.ground.pin)


class IdealTriacCircuit(Component):
    """A triac cuts a sine, fired by pulses (IdealTriacCircuit)."""

    V = SineVoltage(V=5.0, f=2.0)
    R = Resistor(R=20.0)
    idealTriac = IdealTriac()
    booleanPulse = Pulse(duty=0.5, period=0.25, start_time=0.1)
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.V.pin_p, self.R.pin_p)
        yield connect(self.R.pin_n, self.idealTriac.pin_n)
        yield connect(self.idealTriac.pin_p, self.ground.pin)
        yield connect(self.V.pin_n, self.ground.pin)
        yield connect(self.booleanPulse.y, self.idealTriac.fire)


_E = "msl_Electrical_Analog_"

_CASES = (
    Case(f"{_E}ChuaCircuit", ChuaCircuit, {}, 5e4, SolverOptions(rtol=1e-10, intervals=50000)),
    Case(f"{_E}Rectifier", Rectifier, {}, 0.1, precise(10000)),
    Case(f"{_E}CompareTransformers", CompareTransformers, {}, 50.0, precise(50000)),
    Case(f"{_E}Resistor", WarmResistor, {}, 5.0),
    Case(f"{_E}ShowSaturatingInductor", ShowSaturatingInductor, {}, 6.2832, precise(2000)),
    Case(f"{_E}ShowVariableResistor", ShowVariableResistor, {}, 1.0, precise(2000)),
    Case(f"{_E}SwitchWithArc", SwitchWithArc, {}, 2.0, precise(8000)),
    Case(f"{_E}ControlledSwitchWithArc", ControlledSwitchWithArc, {}, 6.0, precise(24000)),
    Case(f"{_E}OvervoltageProtection", OvervoltageProtection, {}, 0.4, precise(5000)),
    Case(f"{_E}IdealTriacCircuit", IdealTriacCircuit, {}, 2.0, precise(5000)),
)
CASES: dict[str, Case] = {case.name: case for case in _CASES}
