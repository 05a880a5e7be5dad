"""The connector of circuits, and what elements between pins share."""

from __future__ import annotations

from casadi import SX

from arthur_acausal import Component, Connector, Equations, Real, flow, parameter, potential, variable
from arthur_acausal.components.thermal import HeatPort


class Pin(Connector):
    """Where wires meet: potential ``v`` [V], current ``i`` [A] into the component."""

    v: Real = potential("V")
    i: Real = flow("A")

    def power(self) -> SX:
        """Return v i [W]: of all pins of a component together, the electrical power that it takes."""
        return self.v * self.i


class TwoPin(Component):
    """What elements with two pins share: voltage ``v`` [V] from pin_p to pin_n, current ``i`` [A] the same way.

    ``i`` enters at pin_p and leaves at pin_n, so that v i [W] is the power that the element takes.
    """

    pin_p = Pin()
    pin_n = Pin()
    v: Real = variable("V", description="potential of pin_p above pin_n")
    i: Real = variable("A", description="current from pin_p to pin_n")

    def equations(self) -> Equations:
        yield self.v == self.pin_p.v - self.pin_n.v
        yield self.i == self.pin_p.i
        yield self.pin_p.i + self.pin_n.i == 0


class HeatingTwoPin(TwoPin):
    """What elements with two pins share that turn electrical power to heat: ``P_loss`` [W].

    ``use_heat_port``: the heat leaves by heat_port, whose temperature the element has; without it the
    temperature is ``T`` [K] and the heat is lost.
    """

    use_heat_port: bool = False
    T: Real = parameter(
        "K", default=293.15, min=0.0, display="degC", description="temperature without a heat port"
    )
    P_loss: Real = variable("W", description="power turned to heat")

    def build(self) -> None:
        if self.use_heat_port:
            self.heat_port = HeatPort()

    def temperature(self) -> SX:
        """Return the temperature [K] of the element."""
        return self.heat_port.T if self.use_heat_port else self.T

    def equations(self) -> Equations:
        yield from super().equations()
        yield "loss", self.P_loss == self.v * self.i
        if self.use_heat_port:
            yield self.heat_port.Q_flow == -self.P_loss


class FourPin(Component):
    """What elements with two ports of two pins share: ``v1``, ``i1`` and ``v2``, ``i2`` [V, A] into each port."""

    pin_p1 = Pin()
    pin_n1 = Pin()
    pin_p2 = Pin()
    pin_n2 = Pin()
    v1: Real = variable("V", description="potential of pin_p1 above pin_n1")
    i1: Real = variable("A", description="current into pin_p1, out of pin_n1")
    v2: Real = variable("V", description="potential of pin_p2 above pin_n2")
    i2: Real = variable("A", description="current into pin_p2, out of pin_n2")

    def equations(self) -> Equations:
        yield self.v1 == self.pin_p1.v - self.pin_n1.v
        yield self.i1 == self.pin_p1.i
        yield self.pin_p1.i + self.pin_n1.i == 0
        yield self.v2 == self.pin_p2.v - self.pin_n2.v
        yield self.i2 == self.pin_p2.i
        yield self.pin_p2.i + self.pin_n2.i == 0
