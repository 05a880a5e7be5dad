"""A pendulum whose rod is said twice, so that nothing is left for the force in it."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, StructureError, der, parameter, translate, variable

ERROR = StructureError
EXPECT = [r"singular", r"more than their unknowns: .*rod", r"not determined: .*F", r"remove one"]


class Bob(Component):
    """A bob on a rod, in Cartesian coordinates."""

    L: Real = parameter("m", default=1.0)
    m: Real = parameter("kg", default=1.0)
    x: Real = variable("m", start=0.6, fixed=True)
    y: Real = variable("m", start=-0.8)
    u: Real = variable("m/s")
    v: Real = variable("m/s")
    F: Real = variable("N")

    def equations(self) -> Equations:
        yield self.u == der(self.x)
        yield self.v == der(self.y)
        yield "level", self.m * der(self.u) == 0
        yield "rod", self.x**2 + self.y**2 == self.L**2  # culprit
        yield "rod again", (self.x**2 + self.y**2) / self.L == self.L  # culprit


def run() -> object:
    return translate(Bob())
