"""Elements with two ports, named as in the Modelica Standard Library (Electrical.Analog.Basic, Ideal)."""

from __future__ import annotations

from arthur_acausal import Equations, Real, der, parameter, variable
from arthur_acausal.components.electrical.pin import FourPin, TwoPin
from arthur_acausal.components.rotational import Flange


class Transformer(FourPin):
    """Two coupled coils: v1 = L1 der(i1) + M der(i2), v2 = M der(i1) + L2 der(i2).

    ``L1``, ``L2``, ``M`` [H] with M^2 < L1 L2. States: ``i1``, ``i2`` [A].
    """

    L1: Real = parameter("H", min=0.0, description="primary inductance")
    L2: Real = parameter("H", min=0.0, description="secondary inductance")
    M: Real = parameter("H", description="mutual inductance")
    i1: Real = variable("A", start=0.0, description="current into pin_p1, out of pin_n1")
    i2: Real = variable("A", start=0.0, description="current into pin_p2, out of pin_n2")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "primary flux", self.v1 == self.L1 * der(self.i1) + self.M * der(self.i2)
        yield "secondary flux", self.v2 == self.M * der(self.i1) + self.L2 * der(self.i2)


class IdealTransformer(FourPin):
    """v1 = n v2, i2 = -n i1, for direct voltages too. ``n`` [1]: turns ratio, primary over secondary."""

    n: Real = parameter("1", default=1.0, description="turns ratio")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v1 == self.n * self.v2
        yield self.i2 == -self.n * self.i1


class Gyrator(FourPin):
    """i1 = G2 v2, i2 = -G1 v1. ``G1``, ``G2`` [S]; without loss where they are equal."""

    G1: Real = parameter("S", min=0.0)
    G2: Real = parameter("S", min=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i1 == self.G2 * self.v2
        yield self.i2 == -self.G1 * self.v1


class VoltageControlledVoltageSource(FourPin):
    """v2 = gain v1, no current at port 1."""

    gain: Real = parameter("1")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v2 == self.gain * self.v1
        yield self.i1 == 0


class VoltageControlledCurrentSource(FourPin):
    """i2 = g v1, no current at port 1. ``g`` [S]: transconductance."""

    g: Real = parameter("S")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i2 == self.g * self.v1
        yield self.i1 == 0


class CurrentControlledVoltageSource(FourPin):
    """v2 = r i1, no voltage at port 1. ``r`` [ohm]: transresistance."""

    r: Real = parameter("ohm")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v2 == self.r * self.i1
        yield self.v1 == 0


class CurrentControlledCurrentSource(FourPin):
    """i2 = gain i1, no voltage at port 1."""

    gain: Real = parameter("1")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i2 == self.gain * self.i1
        yield self.v1 == 0


class EMF(TwoPin):
    """Electromotive force, an ideal machine: v = k w, and the torque k i on the shaft.

    ``k`` [N m/A = V s/rad]; the housing is at rest. A positive current turns the flange forward: the power
    v i that it takes is the power tau w that it gives. The losses are those of other elements.
    """

    flange = Flange()
    k: Real = parameter("N*m/A", description="torque and voltage constant")
    w: Real = variable("rad/s", description="angular velocity of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w == der(self.flange.phi)
        yield "induction", self.v == self.k * self.w
        yield "torque", self.flange.tau == -self.k * self.i
