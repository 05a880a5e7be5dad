"""Sources of rotational mechanics: torques and motions, constant or by a signal."""

from __future__ import annotations

from math import pi

from casadi import fabs

from arthur_acausal import Component, Equations, Real, der, parameter, real_input, variable
from arthur_acausal.components.rotational.flange import Flange
from arthur_acausal.components.rotational.support import Supported


class TorqueSource(Supported):
    """An external torque ``tau`` [N m] that turns the connected component towards positive phi.

    It acts from the ground, or with ``use_support`` from the flange ``support``.
    """

    flange = Flange()
    tau: Real = real_input("N*m", default=0.0)

    def equations(self) -> Equations:
        yield self.flange.tau == -self.tau
        if self.use_support:
            yield self.support.tau == self.tau


class ConstantTorque(Component):
    """A constant torque ``tau_constant`` [N m] that turns the connected component towards positive phi."""

    flange = Flange()
    tau_constant: Real = parameter("N*m")

    def equations(self) -> Equations:
        yield self.flange.tau == -self.tau_constant


class QuadraticTorque(Component):
    """A torque against the motion in proportion to speed squared, as of a fan: tau_n (w/w_n)^2."""

    flange = Flange()
    tau_n: Real = parameter("N*m", min=0.0, description="torque against the motion at w_n")
    w_n: Real = parameter("rad/s", min=0.0, description="speed at which the torque is tau_n")
    w: Real = variable("rad/s", description="speed of the flange")

    def equations(self) -> Equations:
        yield self.w == der(self.flange.phi)
        yield self.flange.tau == self.tau_n * self.w * fabs(self.w) / self.w_n**2


class SpeedSource(Component):
    """Turns its flange with the speed ``w`` [rad/s]. State: ``phi`` [rad].

    ``P`` [W]: the power that it gives to the connected component.
    """

    flange = Flange()
    w: Real = real_input("rad/s", default=0.0)
    phi: Real = variable("rad", start=0.0, fixed=True, state_select="prefer")
    P: Real = variable("W", description="power given to the shaft")

    def equations(self) -> Equations:
        yield self.flange.phi == self.phi
        yield der(self.phi) == self.w
        yield self.P == -self.flange.tau * self.w


class ConstantSpeed(Component):
    """Turns its flange with the constant speed ``w_constant`` [rad/s]. State: ``phi`` [rad]."""

    flange = Flange()
    w_constant: Real = parameter("rad/s")
    phi: Real = variable("rad", start=0.0, fixed=True, state_select="prefer")

    def equations(self) -> Equations:
        yield self.flange.phi == self.phi
        yield der(self.phi) == self.w_constant


class AngleSource(Component):
    """Turns its flange to the angle ``phi_ref`` [rad].

    ``exact``: an inertia on the flange then needs a signal of the model that can be differentiated twice. Otherwise a
    second-order Bessel filter of the critical frequency ``f_crit`` [Hz] makes angle, speed and acceleration of any
    signal; states ``phi``, ``w``. Modelica Standard Library 4.1, Mechanics.Rotational.Sources.Position.
    """

    exact: bool = False
    flange = Flange()
    phi_ref: Real = real_input("rad", default=0.0)
    f_crit: Real = parameter("Hz", default=50.0, min=0.0, description="critical frequency of the filter")
    a_f: Real = parameter("1", default=1.3617, description="Bessel filter, coefficient of s")
    b_f: Real = parameter("1", default=0.6180, description="Bessel filter, coefficient of s^2")
    phi: Real = variable("rad", start=0.0, description="angle")
    w: Real = variable("rad/s", start=0.0, description="speed")

    def equations(self) -> Equations:
        w_crit = 2 * pi * self.f_crit
        yield self.flange.phi == self.phi
        yield self.w == der(self.phi)
        if self.exact:
            yield self.phi == self.phi_ref
        else:
            yield (
                "Bessel filter",
                der(self.w) == ((self.phi_ref - self.phi) * w_crit - self.a_f * self.w) * w_crit / self.b_f,
            )
