"""Sources of translational mechanics."""

from __future__ import annotations

from casadi import fabs

from arthur_acausal import Component, Equations, Real, der, parameter, real_input, real_output, variable
from arthur_acausal.components.translational.flange import Flange


class ForceSource(Component):
    """An external force ``f`` [N] that pushes the connected component in the direction of positive s."""

    flange = Flange()
    f: Real = real_input("N", default=0.0)

    def equations(self) -> Equations:
        yield self.flange.f == -self.f


class ConstantForce(Component):
    """A constant force ``f_constant`` [N] that pushes the connected component in the direction of positive s."""

    flange = Flange()
    f_constant: Real = parameter("N")

    def equations(self) -> Equations:
        yield self.flange.f == -self.f_constant


class QuadraticForce(Component):
    """A force against the motion in proportion to speed squared, as of the air: f_n (v/v_n)^2."""

    flange = Flange()
    f_n: Real = parameter("N", min=0.0, description="force against the motion at v_n")
    v_n: Real = parameter("m/s", min=0.0, description="speed at which the force is f_n")
    v: Real = variable("m/s", description="velocity of the flange")

    def equations(self) -> Equations:
        yield self.v == der(self.flange.s)
        yield self.flange.f == self.f_n * self.v * fabs(self.v) / self.v_n**2


class LoadForce(Component):
    """An external force ``F`` [N] that pushes against positive s: an actuator that extends works against it.

    ``P_work`` [W]: the power that the connected component gives to the load.
    """

    flange = Flange()
    F: Real = real_input("N", default=0.0)
    P_work: Real = real_output("W", description="power given to the load")

    def equations(self) -> Equations:
        yield self.flange.f == self.F
        yield self.P_work == self.F * der(self.flange.s)


class SpeedSource(Component):
    """Moves its flange with the velocity ``v`` [m/s]. State: ``s`` [m]."""

    flange = Flange()
    v: Real = real_input("m/s", default=0.0)
    s: Real = variable("m", start=0.0, fixed=True, state_select="prefer")

    def equations(self) -> Equations:
        yield self.flange.s == self.s
        yield der(self.s) == self.v


class AccelerationSource(Component):
    """Moves its flange with the acceleration ``a`` [m/s^2]. States: ``s`` [m], ``v`` [m/s]."""

    flange = Flange()
    a: Real = real_input("m/s^2", default=0.0)
    s: Real = variable("m", start=0.0, fixed=True, state_select="prefer")
    v: Real = variable("m/s", start=0.0, fixed=True, state_select="prefer")

    def equations(self) -> Equations:
        yield self.flange.s == self.s
        yield self.v == der(self.s)
        yield der(self.v) == self.a


class PositionSource(Component):
    """Moves its flange to ``s`` [m]; an inertia on it needs the signal to be differentiable twice."""

    flange = Flange()
    s: Real = real_input("m", default=0.0)

    def equations(self) -> Equations:
        yield self.flange.s == self.s


class ConstantSpeed(Component):
    """Moves its flange with the constant velocity ``v_constant`` [m/s]. State: ``s`` [m]."""

    flange = Flange()
    v_constant: Real = parameter("m/s")
    s: Real = variable("m", start=0.0, fixed=True, state_select="prefer")

    def equations(self) -> Equations:
        yield self.flange.s == self.s
        yield der(self.s) == self.v_constant
