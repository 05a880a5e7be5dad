"""Examples of the Modelica Standard Library 4.1.0, Electrical.Analog, built from the library.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, connect, parameter, start
from arthur_acausal.components.electrical import (
    Capacitor,
    Ground,
    HeatingDiode,
    IdealDiode,
    Inductor,
    Resistor,
    SineVoltage,
    StepVoltage,
)
from arthur_acausal.components.thermal import HeatCapacitor, ThermalConductor
from arthur_acausal.models.conformance.case import Case


class CauerLowPass(Component):
    """A Cauer low-pass filter of fifth order as a ladder of coils and capacitors, and a step (CauerLowPassAnalog)."""

    l1: Real = parameter("H", default=1.304)
    l2: Real = parameter("H", default=0.8586)
    zero_1: Real = parameter("rad/s", default=1.704992, description="first zero of the transfer function")
    zero_2: Real = parameter("rad/s", default=1.179945, description="second zero of the transfer function")
    G = Ground()
    V = StepVoltage(V=1.0, start_time=1.0)
    R1 = Resistor(R=1.0)
    R2 = Resistor(R=1.0)
    L1 = Inductor(L=lambda self: self.l1, i=start(0.0, fixed=True))
    L2 = Inductor(L=lambda self: self.l2, i=start(0.0, fixed=True))
    C1 = Capacitor(C=1.072, v=start(0.0, fixed=True))
    C2 = Capacitor(C=lambda self: 1 / (self.zero_1**2 * self.l1))
    C3 = Capacitor(C=1.682, v=start(0.0, fixed=True))
    C4 = Capacitor(C=lambda self: 1 / (self.zero_2**2 * self.l2))
    C5 = Capacitor(C=0.7262, v=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.V.pin_p, self.R1.pin_p)
        yield connect(self.R1.pin_n, self.C1.pin_p)
        for first, last in ((self.C1, self.C3), (self.C3, self.C5)):
            coil, beside = (self.L1, self.C2) if first is self.C1 else (self.L2, self.C4)
            yield connect(first.pin_p, coil.pin_p)
            yield connect(coil.pin_p, beside.pin_p)
            yield connect(coil.pin_n, beside.pin_n)
            yield connect(coil.pin_n, last.pin_p)
        yield connect(self.C5.pin_p, self.R2.pin_p)
        for element in (self.V, self.C1, self.C3, self.C5, self.R2):
            yield connect(element.pin_n, self.G.pin)


class CharacteristicIdealDiodes(Component):
    """Three ideal diodes, each between a sine and a small resistor (CharacteristicIdealDiodes)."""

    Ground1 = Ground()
    Ideal = IdealDiode(Ron=0.0, Goff=0.0)
    With_Ron_Goff = IdealDiode(Ron=0.1, Goff=0.1)
    With_Ron_Goff_Vknee = IdealDiode(Ron=0.2, Goff=0.2, Vknee=5.0)
    SineVoltage1 = SineVoltage(V=10.0, offset=-9.0, f=1.0)
    SineVoltage2 = SineVoltage(V=10.0, f=1.0)
    SineVoltage3 = SineVoltage(V=10.0, f=1.0)
    R1 = Resistor(R=1e-3)
    R2 = Resistor(R=1e-3)
    R3 = Resistor(R=1e-3)

    def equations(self) -> Equations:
        branches = (
            (self.SineVoltage2, self.Ideal, self.R1),
            (self.SineVoltage1, self.With_Ron_Goff, self.R2),
            (self.SineVoltage3, self.With_Ron_Goff_Vknee, self.R3),
        )
        for source, diode, resistor in branches:
            yield connect(source.pin_p, diode.pin_p)
            yield connect(diode.pin_n, resistor.pin_p)
            yield connect(resistor.pin_n, self.Ground1.pin)
            yield connect(source.pin_n, self.Ground1.pin)


class HeatingRectifier(Component):
    """A diode charges a capacitor with a load and heats a body (HeatingRectifier)."""

    G = Ground()
    SineVoltage1 = SineVoltage(V=1.0, f=1.0)
    HeatingDiode1 = HeatingDiode()
    Capacitor1 = Capacitor(C=1.0, v=start(0.0, fixed=True))
    R = Resistor(R=1.0)
    ThermalConductor1 = ThermalConductor(G=10.0)
    HeatCapacitor1 = HeatCapacitor(C=1.0, T=start(293.15, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.SineVoltage1.pin_p, self.HeatingDiode1.pin_p)
        yield connect(self.HeatingDiode1.pin_n, self.Capacitor1.pin_p)
        yield connect(self.Capacitor1.pin_p, self.R.pin_p)
        for element in (self.SineVoltage1, self.Capacitor1, self.R):
            yield connect(element.pin_n, self.G.pin)
        yield connect(self.HeatingDiode1.heat_port, self.ThermalConductor1.port_a)
        yield connect(self.ThermalConductor1.port_b, self.HeatCapacitor1.port)


def _same(*names: str) -> dict[str, str]:
    return {name: name for name in names}


_CASES = (
    Case(
        "msl_Electrical_Analog_CauerLowPassAnalog",
        CauerLowPass,
        _same("C1.v", "C3.v", "C5.v", "L1.i", "L2.i"),
        60.0,
    ),
    Case(
        "msl_Electrical_Analog_CharacteristicIdealDiodes",
        CharacteristicIdealDiodes,
        _same("Ideal.v", "With_Ron_Goff.v", "With_Ron_Goff_Vknee.v"),
        1.0,
    ),
    Case(
        "msl_Electrical_Analog_HeatingRectifier",
        HeatingRectifier,
        _same("Capacitor1.v", "HeatCapacitor1.T"),
        5.0,
    ),
)
CASES: dict[str, Case] = {case.name: case for case in _CASES}
