"""Electrical parts for tests of the framework: pins, two-pin elements, sources and ground."""

from __future__ import annotations

from arthur_acausal import Component, Connector, Equations, Real, der, flow, parameter, potential, variable


class Pin(Connector):
    """Where wires meet: ``v`` [V], ``i`` [A] into the component."""

    v: Real = potential("V")
    i: Real = flow("A")


class TwoPin(Component):
    """Two pins; ``v`` [V] from p to n, ``i`` [A] from p through the element to n."""

    p = Pin()
    n = Pin()
    v: Real = variable("V")
    i: Real = variable("A")

    def equations(self) -> Equations:
        yield self.v == self.p.v - self.n.v
        yield self.i == self.p.i
        yield self.p.i + self.n.i == 0


class Resistor(TwoPin):
    """v = R i."""

    R: Real = parameter("ohm", default=1.0, min=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield "Ohm's law", self.v == self.R * self.i


class Capacitor(TwoPin):
    """C v' = i."""

    C: Real = parameter("F", default=1.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield "charge", self.C * der(self.v) == self.i


class Inductor(TwoPin):
    """L i' = v."""

    L: Real = parameter("H", default=1.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield "flux", self.L * der(self.i) == self.v


class Voltage(TwoPin):
    """An ideal voltage source, v = V."""

    V: Real = parameter("V", default=1.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield "source voltage", self.v == self.V


class Current(TwoPin):
    """An ideal current source: ``I`` [A] flows from p to n within it."""

    I: Real = parameter("A", default=1.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield "source current", self.i == self.I


class Ground(Component):
    """Potential zero."""

    p = Pin()

    def equations(self) -> Equations:
        yield self.p.v == 0
