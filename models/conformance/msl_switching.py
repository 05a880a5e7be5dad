"""Examples of the Modelica Standard Library 4.1.0, Electrical.Analog: arcs, Zener diodes and a triac.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from arthur_acausal import Component, Equations, SolverOptions, connect, start
from arthur_acausal.components.blocks import (
    Pulse,
)
from arthur_acausal.components.electrical import (
    Capacitor,
    CloserWithArc,
    ConstantVoltage,
    ControlledCloserWithArc,
    ControlledIdealClosingSwitch,
    Ground,
    IdealClosingSwitch,
    IdealTriac,
    Inductor,
    Resistor,
    SineVoltage,
    TwoPin,
    ZenerDiode,
)
from arthur_acausal.models.conformance.case import Case


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


def _options(intervals: int) -> SolverOptions:
    return SolverOptions(rtol=1e-8, intervals=intervals)


_E = "msl_Electrical_Analog_"
_CASES = (
    Case(f"{_E}SwitchWithArc", SwitchWithArc, {}, 2.0, _options(8000)),
    Case(f"{_E}ControlledSwitchWithArc", ControlledSwitchWithArc, {}, 6.0, _options(24000)),
    Case(f"{_E}OvervoltageProtection", OvervoltageProtection, {}, 0.4, _options(5000)),
    Case(f"{_E}IdealTriacCircuit", IdealTriacCircuit, {}, 2.0, _options(5000)),
)
CASES: dict[str, Case] = {case.name: case for case in _CASES}
