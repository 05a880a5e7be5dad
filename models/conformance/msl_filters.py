"""Examples of the Modelica Standard Library 4.1.0, Electrical.Analog: filters with operational amplifiers.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from collections.abc import Callable

from arthur_acausal import Component, Equations, Real, SolverOptions, connect, parameter, start
from arthur_acausal.components.blocks import Not, Pulse
from arthur_acausal.components.electrical import (
    Capacitor,
    Ground,
    IdealOpAmp,
    IdealTwoWaySwitch,
    Pin,
    Resistor,
    StepVoltage,
)
from arthur_acausal.models.conformance.case import Case


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


def _options(intervals: int) -> SolverOptions:
    return SolverOptions(rtol=1e-8, intervals=intervals)


_E = "msl_Electrical_Analog_"
_CASES = (
    Case(f"{_E}CauerLowPassOPV", CauerLowPassOPV, {}, 60.0, _options(5000)),
    Case(f"{_E}CauerLowPassOPVWithoutNodes", CauerLowPassOPV, {}, 60.0, _options(5000)),
    Case(f"{_E}CauerLowPassSC", CauerLowPassSC, {}, 60.0, _options(10000)),
)
CASES: dict[str, Case] = {case.name: case for case in _CASES}
