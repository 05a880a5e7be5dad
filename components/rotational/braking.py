"""Torques against the motion, as functions of the speed, and the eddy current brake (Rotational.Sources)."""

from __future__ import annotations

from casadi import fabs, fmax, fmin

from arthur_acausal import Component, Equations, Real, der, if_else, parameter, real_input, variable
from arthur_acausal.components.rotational.flange import Flange
from arthur_acausal.components.thermal import HeatPort


class _Braking(Component):
    """What torques against the motion share: ``tau_n`` [N m] at ``w_n`` [rad/s]; ``w`` [rad/s], the flange's speed."""

    flange = Flange()
    tau_n: Real = parameter("N*m", min=0.0, description="torque against the motion at w_n")
    w_n: Real = parameter("rad/s", min=0.0, description="speed at which the torque is tau_n")
    w: Real = variable("rad/s", description="speed of the flange")

    def equations(self) -> Equations:
        yield self.w == der(self.flange.phi)


class LinearTorque(_Braking):
    """A torque against the motion in proportion to the speed: tau_n w/w_n."""

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.tau == self.tau_n * self.w / self.w_n


class SignTorque(_Braking):
    """A constant torque ``tau_n`` [N m] against the motion; linear in the speed between -``w_n`` and w_n [rad/s].

    For friction that sticks take ``BearingFriction``.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.tau == self.tau_n * fmin(fmax(self.w / self.w_n, -1), 1)


class InverseTorque(_Braking):
    """A torque against the motion of constant power: tau_n w_n/w, below the speed ``w_0`` [rad/s] tau_n w/w_0.

    It jumps at w_0, as in the Modelica Standard Library 4.1, InverseSpeedDependentTorque.
    """

    w_0: Real = parameter("rad/s", default=0.1, min=0.0, description="speed of the regularisation")

    def equations(self) -> Equations:
        yield from super().equations()
        slow = self.w / self.w_0
        fast = self.w_n / if_else(fabs(self.w) < self.w_0, self.w_n, self.w)
        yield self.flange.tau == self.tau_n * if_else(fabs(self.w) < self.w_0, slow, fast)


class EddyCurrentTorque(Component):
    """An eddy current brake: tau = 2 tau_n x/(1 + x^2), x = w/(w_n (1 + alpha (T - T_ref))) (Kloss's equation).

    The signal ``tau_n`` [N m] is the largest torque, at the speed ``w_n`` [rad/s] where the disc has ``T_ref`` [K];
    ``alpha`` [1/K]: temperature coefficient of its resistance. The heat leaves by ``heat_port``. Modelica Standard
    Library 4.1, Mechanics.Rotational.Sources.
    """

    flange = Flange()
    heat_port = HeatPort()
    tau_n: Real = real_input("N*m", default=0.0, description="largest torque")
    w_n: Real = parameter("rad/s", min=0.0, description="speed of the largest torque at T_ref")
    T_ref: Real = parameter("K", default=293.15, min=0.0)
    alpha: Real = parameter("1/K", default=0.0, description="at T_ref")
    w: Real = variable("rad/s", description="speed of the flange")
    P_loss: Real = variable("W", description="power turned to heat")

    def equations(self) -> Equations:
        yield self.w == der(self.flange.phi)
        x = self.w / (self.w_n * (1 + self.alpha * (self.heat_port.T - self.T_ref)))
        yield "Kloss's equation", self.flange.tau == 2 * self.tau_n * x / (1 + x**2)
        yield self.P_loss == self.flange.tau * self.w
        yield self.heat_port.Q_flow == -self.P_loss
