"""Translational elements, named as in the Modelica Standard Library (Mechanics.Translational)."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, der, parameter, variable
from arthur_acausal.components.heating import Heating
from arthur_acausal.components.translational.flange import Flange


class Mass(Component):
    """A sliding mass with one flange; connect several components to it.

    States: ``s`` [m], ``v`` [m/s]. Parameter: ``m`` [kg]. Newton's second law.
    """

    flange = Flange()
    m: Real = parameter("kg", min=0.0, description="mass")
    s: Real = variable("m", start=0.0, description="position")
    v: Real = variable("m/s", start=0.0, description="velocity")
    E_kinetic: Real = variable("J", description="kinetic energy")

    def equations(self) -> Equations:
        yield self.s == self.flange.s
        yield self.v == der(self.s)
        yield "Newton's second law", self.m * der(self.v) == self.flange.f
        yield self.E_kinetic == self.m * self.v**2 / 2


class SlidingMass(Component):
    """A sliding mass of length ``L`` [m] with a flange at either end; ``s`` is its middle.

    States: ``s`` [m], ``v`` [m/s]. Parameters: ``m`` [kg], ``L`` [m].
    """

    flange_a = Flange()
    flange_b = Flange()
    m: Real = parameter("kg", min=0.0, description="mass")
    L: Real = parameter("m", default=0.0, description="length from flange_a to flange_b")
    s: Real = variable("m", start=0.0, description="position of the middle")
    v: Real = variable("m/s", start=0.0, description="velocity")
    E_kinetic: Real = variable("J", description="kinetic energy")

    def equations(self) -> Equations:
        yield self.flange_a.s == self.s - self.L / 2
        yield self.flange_b.s == self.s + self.L / 2
        yield self.v == der(self.s)
        yield "Newton's second law", self.m * der(self.v) == self.flange_a.f + self.flange_b.f
        yield self.E_kinetic == self.m * self.v**2 / 2


class Rod(Component):
    """A massless rigid rod of length ``L`` [m] from flange_a to flange_b."""

    flange_a = Flange()
    flange_b = Flange()
    L: Real = parameter("m", default=0.0)

    def equations(self) -> Equations:
        yield self.flange_b.s == self.flange_a.s + self.L
        yield self.flange_a.f + self.flange_b.f == 0


class Lever(Component):
    """A massless lever: flange_b moves ``ratio`` [1] times as far as flange_a, the other way where it is negative."""

    flange_a = Flange()
    flange_b = Flange()
    ratio: Real = parameter("1", default=-1.0)

    def equations(self) -> Equations:
        yield self.flange_b.s == self.ratio * self.flange_a.s
        yield "balance of torques", self.flange_a.f + self.ratio * self.flange_b.f == 0


class Compliant(Component):
    """What all massless elements between two flanges share: ``s_rel`` [m], the elongation, and one force [N].

    ``f`` is positive in tension of the element, that is, it pulls the two flanges together.
    """

    flange_a = Flange()
    flange_b = Flange()
    s_rel: Real = variable("m", description="distance from flange_a to flange_b")
    f: Real = variable("N", description="force in the element, positive in tension")

    def equations(self) -> Equations:
        yield self.s_rel == self.flange_b.s - self.flange_a.s
        yield self.flange_b.f == self.f
        yield self.flange_a.f == -self.f


class Spring(Compliant):
    """A linear spring: f = c (s_rel - s_rel0). ``c`` [N/m], ``s_rel0`` [m] unstretched length."""

    c: Real = parameter("N/m", min=0.0)
    s_rel0: Real = parameter("m", default=0.0)
    E_elastic: Real = variable("J", description="elastic energy")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "Hooke's law", self.f == self.c * (self.s_rel - self.s_rel0)
        yield self.E_elastic == self.c * (self.s_rel - self.s_rel0) ** 2 / 2


class Damper(Heating, Compliant):
    """A linear damper: f = d der(s_rel). ``d`` [N s/m]."""

    d: Real = parameter("N*s/m", min=0.0)
    v_rel: Real = variable("m/s", description="velocity of flange_b relative to flange_a")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v_rel == der(self.s_rel)
        yield "linear damping", self.f == self.d * self.v_rel
        yield self.P_loss == self.d * self.v_rel**2
        yield from self.heat()


class SpringDamper(Heating, Compliant):
    """A spring and a damper side by side: f = c (s_rel - s_rel0) + d der(s_rel)."""

    c: Real = parameter("N/m", min=0.0)
    d: Real = parameter("N*s/m", min=0.0)
    s_rel0: Real = parameter("m", default=0.0)
    v_rel: Real = variable("m/s", description="velocity of flange_b relative to flange_a")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v_rel == der(self.s_rel)
        yield "spring and damper", self.f == self.c * (self.s_rel - self.s_rel0) + self.d * self.v_rel
        yield self.P_loss == self.d * self.v_rel**2
        yield from self.heat()


class Fixed(Component):
    """A flange that does not move: s = s0 [m]."""

    flange = Flange()
    s0: Real = parameter("m", default=0.0)

    def equations(self) -> Equations:
        yield self.flange.s == self.s0
