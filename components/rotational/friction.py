"""Bearing friction, clutches and brakes with exact sticking, as in Modelica's Mechanics.Rotational.Components."""

from __future__ import annotations

from casadi import SX, fmax, logic_not

from arthur_acausal import (
    Equations,
    Real,
    der,
    discrete,
    parameter,
    pre,
    real_input,
    smooth_if_else,
    variable,
)
from arthur_acausal.components.friction import (
    HYSTERESIS,
    Points,
    StickSlip,
    all_of,
    any_of,
    at_zero,
    interpolated,
    torn,
    truth,
)
from arthur_acausal.components.heating import Heating
from arthur_acausal.components.rotational.elements import Compliant
from arthur_acausal.components.rotational.flange import Flange
from arthur_acausal.components.rotational.support import Supported


class _Bearing(StickSlip, Heating, Supported):
    """A shaft through a housing that rubs on it: what bearing friction and brake share.

    ``tau`` is positive against positive ``w``, the shaft's speed over the housing.
    """

    flange_a = Flange()
    flange_b = Flange()
    w_unit: Real = parameter("rad/s", default=1.0, description="what a speed of 1 in the table means")
    J_path: Real = parameter("kg*m^2", default=1.0, description="scale of sa; no effect on the motion")
    phi: Real = variable("rad", start=0.0, description="angle of the shaft over the housing")
    w: Real = variable("rad/s", start=0.0, state_select="prefer", description="its speed")
    a: Real = variable("rad/s^2", description="its acceleration")
    tau: Real = variable("N*m", description="friction torque, positive against positive w")
    sa: Real = variable("N*m", description="path parameter of the friction characteristic")

    def rubbing(self, least: SX, most: SX, ahead: SX, back: SX, free: SX | None = None) -> Equations:
        """Yield all equations for the friction's values: at speed zero, and sliding ``ahead`` and ``back``."""
        yield self.phi == self.flange_a.phi - self.phi_support()
        yield self.flange_b.phi == self.flange_a.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield "torque balance", self.flange_a.tau + self.flange_b.tau == self.tau
        yield from self.branches(self.w, self.sa, least, most, self.w_unit, free)
        yield "stuck or sliding", self.J_path * self.a == self.excess(self.sa, most)
        yield "friction torque", self.tau == self.friction(self.sa, ahead, back)
        yield self.P_loss == self.tau * self.w
        yield from self.heat()
        if self.use_support:
            yield self.support.tau + self.flange_a.tau + self.flange_b.tau == 0


class BearingFriction(_Bearing):
    """Coulomb friction in a bearing: it slides, or it sticks until ``peak`` times the friction at rest is exceeded.

    ``tau_pos``: tuple of (speed / ``w_unit``, torque / ``tau_unit``), speeds from 0 on; linear between and beyond.
    The friction of negative speeds mirrors it.
    """

    tau_pos: Points = ((0.0, 1.0),)
    peak: Real = parameter(
        "1", default=1.0, min=1.0, description="largest torque at rest over that of tau_pos at 0"
    )
    tau_unit: Real = parameter("N*m", default=1.0, description="what a torque of 1 in tau_pos means")

    def equations(self) -> Equations:
        least = self.tau_unit * at_zero(self.tau_pos)
        ahead = self.tau_unit * interpolated(self.tau_pos, self.w / self.w_unit)
        back = self.tau_unit * interpolated(self.tau_pos, -self.w / self.w_unit)
        yield from self.rubbing(least, self.peak * least, ahead, back)


class Brake(_Bearing):
    """A brake between shaft and housing, pressed together with the normal force f_n = f_n_max f_normalized.

    Sliding: tau = c_geo mu(w) f_n against the motion; stuck: up to ``peak`` c_geo mu(0) f_n. Without normal force
    it is free (mode 2). ``mu_pos``: tuple of (speed / ``w_unit``, coefficient of friction), speeds from 0 on, linear
    between and beyond. ``c_geo`` [m]: for discs of radii r_i and r_o with N friction faces N (r_i + r_o)/2.
    """

    mu_pos: Points = ((0.0, 0.5),)
    f_normalized: Real = real_input("1", default=0.0, description="normal force over f_n_max; 0: free")
    f_n_max: Real = parameter("N", min=0.0, description="largest normal force")
    c_geo: Real = parameter("m", default=1.0, min=0.0, description="radius at which the friction acts")
    peak: Real = parameter("1", default=1.0, min=1.0, description="largest coefficient at rest over mu(0)")
    f_n: Real = variable("N", description="normal force")

    def equations(self) -> Equations:
        yield self.f_n == self.f_n_max * self.f_normalized
        torque = self.c_geo * self.f_n
        least = torque * at_zero(self.mu_pos)
        ahead = torque * interpolated(self.mu_pos, self.w / self.w_unit)
        back = torque * interpolated(self.mu_pos, -self.w / self.w_unit)
        yield from self.rubbing(least, self.peak * least, ahead, back, self.f_n <= 0)


