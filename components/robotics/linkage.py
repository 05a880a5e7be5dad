"""A cylinder that drives a joint."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, parameter, variable
from arthur_acausal.components import rotational, translational
from arthur_acausal.components.robotics.triangle import Triangle


class CylinderLinkage(Component):
    """A linear actuator across a joint: it makes a triangle with two sides that meet at the joint's axis.

    Ideal: no mass, no friction; power is conserved exactly, tau phi' = f s' with tau = f dl/dphi (the principle of
    virtual work). ``joint`` is the joint's flange, its angle one body's against the other; ``rod`` is the actuator's,
    rod.s = l - l_0, its reaction is taken by the joint's other body. l^2 = a^2 + b^2 - 2 a b cos(psi), psi = psi_0 +
    direction phi (see Triangle, which has the same geometry for controllers).

    No state. Parameters: sides ``a``, ``b`` [m]; ``psi_0`` [rad] between them at phi = 0; ``direction`` +1 where
    extension increases phi, else -1; ``l_0`` [m] the length at which rod.s = 0. Valid for psi strictly between 0 and
    pi.
    """

    rod = translational.Flange()
    joint = rotational.Flange()
    a: Real = parameter("m", min=0.0, description="short side")
    b: Real = parameter("m", min=0.0, description="long side")
    psi_0: Real = parameter("rad", display="deg", description="angle between the sides at phi = 0")
    direction: Real = parameter(
        "1", default=1.0, min=-1.0, max=1.0, description="+1: extension increases phi"
    )
    l_0: Real = parameter("m", min=0.0, description="length at which rod.s = 0")
    phi: Real = variable("rad", nominal=1.0, display="deg", description="angle of the joint")
    l: Real = variable(
        "m", nominal=0.1, state_select="avoid", description="length of the actuator, pin to pin"
    )
    arm: Real = variable("m", nominal=0.01, display="mm", description="moment arm dl/dphi")
    f: Real = variable("N", nominal=100.0, description="force of the actuator, positive extends")
    tau: Real = variable("N*m", description="torque on the joint")

    def equations(self) -> Equations:
        triangle = Triangle(self.a, self.b, self.psi_0, self.direction)
        yield self.phi == self.joint.phi
        yield "law of cosines", self.l == triangle.length(self.phi)
        yield self.rod.s == self.l - self.l_0
        yield "moment arm", self.arm == triangle.arm(self.phi)
        yield self.f == self.rod.f
        yield self.tau == -self.joint.tau
        yield "virtual work", self.tau == self.f * self.arm
