"""A ladder of resistors and capacitors: how a chain of any length is built from parts."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, connect, parameter, start
from arthur_acausal.components.electrical import Capacitor, ConstantVoltage, Ground, Resistor


class RCLadder(Component):
    """``n`` sections of ``R`` [ohm] in series and ``C`` [F] to ground, charged by ``V`` [V] from zero."""

    n: int = 10
    R: Real = parameter("ohm", default=1e3, min=0.0)
    C: Real = parameter("F", default=1e-6, min=0.0)
    V: Real = parameter("V", default=1.0)
    source: ConstantVoltage = ConstantVoltage(V=lambda self: self.V)
    ground = Ground()

    def build(self) -> None:
        self.resistors = [Resistor(R=self.R) for _ in range(self.n)]
        self.capacitors = [Capacitor(C=self.C, v=start(0.0, fixed=True)) for _ in range(self.n)]

    def equations(self) -> Equations:
        yield connect(self.source.pin_n, self.ground.pin)
        node = self.source.pin_p
        for resistor, capacitor in zip(self.resistors, self.capacitors, strict=True):
            yield connect(node, resistor.pin_p)
            yield connect(resistor.pin_n, capacitor.pin_p)
            yield connect(capacitor.pin_n, self.ground.pin)
            node = resistor.pin_n
