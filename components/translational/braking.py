"""Forces against the motion, as functions of the speed, and the eddy current brake (Translational.Sources)."""

from __future__ import annotations

from casadi import fabs, fmax, fmin

from arthur_acausal import Component, Equations, Real, der, if_else, parameter, real_input, variable
from arthur_acausal.components.thermal import HeatPort
from arthur_acausal.components.translational.flange import Flange


class _Braking(Component):
    """What forces against the motion share: ``f_n`` [N] at ``v_n`` [m/s]; ``v`` [m/s], the flange's speed."""

    flange = Flange()
    f_n: Real = parameter("N", min=0.0, description="force against the motion at v_n")
    v_n: Real = parameter("m/s", min=0.0, description="speed at which the force is f_n")
    v: Real = variable("m/s", description="speed of the flange")

    def equations(self) -> Equations:
        yield self.v == der(self.flange.s)


class LinearForce(_Braking):
    """A force against the motion in proportion to the speed: f_n v/v_n."""

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.f == self.f_n * self.v / self.v_n


class SignForce(_Braking):
    """A constant force ``f_n`` [N] against the motion; linear in the speed between -``v_n`` and v_n [m/s].

    For friction that sticks take ``SupportFriction``.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.f == self.f_n * fmin(fmax(self.v / self.v_n, -1), 1)


class InverseForce(_Braking):
    """A force against the motion of constant power: f_n v_n/v, below the speed ``v_0`` [m/s] f_n v/v_0.

    It jumps at v_0, as in the Modelica Standard Library 4.1, InverseSpeedDependentForce.
    """

    v_0: Real = parameter("m/s", default=0.1, min=0.0, description="speed of the regularisation")

    def equations(self) -> Equations:
        yield from super().equations()
        slow = self.v / self.v_0
        fast = self.v_n / if_else(fabs(self.v) < self.v_0, self.v_n, self.v)
        yield self.flange.f == self.f_n * if_else(fabs(self.v) < self.v_0, slow, fast)


class EddyCurrentForce(Component):
    """An eddy current brake: f = 2 f_n x/(1 + x^2), x = v/(v_n (1 + alpha (T - T_ref))) (Kloss's equation).

    The signal ``f_n`` [N] is the largest force, at the speed ``v_n`` [m/s] where the rail has ``T_ref`` [K];
    ``alpha`` [1/K]: temperature coefficient of its resistance. The heat leaves by ``heat_port``. Modelica Standard
    Library 4.1, Mechanics.Translational.Sources.
    """

    flange = Flange()
    heat_port = HeatPort()
    f_n: Real = real_input("N", default=0.0, description="largest force")
    v_n: Real = parameter("m/s", min=0.0, description="speed of the largest force at T_ref")
    T_ref: Real = parameter("K", default=293.15, min=0.0)
    alpha: Real = parameter("1/K", default=0.0, description="at T_ref")
    v: Real = variable("m/s", description="speed of the flange")
    P_loss: Real = variable("W", description="power turned to heat")

    def equations(self) -> Equations:
        yield self.v == der(self.flange.s)
        x = self.v / (self.v_n * (1 + self.alpha * (self.heat_port.T - self.T_ref)))
        yield "Kloss's equation", self.flange.f == 2 * self.f_n * x / (1 + x**2)
        yield self.P_loss == self.flange.f * self.v
        yield self.heat_port.Q_flow == -self.P_loss
