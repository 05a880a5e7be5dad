"""Models that make every kind of kernel and every way of recovery."""

from __future__ import annotations

from casadi import exp, sin

from arthur_acausal import (
    Component,
    Equations,
    Real,
    connect,
    der,
    discrete,
    if_else,
    parameter,
    pre,
    real_input,
    real_output,
    reinit,
    start,
    time,
    variable,
    when,
)
from tests.circuit import Capacitor, Ground, Inductor, Resistor, Voltage


class Everything(Component):
    """States, torn and assigned unknowns, aliases of both signs, zero, an input, a relation, a discrete, time."""

    k: Real = parameter("1", default=0.5)
    c: Real = parameter("1", default=lambda self: 2 * self.k)
    T: Real = parameter("s", default=1.5)
    u: Real = real_input("1", default=0.3)
    y: Real = real_output("1")
    x: Real = variable("1", start=lambda self: self.c, fixed=True)
    z: Real = variable("1", start=-0.5, fixed=True)
    rate: Real = variable("1/s")
    same: Real = variable("1")
    opposite: Real = variable("1")
    nothing: Real = variable("1")
    loop: Real = variable("1", start=0.1)
    chosen: Real = variable("1")
    level: Real = discrete("1", start=lambda self: self.k)

    def equations(self) -> Equations:
        yield "first", self.T * der(self.x) + 0.2 * self.T * der(self.z) == -self.x * self.loop + self.u
        yield "second", self.T * der(self.z) == sin(time() / self.T) - self.c * self.z + self.chosen
        yield "implicit", self.loop + self.k * exp(self.loop) == self.x**2 + 1
        yield "switch", self.chosen == if_else(self.x > self.z + 0.1, self.x * self.z, self.level)
        yield "output", self.y == self.level * self.same - self.opposite
        yield self.same == self.x
        yield self.opposite == -self.z
        yield self.nothing == 0
        yield self.rate == der(self.x)
        yield when(self.x < 0.2, reinit(self.x, 2 * pre(self.x) + 0.4), self.level == pre(self.level) + 1)


class Filter(Component):
    """A source, a coil, two capacitors and resistors in a T, all by connections."""

    source = Voltage(V=10.0)
    coil = Inductor(L=0.5, i=start(0.0, fixed=True))
    left = Capacitor(C=0.2, v=start(0.0, fixed=True))
    middle = Resistor(R=2.0)
    right = Capacitor(C=0.1, v=start(1.0, fixed=True))
    load = Resistor(R=5.0)
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.coil.p)
        yield connect(self.coil.n, self.left.p)
        yield connect(self.left.p, self.middle.p)
        yield connect(self.middle.n, self.right.p)
        yield connect(self.right.p, self.load.p)
        for part in (self.left, self.right, self.load, self.source):
            yield connect(part.n, self.ground.p)


class Rod(Component):
    """A mass in the plane on a rod: of index 3, with dummy derivatives."""

    L: Real = parameter("m", default=2.0)
    g: Real = parameter("m/s^2", default=9.81)
    x: Real = variable("m", start=1.2, fixed=True)
    y: Real = variable("m", start=-1.6)
    v: Real = variable("m/s", start=0.5, fixed=True)
    w: Real = variable("m/s")
    F: Real = variable("1/s^2")

    def equations(self) -> Equations:
        yield self.v == der(self.x)
        yield self.w == der(self.y)
        yield der(self.v) == -self.F * self.x
        yield der(self.w) == -self.F * self.y - self.g
        yield "rod", self.x**2 + self.y**2 == self.L**2
