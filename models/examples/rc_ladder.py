"""A ladder of resistors and capacitors: how a chain of any length is built from parts."""

from __future__ import annotations

from arthur_acausal import (
    Component,
    Connector,
    Equations,
    Real,
    connect,
    der,
    flow,
    parameter,
    potential,
    start,
    variable,
)


class Pin(Connector):
    """An electrical pin: potential ``v`` [V], current ``i`` [A] into the component."""

    v: Real = potential("V")
    i: Real = flow("A", nominal=1e-3)


class TwoPin(Component):
    """Two pins: ``v`` [V] from pin_n to pin_p, ``i`` [A] through the component from pin_p to pin_n."""

    pin_p = Pin()
    pin_n = Pin()
    v: Real = variable("V")
    i: Real = variable("A", nominal=1e-3)

    def equations(self) -> Equations:
        yield self.v == self.pin_p.v - self.pin_n.v
        yield self.i == self.pin_p.i
        yield self.pin_p.i + self.pin_n.i == 0


class Resistor(TwoPin):
    """Ohm's law: v = R i."""

    R: Real = parameter("ohm", min=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield "Ohm's law", self.v == self.R * self.i


class Capacitor(TwoPin):
    """C der(v) = i. State: ``v`` [V]."""

    C: Real = parameter("F", min=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.C * der(self.v) == self.i


class VoltageSource(TwoPin):
    """v = V, constant."""

    V: Real = parameter("V")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.V


class Ground(Component):
    """The potential 0."""

    pin = Pin()

    def equations(self) -> Equations:
        yield self.pin.v == 0


class RCLadder(Component):
    """``n`` sections of ``R`` [ohm] in series and ``C`` [F] to ground, charged by ``V`` [V] from zero."""

    n: int = 10
    R: Real = parameter("ohm", default=1e3, min=0.0)
    C: Real = parameter("F", default=1e-6, min=0.0)
    V: Real = parameter("V", default=1.0)
    source: VoltageSource = VoltageSource(V=lambda self: self.V)
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
