"""Gears: ideal, with losses, and from turning to sliding; as in Modelica's Mechanics.Rotational.Components."""

from __future__ import annotations

from casadi import SX, fabs, logic_not

from arthur_acausal import Component, Equations, Real, der, parameter, pre, smooth_if_else, variable
from arthur_acausal.components.friction import (
    BACKWARD,
    FORWARD,
    HYSTERESIS,
    STUCK,
    UNKNOWN,
    StickSlip,
    all_of,
    any_of,
    interpolated,
    starting,
    torn,
    truth,
)
from arthur_acausal.components.heating import Heating
from arthur_acausal.components.rotational.flange import Flange
from arthur_acausal.components.rotational.support import Supported
from arthur_acausal.components.translational.flange import Flange as SlidingFlange

Losses = tuple[tuple[float, float, float, float, float], ...]


class IdealGear(Supported):
    """A gear without loss or inertia: phi_a = ratio phi_b, angles over the housing.

    ``ratio`` [1], the speed of flange_a over that of flange_b. The housing stands on the ground, or with
    ``use_support`` on the flange ``support``.
    """

    flange_a = Flange()
    flange_b = Flange()
    ratio: Real = parameter("1", default=1.0)

    def equations(self) -> Equations:
        a, b, housing = self.flange_a, self.flange_b, self.phi_support()
        yield a.phi - housing == self.ratio * (b.phi - housing)
        yield self.ratio * a.tau + b.tau == 0
        if self.use_support:
            yield self.support.tau + a.tau + b.tau == 0


class IdealGearR2T(Supported):
    """A pinion and a rack, or a wheel that rolls: phi = ratio s. ``ratio`` [rad/m] is one over the pitch radius.

    The housing stands on the ground, or with ``use_support`` on the flanges ``support`` (turning) and
    ``support_t`` (sliding).
    """

    flange_r = Flange()
    flange_t = SlidingFlange()
    ratio: Real = parameter("rad/m")

    def build(self) -> None:
        super().build()
        if self.use_support:
            self.support_t = SlidingFlange()

    def equations(self) -> Equations:
        r, t = self.flange_r, self.flange_t
        s_support = self.support_t.s if self.use_support else SX(0.0)
        yield r.phi - self.phi_support() == self.ratio * (t.s - s_support)
        yield self.ratio * r.tau + t.f == 0
        if self.use_support:
            yield self.support.tau + r.tau == 0
            yield self.support_t.f + t.f == 0


class IdealPlanetary(Component):
    """A planetary gear without loss or inertia: (1 + ratio) phi_carrier = phi_sun + ratio phi_ring.

    ``ratio`` [1]: teeth of the ring over teeth of the sun. Willis's equation; three flanges, any of which may be held.
    """

    sun = Flange()
    carrier = Flange()
    ring = Flange()
    ratio: Real = parameter("1", min=0.0, description="teeth of the ring over those of the sun")

    def equations(self) -> Equations:
        s, c, r = self.sun, self.carrier, self.ring
        yield "Willis's equation", (1 + self.ratio) * c.phi == s.phi + self.ratio * r.phi
        yield r.tau == self.ratio * s.tau
        yield c.tau == -(1 + self.ratio) * s.tau


