"""A rectifier: ideal diodes, events and an algebraic loop that changes with them."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, connect, parameter, start
from arthur_acausal.components.electrical import (
    Capacitor,
    Ground,
    IdealDiode,
    IdealTransformer,
    Inductor,
    Resistor,
    SineVoltage,
)


class PowerSupply(Component):
    """A transformer, a bridge of four ideal diodes, a capacitor ``C`` [F] and a load ``R`` [ohm].

    230 V at 50 Hz become about 12 V with a ripple of I/(2 f C). The transformer's stray inductance and the
    wires' resistance limit the current that charges the capacitor.
    """

    C: Real = parameter("F", default=4.7e-3, min=0.0)
    R: Real = parameter("ohm", default=20.0, min=0.0)
    mains = SineVoltage(V=325.0, f=50.0)
    transformer = IdealTransformer(n=25.0)
    stray = Inductor(L=1e-4, i=start(0.0, fixed=True))
    wire = Resistor(R=0.1)
    capacitor: Capacitor = Capacitor(C=lambda self: self.C, v=start(0.0, fixed=True))
    load: Resistor = Resistor(R=lambda self: self.R)
    mains_ground = Ground()
    ground = Ground()

    def build(self) -> None:
        self.upper = [IdealDiode(Vknee=0.7, Ron=1e-2) for _ in range(2)]
        self.lower = [IdealDiode(Vknee=0.7, Ron=1e-2) for _ in range(2)]

    def equations(self) -> Equations:
        yield connect(self.mains.pin_p, self.transformer.pin_p1)
        yield connect(self.mains.pin_n, self.transformer.pin_n1)
        yield connect(self.mains.pin_n, self.mains_ground.pin)
        yield connect(self.transformer.pin_p2, self.stray.pin_p)
        yield connect(self.stray.pin_n, self.wire.pin_p)
        ends = (self.wire.pin_n, self.transformer.pin_n2)
        for pin, upper, lower in zip(ends, self.upper, self.lower, strict=True):
            yield connect(upper.pin_p, pin)
            yield connect(lower.pin_n, pin)
            yield connect(upper.pin_n, self.capacitor.pin_p)
            yield connect(lower.pin_p, self.capacitor.pin_n)
        yield connect(self.load.pin_p, self.capacitor.pin_p)
        yield connect(self.load.pin_n, self.capacitor.pin_n)
        yield connect(self.capacitor.pin_n, self.ground.pin)
