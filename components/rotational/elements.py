"""One-dimensional rotational elements, named as in the Modelica Standard Library (Mechanics.Rotational)."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, der, parameter, variable
from arthur_acausal.components.heating import Heating
from arthur_acausal.components.rotational.flange import Flange


class Inertia(Component):
    """A rotating body with a flange at either end of its shaft.

    States: ``phi`` [rad], ``w`` [rad/s]. Parameter: ``J`` [kg m^2]. Newton's second law.
    """

    flange_a = Flange()
    flange_b = Flange()
    J: Real = parameter("kg*m^2", min=0.0, description="moment of inertia")
    phi: Real = variable("rad", start=0.0, description="angle")
    w: Real = variable("rad/s", start=0.0, description="angular velocity")
    E_kinetic: Real = variable("J", description="kinetic energy")

    def equations(self) -> Equations:
        yield self.phi == self.flange_a.phi
        yield self.phi == self.flange_b.phi
        yield self.w == der(self.phi)
        yield "Newton's second law", self.J * der(self.w) == self.flange_a.tau + self.flange_b.tau
        yield self.E_kinetic == self.J * self.w**2 / 2


class Disc(Component):
    """A massless disc that turns the angle by ``delta_phi`` [rad] from flange_a to flange_b."""

    flange_a = Flange()
    flange_b = Flange()
    delta_phi: Real = parameter("rad", default=0.0)

    def equations(self) -> Equations:
        yield self.flange_b.phi == self.flange_a.phi + self.delta_phi
        yield self.flange_a.tau + self.flange_b.tau == 0


class Compliant(Component):
    """What massless elements between two flanges share: ``phi_rel`` [rad], the twist, and one torque [N m].

    ``tau`` is positive where it turns flange_a forward and flange_b back, that is, for a positive twist.
    """

    flange_a = Flange()
    flange_b = Flange()
    phi_rel: Real = variable("rad", description="angle of flange_b relative to flange_a")
    tau: Real = variable("N*m", description="torque in the element")

    def equations(self) -> Equations:
        yield self.phi_rel == self.flange_b.phi - self.flange_a.phi
        yield self.flange_b.tau == self.tau
        yield self.flange_a.tau == -self.tau


class Spring(Compliant):
    """A linear torsion spring: tau = c (phi_rel - phi_rel0). ``c`` [N m/rad], ``phi_rel0`` [rad]."""

    c: Real = parameter("N*m/rad", min=0.0)
    phi_rel0: Real = parameter("rad", default=0.0)
    E_elastic: Real = variable("J", description="elastic energy")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "Hooke's law", self.tau == self.c * (self.phi_rel - self.phi_rel0)
        yield self.E_elastic == self.c * (self.phi_rel - self.phi_rel0) ** 2 / 2


class Damper(Heating, Compliant):
    """A linear torsion damper: tau = d der(phi_rel). ``d`` [N m s/rad]."""

    d: Real = parameter("N*m*s/rad", min=0.0)
    w_rel: Real = variable("rad/s", description="speed of flange_b relative to flange_a")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w_rel == der(self.phi_rel)
        yield "linear damping", self.tau == self.d * self.w_rel
        yield self.P_loss == self.d * self.w_rel**2
        yield from self.heat()


class SpringDamper(Heating, Compliant):
    """A torsion spring and damper side by side: tau = c (phi_rel - phi_rel0) + d der(phi_rel)."""

    c: Real = parameter("N*m/rad", min=0.0)
    d: Real = parameter("N*m*s/rad", min=0.0)
    phi_rel0: Real = parameter("rad", default=0.0)
    w_rel: Real = variable("rad/s", description="speed of flange_b relative to flange_a")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w_rel == der(self.phi_rel)
        yield "spring and damper", self.tau == self.c * (self.phi_rel - self.phi_rel0) + self.d * self.w_rel
        yield self.P_loss == self.d * self.w_rel**2
        yield from self.heat()


class Fixed(Component):
    """A flange that does not turn: phi = phi0 [rad]."""

    flange = Flange()
    phi0: Real = parameter("rad", default=0.0)

    def equations(self) -> Equations:
        yield self.flange.phi == self.phi0