class LossyGear(StickSlip, Heating, Supported):
    """A gear with mesh efficiency and bearing friction, which may lock.

    ``losses``: tuple of (speed / ``w_unit``, eta_1, eta_2, tau_1 / ``tau_unit``, tau_2 / ``tau_unit``), speeds |w_a|
    from 0 on, linear between and beyond: the efficiency of the mesh and the friction of all bearings over flange_a,
    1 where flange_a drives, 2 where flange_b drives. ``tau_loss`` [N m]: the torque lost, over flange_a.
    Pelchen, Schweiger and Otter (2002), "Modeling and
    simulating the efficiency of gearboxes and of planetary gearboxes"; the driving side at rest by Bertsch (2009), as
    in the Modelica Standard Library 4.1.
    """

    losses: Losses = ((0.0, 1.0, 1.0, 0.0, 0.0),)
    flange_a = Flange()
    flange_b = Flange()
    ratio: Real = parameter("1", default=1.0, description="speed of flange_a over that of flange_b")
    w_unit: Real = parameter("rad/s", default=1.0, description="what a speed of 1 in losses means")
    tau_unit: Real = parameter("N*m", default=1.0, description="what a torque of 1 in losses means")
    J_path: Real = parameter("kg*m^2", default=1.0, description="scale of sa; no effect on the motion")
    phi_a: Real = variable("rad", description="angle of flange_a over the housing")
    w_a: Real = variable("rad/s", description="its speed")
    a_a: Real = variable("rad/s^2", description="its acceleration")
    sa: Real = variable("N*m", description="path parameter of the friction characteristic")
    tau_loss: Real = variable("N*m", description="torque lost, over flange_a")
    tau_forward: Real = variable("N*m", description="what is lost where the gear turns forward")
    tau_backward: Real = variable("N*m", description="what is lost where the gear turns backward")

    def equations(self) -> Equations:
        a, b = self.flange_a, self.flange_b
        yield self.phi_a == a.phi - self.phi_support()
        yield self.phi_a == self.ratio * (b.phi - self.phi_support())
        yield self.w_a == der(self.phi_a)
        yield self.a_a == der(self.w_a)
        yield "torque balance", b.tau + self.ratio * (a.tau - self.tau_loss) == 0
        yield self.P_loss == self.tau_loss * self.w_a
        yield from self.heat()
        if self.use_support:
            yield self.support.tau + a.tau + b.tau == 0
        yield from self._branches()
        yield from self._torques()

    def _mesh(self, speed: SX) -> tuple[SX, SX, SX, SX, SX]:
        """Return eta_1, eta_2, tau_1, tau_2 [N m] and the bearing friction on the side of flange_a [N m]."""
        columns = [[(row[0], row[k]) for row in self.losses] for k in range(1, 5)]
        x = speed / self.w_unit
        eta_1, eta_2 = interpolated(columns[0], x), interpolated(columns[1], x)
        tau_1, tau_2 = (self.tau_unit * fabs(interpolated(column, x)) for column in columns[2:])
        if all(row[1] == row[2] == 1.0 for row in self.losses):
            return eta_1, eta_2, tau_1, tau_2, tau_1 / 2  # cannot be split into sides: arbitrary
        return eta_1, eta_2, tau_1, tau_2, (tau_1 - tau_2) / (eta_1 - 1 / eta_2)

    def _torques(self) -> Equations:
        """Yield the loss on both branches, by the side that drives, and the one that holds."""
        tau = self.flange_a.tau
        eta_1, eta_2, tau_1, tau_2, bearing = self._mesh(fabs(self.w_a))
        driving = truth(tau - self.direction * bearing >= 0)
        lost_1, lost_2 = (1 - eta_1) * tau, (1 - 1 / eta_2) * tau
        yield self.tau_forward == smooth_if_else(driving, lost_1 + tau_1, lost_2 + tau_2)
        yield self.tau_backward == smooth_if_else(driving, lost_2 - tau_2, lost_1 - tau_1)
        rolling = smooth_if_else(self.direction < 0, self.tau_backward, self.tau_forward)
        yield "torque lost", self.tau_loss == smooth_if_else(self.locked, self.sa, rolling)
        excess = smooth_if_else(self.locked, self.creep * self.sa, self.sa - self.tau_loss)
        yield "stuck or rolling", self.J_path * self.a_a == excess

    def _branches(self) -> Equations:
        """Yield the state machine; what can be held at rest follows from the losses at speed zero."""
        tau = self.flange_a.tau
        eta_1, eta_2, tau_1, tau_2, bearing = self._mesh(SX(0.0) * self.w_unit)
        lost_1, lost_2 = (1 - eta_1) * tau, (1 - 1 / eta_2) * tau
        most = smooth_if_else(tau - bearing > 0, lost_1 + tau_1, lost_2 + tau_2)
        least = smooth_if_else(tau + bearing > 0, lost_2 - tau_2, lost_1 - tau_1)
        was = pre(self.mode)
        forward, backward = self.moving(self.w_a, self.w_unit)
        pull, push = torn(any_of(self.locked, self.start_forward, self.start_backward), self.sa)
        still_pull, still_push = torn(any_of(self.start_forward, self.start_backward), self.sa)
        over, under = truth(pull > most), truth(push < least)
        still_over = truth(still_pull > most - HYSTERESIS * fabs(most))
        still_under = truth(still_push < least + HYSTERESIS * fabs(least))
        yield self.started == (was != UNKNOWN)
        yield self.start_forward == starting(was, forward, over, still_over, pre(self.start_forward))
        yield self.start_backward == starting(was, backward, under, still_under, pre(self.start_backward))
        ahead, back = any_of(was == FORWARD, self.start_forward), any_of(was == BACKWARD, self.start_backward)
        yield self.locked == logic_not(any_of(ahead, back))
        yield self.direction == smooth_if_else(ahead, 1, smooth_if_else(back, -1, 0))
        yield self.mode == smooth_if_else(
            all_of(ahead, forward), FORWARD, smooth_if_else(all_of(back, backward), BACKWARD, STUCK)
        )