class Clutch(StickSlip, Heating, Compliant):
    """Two shafts pressed together with the normal force f_n = f_n_max f_normalized.

    Sliding: tau = c_geo mu(w_rel) f_n; stuck: up to ``peak`` c_geo mu(0) f_n. Without normal force it is free (mode
    2). ``tau`` is positive for a positive ``w_rel``, of flange_b over flange_a. Parameters as in ``Brake``.
    """

    mu_pos: Points = ((0.0, 0.5),)
    f_normalized: Real = real_input("1", default=0.0, description="normal force over f_n_max; 0: free")
    f_n_max: Real = parameter("N", min=0.0, description="largest normal force")
    c_geo: Real = parameter("m", default=1.0, min=0.0, description="radius at which the friction acts")
    peak: Real = parameter("1", default=1.0, min=1.0, description="largest coefficient at rest over mu(0)")
    w_unit: Real = parameter("rad/s", default=1.0, description="what a speed of 1 in mu_pos means")
    J_path: Real = parameter("kg*m^2", default=1.0, description="scale of sa; no effect on the motion")
    phi_rel: Real = variable("rad", state_select="prefer", description="angle of flange_b over flange_a")
    w_rel: Real = variable("rad/s", state_select="prefer", description="its speed")
    a_rel: Real = variable("rad/s^2", description="its acceleration")
    f_n: Real = variable("N", description="normal force")
    sa: Real = variable("N*m", description="path parameter of the friction characteristic")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w_rel == der(self.phi_rel)
        yield self.a_rel == der(self.w_rel)
        yield self.f_n == self.f_n_max * self.f_normalized
        torque = self.c_geo * self.f_n
        least = torque * at_zero(self.mu_pos)
        ahead = torque * interpolated(self.mu_pos, self.w_rel / self.w_unit)
        back = torque * interpolated(self.mu_pos, -self.w_rel / self.w_unit)
        most = self.peak * least
        yield from self.branches(self.w_rel, self.sa, least, most, self.w_unit, self.f_n <= 0)
        yield "stuck or sliding", self.J_path * self.a_rel == self.excess(self.sa, most)
        yield "friction torque", self.tau == self.friction(self.sa, ahead, back)
        yield self.P_loss == self.tau * self.w_rel
        yield from self.heat()


class OneWayClutch(Heating, Compliant):
    """A freewheel, with a clutch beside it: flange_b may run ahead of flange_a, it cannot fall behind.

    While ``w_rel`` > 0 the clutch rubs with c_geo mu(w_rel) f_n; at ``w_rel`` = 0 the two turn together as long as
    flange_a pulls or the clutch's friction at rest holds them. Without normal force it is a plain freewheel. Start
    with ``w_rel`` >= 0. Parameters as in ``Clutch``; ``hold_min`` [1] of the largest friction is the least torque at
    which a freewheel without normal force lets go, so that it does not chatter.
    Discrete: ``stuck``, ``locked``, ``start_forward`` [0 or 1]. Modelica Standard Library 4.1, OneWayClutch.
    """

    mu_pos: Points = ((0.0, 0.5),)
    f_normalized: Real = real_input("1", default=0.0, description="normal force over f_n_max; 0: freewheel")
    f_n_max: Real = parameter("N", min=0.0, description="largest normal force")
    c_geo: Real = parameter("m", default=1.0, min=0.0, description="radius at which the friction acts")
    peak: Real = parameter("1", default=1.0, min=1.0, description="largest coefficient at rest over mu(0)")
    hold_min: Real = parameter("1", default=1e-4, min=0.0, description="relative hysteresis")
    w_unit: Real = parameter("rad/s", default=1.0, description="what a speed of 1 in mu_pos means")
    J_path: Real = parameter("kg*m^2", default=1.0, description="scale of sa; no effect on the motion")
    phi_rel: Real = variable("rad", state_select="prefer", description="angle of flange_b over flange_a")
    w_rel: Real = variable("rad/s", state_select="prefer", description="its speed, never negative")
    a_rel: Real = variable("rad/s^2", description="its acceleration")
    f_n: Real = variable("N", description="normal force")
    sa: Real = variable("N*m", description="path parameter of the friction characteristic")
    stuck: Real = discrete("1", start=-1.0, description="1: no relative speed")
    start_forward: Real = discrete("1", description="1: sliding begins at speed zero")
    locked: Real = discrete("1", description="1: the flanges turn together")
    started: Real = discrete("1", description="1 after the initialisation")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w_rel == der(self.phi_rel)
        yield self.a_rel == der(self.w_rel)
        yield self.f_n == self.f_n_max * fmax(self.f_normalized, 0)
        mu_0 = at_zero(self.mu_pos)
        least = mu_0 * self.c_geo * self.f_n
        lowest = self.hold_min * mu_0 * self.c_geo * self.f_n_max
        most = fmax(fmax(self.peak, 1 + self.hold_min) * least, lowest)
        yield from self._branches(least, most)
        rubbing = interpolated(self.mu_pos, self.w_rel / self.w_unit) * self.c_geo * self.f_n
        yield "stuck or sliding", self.J_path * self.a_rel == smooth_if_else(self.locked, 0, self.sa - least)
        yield "friction torque", self.tau == smooth_if_else(self.locked, self.sa, rubbing)
        yield self.P_loss == smooth_if_else(self.stuck, 0, self.tau * self.w_rel)
        yield from self.heat()

    def _branches(self, least: SX, most: SX) -> Equations:
        held = all_of(self.started, self.locked)  # the speed is rounding, whose sign would make events
        ahead = truth(smooth_if_else(held, -self.w_unit, self.w_rel) > 0)
        over = truth(torn(any_of(self.locked, self.start_forward), self.sa)[0] > most)
        still_over = truth(torn(self.start_forward, self.sa)[0] > (1 - HYSTERESIS) * least)
        was_stuck, unknown = pre(self.stuck) == 1, pre(self.stuck) == -1
        leaving = any_of(over, all_of(pre(self.start_forward), still_over))
        yield self.started == (pre(self.stuck) != -1)
        yield self.start_forward == any_of(all_of(was_stuck, leaving), all_of(unknown, ahead))
        yield self.locked == all_of(was_stuck, logic_not(self.start_forward))
        yield self.stuck == any_of(self.locked, logic_not(ahead))
