"""Examples of the Modelica Standard Library 4.1.0, Electrical.Analog: transistors, thyristors, active filters.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from collections.abc import Callable

from arthur_acausal import Component, Equations, Real, connect, parameter, start
from arthur_acausal.components.blocks import Not, Pulse, TimeTable
from arthur_acausal.components.electrical import (
    NMOS,
    PMOS,
    Capacitor,
    ExpSineVoltage,
    Ground,
    HeatingNPN,
    HeatingPNP,
    IdealGTOThyristor,
    IdealOpAmp,
    IdealThyristor,
    IdealTwoWaySwitch,
    Pin,
    RampCurrent,
    RampVoltage,
    Resistor,
    SineVoltage,
    StepVoltage,
    TrapezoidVoltage,
    VoltageSensor,
)
from arthur_acausal.components.thermal import FixedTemperature, HeatCapacitor, ThermalConductor
from arthur_acausal.models.conformance.case import Case, precise


class Transistor(Component):
    """A transistor with resistors at base and collector, and a capacitor at the base."""

    c = Pin()
    b = Pin()
    e = Pin()
    rtb = Resistor(R=0.05)
    rtc = Resistor(R=0.1)
    ct = Capacitor(C=1e-10, v=start(0.0, fixed=True))
    Tr = HeatingNPN(use_heat_port=False)
    Ground1 = Ground()

    def equations(self) -> Equations:
        yield connect(self.b, self.rtb.pin_p)
        yield connect(self.rtb.pin_n, self.Tr.base)
        yield connect(self.rtb.pin_n, self.ct.pin_p)
        yield connect(self.ct.pin_n, self.Ground1.pin)
        yield connect(self.Tr.collector, self.rtc.pin_p)
        yield connect(self.rtc.pin_n, self.c)
        yield connect(self.Tr.emitter, self.e)


class DifferenceAmplifier(Component):
    """Two transistors amplify the difference of two voltages, in nanoseconds (DifferenceAmplifier)."""

    V1 = ExpSineVoltage(V=0.2, f=0.2e9, damping=0.1e8)
    V2 = RampVoltage(V=15.0, duration=1e-9)
    I1 = RampCurrent(I=0.16, duration=1e-9)
    R1 = Resistor(R=1e-4)
    R2 = Resistor(R=100.0)
    R3 = Resistor(R=1e-4)
    R4 = Resistor(R=100.0)
    Transistor1 = Transistor()
    Transistor2 = Transistor()
    Gnd = Ground()

    def build(self) -> None:
        capacitors = [Capacitor(C=1e-10, v=start(0.0, fixed=True)) for _ in range(5)]
        self.C1, self.C2, self.C3, self.C4, self.C5 = capacitors

    def equations(self) -> Equations:
        one, two, zero = self.Transistor1, self.Transistor2, self.Gnd.pin
        pins = (self.V1.pin_n, self.C1.pin_n, self.I1.pin_n, self.C5.pin_n, self.C3.pin_n, self.R3.pin_n)
        for pin in (*pins, self.C2.pin_n, self.C4.pin_p, self.V2.pin_n):
            yield connect(pin, zero)
        yield connect(self.V1.pin_p, self.R1.pin_p)
        yield connect(self.R1.pin_n, one.b)
        yield connect(one.b, self.C1.pin_p)
        yield connect(one.c, self.C2.pin_p)
        yield connect(self.R2.pin_n, one.c)
        yield connect(one.e, self.I1.pin_p)
        yield connect(self.I1.pin_p, self.C5.pin_p)
        yield connect(self.R2.pin_p, self.V2.pin_p)
        yield connect(self.R4.pin_p, self.V2.pin_p)
        yield connect(two.b, self.R3.pin_p)
        yield connect(two.b, self.C3.pin_p)
        yield connect(self.C4.pin_n, two.c)
        yield connect(self.R4.pin_n, two.c)
        yield connect(self.C5.pin_p, two.e)


class Nand(Component):
    """A NAND gate of two p-channel and two n-channel transistors."""

    x1 = Pin()
    x2 = Pin()
    y = Pin()
    Vdd = Pin()
    TP1 = PMOS(W=6.5e-6, L=3.1e-6, K5=0.8385)
    TP2 = PMOS(W=6.5e-6, L=3.1e-6, K5=0.8385)
    TN1 = NMOS(W=6.5e-6, L=3.1e-6)
    TN2 = NMOS(W=6.5e-6, L=3.1e-6)
    C4 = Capacitor(C=0.4e-13, v=start(0.0, fixed=True))
    C7 = Capacitor(C=0.4e-13, v=start(0.0, fixed=True))
    Gnd = Ground()

    def equations(self) -> Equations:
        for pin in (self.TN2.bulk, self.TN2.source, self.TN1.bulk, self.TP1.bulk, self.TP2.bulk):
            yield connect(pin, self.Gnd.pin)
        yield connect(self.C4.pin_n, self.Gnd.pin)
        yield connect(self.C7.pin_n, self.Gnd.pin)
        yield connect(self.TN1.source, self.TN2.drain)
        yield connect(self.TN2.drain, self.C7.pin_p)
        for pin in (self.TP1.source, self.TP2.source, self.C4.pin_p, self.y):
            yield connect(self.TN1.drain, pin)
        for pin in (self.TP2.gate, self.TN2.gate):
            yield connect(self.x1, pin)
        for pin in (self.TP1.gate, self.TN1.gate):
            yield connect(self.x2, pin)
        yield connect(self.Vdd, self.TP1.drain)
        yield connect(self.Vdd, self.TP2.drain)


class NandGate(Component):
    """A NAND gate with two trapezoids at its inputs, in nanoseconds (NandGate)."""

    VIN1 = TrapezoidVoltage(V=3.5, start_time=20e-9, rising=1e-9, width=19e-9, falling=1e-9, period=40e-9)
    VIN2 = TrapezoidVoltage(V=3.5, start_time=10e-9, rising=1e-9, width=19e-9, falling=1e-9, period=40e-9)
    VDD = RampVoltage(V=5.0, duration=1e-9)
    Nand = Nand()
    Gnd = Ground()

    def equations(self) -> Equations:
        for source, pin in ((self.VIN1, self.Nand.x1), (self.VIN2, self.Nand.x2), (self.VDD, self.Nand.Vdd)):
            yield connect(source.pin_n, self.Gnd.pin)
            yield connect(source.pin_p, pin)


class HeatingMOSInverter(Component):
    """An inverter of two transistors that heat a body (HeatingMOSInverter)."""

    Sin = SineVoltage(V=5.0, f=1.0)
    Capacitor1 = Capacitor(C=1e-5, v=start(0.0, fixed=True))
    HeatCapacitor1 = HeatCapacitor(C=0.01, T=start(293.15, fixed=True))
    H_PMOS = PMOS(use_heat_port=True)
    H_NMOS = NMOS(use_heat_port=True)
    V = RampVoltage(V=5.0, duration=1e-2)
    TC1 = ThermalConductor(G=0.01)
    TC2 = ThermalConductor(G=0.01)
    TC3 = ThermalConductor(G=0.01)
    FixedTemperature1 = FixedTemperature(T=300.0)
    G = Ground()

    def equations(self) -> Equations:
        p, n, zero = self.H_PMOS, self.H_NMOS, self.G.pin
        for pin in (self.Sin.pin_n, self.Capacitor1.pin_n, n.bulk, n.source, self.V.pin_n):
            yield connect(pin, zero)
        yield connect(self.Sin.pin_p, n.gate)
        yield connect(self.Sin.pin_p, p.gate)
        yield connect(p.source, n.drain)
        yield connect(n.drain, self.Capacitor1.pin_p)
        yield connect(p.bulk, p.drain)
        yield connect(self.V.pin_p, p.drain)
        yield connect(p.heat_port, self.TC1.port_a)
        yield connect(n.heat_port, self.TC2.port_a)
        yield connect(self.TC3.port_b, self.FixedTemperature1.port)
        for port in (self.TC1.port_b, self.TC2.port_b, self.TC3.port_a):
            yield connect(self.HeatCapacitor1.port, port)


def nor_transistor(kind: type[HeatingNPN]) -> HeatingNPN:
    """Return a transistor of the gates: no Early effect, no charge."""
    return kind(
        charge=False,
        beta_F=100.0,
        beta_R=1.0,
        Is=1e-14,
        V_A_inverse=0.0,
        G_BC=1e-12,
        G_BE=1e-12,
        max_exp=40.0,
    )


class HeatingNPNGate(Component):
    """Two transistors make a NOR gate and heat a body (HeatingNPN_NORGate).

    The example's capacitors are zero: they are the places where their voltages are measured.
    """

    _polarity = 1.0
    HeatCapacitor1 = HeatCapacitor(C=0.1, T=start(293.15, fixed=True))
    TC1 = ThermalConductor(G=0.01)
    TC2 = ThermalConductor(G=0.01)
    R1 = Resistor(R=1800.0)
    R2 = Resistor(R=1800.0)
    RI = Resistor(R=40.0)
    C1 = VoltageSensor()
    C2 = VoltageSensor()
    C3 = VoltageSensor()
    Gnd = Ground()

    def build(self) -> None:
        p = self._polarity
        self.V = RampVoltage(V=6.0 * p, duration=5.0)
        self.V1, self.V2 = [
            TrapezoidVoltage(V=6.0 * p, start_time=t, rising=5.0, width=15.0, falling=5.0, period=50.0)
            for t in (55.0, 65.0)
        ]
        kind = HeatingNPN if p > 0 else HeatingPNP
        self.T1, self.T2 = nor_transistor(kind), nor_transistor(kind)

    def equations(self) -> Equations:
        zero = self.Gnd.pin
        for source in (self.V, self.V1, self.V2, self.C1, self.C2, self.C3):
            yield connect(source.pin_n, zero)
        inputs = (
            (self.V1, self.R1, self.T1, self.C1, self.TC1),
            (self.V2, self.R2, self.T2, self.C3, self.TC2),
        )
        for source, resistor, transistor, sensor, conductor in inputs:
            yield connect(source.pin_p, resistor.pin_p)
            yield connect(resistor.pin_n, transistor.base)
            yield connect(resistor.pin_n, sensor.pin_p)
            yield connect(transistor.emitter, zero)
            yield connect(transistor.collector, self.RI.pin_p)
            yield connect(transistor.heat_port, conductor.port_a)
            yield connect(conductor.port_b, self.HeatCapacitor1.port)
        yield connect(self.RI.pin_p, self.C2.pin_p)
        yield connect(self.RI.pin_n, self.V.pin_p)


class HeatingPNPGate(HeatingNPNGate):
    """The same with PNP transistors and negative voltages (HeatingPNP_NORGate)."""

    _polarity = -1.0


FIRED = (1.25, 3.2, 4.2, 4.25, 5.7, 5.72)


class CharacteristicThyristors(Component):
    """Thyristors with and without turn-off, fired now and then, and by pulses (CharacteristicThyristors)."""

    SineVoltage1 = SineVoltage(V=10.0, f=1.0)
    booleanStep1 = TimeTable(
        times=tuple(t for t in FIRED for _ in "ab"),
        values=tuple(float((k + b) % 2) for k in range(6) for b in (0, 1)),
        events=True,
    )
    booleanPulse = Pulse(duty=0.2, period=1.0, start_time=0.15)
    IdealThyristor1 = IdealThyristor(Vknee=1.0)
    IdealThyristor2 = IdealThyristor(Vknee=1.0)
    IdealGTOThyristor1 = IdealGTOThyristor(Vknee=1.0)
    IdealGTOThyristor2 = IdealGTOThyristor(Vknee=1.0)
    Ground1 = Ground()

    def build(self) -> None:
        self.R1, self.R2, self.R3, self.R4 = [Resistor(R=1e-3) for _ in range(4)]

    def equations(self) -> Equations:
        yield connect(self.SineVoltage1.pin_n, self.Ground1.pin)
        for thyristor, resistor, signal in (
            (self.IdealThyristor1, self.R3, self.booleanStep1.y),
            (self.IdealGTOThyristor1, self.R1, self.booleanStep1.y),
            (self.IdealThyristor2, self.R2, self.booleanPulse.y),
            (self.IdealGTOThyristor2, self.R4, self.booleanPulse.y),
        ):
            yield connect(signal, thyristor.fire)
            yield connect(self.SineVoltage1.pin_p, thyristor.pin_p)
            yield connect(thyristor.pin_n, resistor.pin_p)
            yield connect(resistor.pin_n, self.Ground1.pin)


class SwitchedCapacitor(Component):
    """A capacitor that is switched to and fro: it conducts like the resistance ``R`` [ohm], which may be negative."""

    pin_p = Pin()
    pin_n = Pin()
    positive: bool = True
    clock: Real = parameter("s", default=0.1, min=0.0)
    R: Real = parameter("ohm", default=1.0, min=0.0, description="amount of the resistance")
    BooleanPulse = Pulse(period=lambda self: self.clock)
    inverter = Not()
    Capacitor = Capacitor(C=lambda self: self.clock / self.R, v=start(0.0, fixed=True))
    IdealCommutingSwitch1 = IdealTwoWaySwitch()
    IdealCommutingSwitch2 = IdealTwoWaySwitch()
    ground = Ground()

    def equations(self) -> Equations:
        left, right = self.IdealCommutingSwitch1, self.IdealCommutingSwitch2
        yield connect(left.pin_p, self.Capacitor.pin_p)
        yield connect(self.Capacitor.pin_n, right.pin_p)
        for switch, pin in ((left, self.pin_p), (right, self.pin_n)):
            yield connect(switch.pin_n1, pin)
            yield connect(switch.pin_n2, self.ground.pin)
        yield connect(self.BooleanPulse.y, self.inverter.u)
        yield connect(self.BooleanPulse.y, right.control)
        yield connect(self.BooleanPulse.y if self.positive else self.inverter.y, left.control)


class CauerLowPassOPV(Component):
    """The Cauer filter with operational amplifiers, two integrators and three sums of them (CauerLowPassOPV)."""

    _sixth = "R6"
    V = StepVoltage(V=1.0, start_time=1.0)
    G = Ground()

    def build(self) -> None:
        l1, l2 = 1.304, 0.8586
        c2, c4 = 1 / (1.704992**2 * l1), 1 / (1.179945**2 * l2)
        values = (1.072 + c2, c2, l1, c4, c2, c2 + 1.682 + c4, l2, c4, c4 + 0.7262)
        free = (5, 6, 8, 9)  # that follow from the others
        capacitors = [
            Capacitor(C=C) if k in free else Capacitor(C=C, v=start(0.0, fixed=True))
            for k, C in enumerate(values, start=1)
        ]
        self.C1, self.C2, self.C3, self.C4, self.C5, self.C6, self.C7, self.C8, self.C9 = capacitors
        self.Op1, self.Op2, self.Op3, self.Op4, self.Op5 = [IdealOpAmp() for _ in range(5)]
        self.resistors(lambda sign: Resistor(R=sign))

    def resistors(self, kind: Callable[[float], Resistor | SwitchedCapacitor]) -> None:
        """Make the resistors: R4, R5, R8, R9 are negative."""
        for k in range(1, 12):
            setattr(self, self._sixth if k == 6 else f"R{k}", kind(-1.0 if k in (4, 5, 8, 9) else 1.0))

    def equations(self) -> Equations:
        outs = [op.out for op in (self.Op1, self.Op2, self.Op3, self.Op4, self.Op5)]
        nodes = [op.in_n for op in (self.Op1, self.Op2, self.Op3, self.Op4, self.Op5)]
        for op in (self.Op1, self.Op2, self.Op3, self.Op4, self.Op5):
            yield connect(op.in_p, self.G.pin)
        yield connect(self.V.pin_p, self.G.pin)
        elements = {f"R{k}": getattr(self, self._sixth if k == 6 else f"R{k}") for k in range(1, 12)}
        elements |= {f"C{k}": getattr(self, f"C{k}") for k in range(1, 10)}
        for name, p, n in (
            ("R1", self.V.pin_n, nodes[0]),
            ("R2", outs[1], nodes[0]),
            ("R3", nodes[0], outs[0]),
            ("C1", nodes[0], outs[0]),
            ("C2", outs[2], nodes[0]),
            ("R4", outs[0], nodes[1]),
            ("R5", outs[2], nodes[1]),
            ("C3", nodes[1], outs[1]),
            ("R6", outs[3], nodes[2]),
            ("R7", outs[1], nodes[2]),
            ("C5", outs[0], nodes[2]),
            ("C4", outs[4], nodes[2]),
            ("C6", nodes[2], outs[2]),
            ("R8", outs[4], nodes[3]),
            ("R9", outs[2], nodes[3]),
            ("C7", nodes[3], outs[3]),
            ("R10", outs[3], nodes[4]),
            ("C8", outs[2], nodes[4]),
            ("C9", nodes[4], outs[4]),
            ("R11", nodes[4], outs[4]),
        ):
            yield connect(elements[name].pin_p, p)
            yield connect(elements[name].pin_n, n)


class CauerLowPassSC(CauerLowPassOPV):
    """The same with switched capacitors in place of the resistors (CauerLowPassSC)."""

    _sixth = "Rp1"

    def resistors(self, kind: Callable[[float], Resistor | SwitchedCapacitor]) -> None:
        super().resistors(lambda sign: SwitchedCapacitor(positive=sign > 0))


_E = "msl_Electrical_Analog_"
_CASES = (
    Case(f"{_E}DifferenceAmplifier", DifferenceAmplifier, {}, 1e-8, precise(2000)),
    Case(f"{_E}NandGate", NandGate, {}, 1e-7, precise(5000)),
    Case(f"{_E}HeatingMOSInverter", HeatingMOSInverter, {}, 5.0, precise(5000)),
    Case(f"{_E}HeatingNPN_NORGate", HeatingNPNGate, {}, 200.0, precise(5000)),
    Case(f"{_E}HeatingPNP_NORGate", HeatingPNPGate, {}, 200.0, precise(5000)),
    Case(f"{_E}CharacteristicThyristors", CharacteristicThyristors, {}, 6.0, precise(5000)),
    Case(f"{_E}CauerLowPassOPV", CauerLowPassOPV, {}, 60.0, precise(5000)),
    Case(f"{_E}CauerLowPassOPVWithoutNodes", CauerLowPassOPV, {}, 60.0, precise(5000)),
    Case(f"{_E}CauerLowPassSC", CauerLowPassSC, {}, 60.0, precise(10000)),
)
CASES: dict[str, Case] = {case.name: case for case in _CASES}
