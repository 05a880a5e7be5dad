"""Guides and brakes with dry friction and exact sticking, as in Modelica's Mechanics.Translational.Components."""

from __future__ import annotations

from casadi import SX, exp, logic_and

from arthur_acausal import (
    Equations,
    Real,
    der,
    discrete,
    parameter,
    real_input,
    reinit,
    variable,
    when,
)
from arthur_acausal.components.friction import Points, StickSlip, at_zero, interpolated
from arthur_acausal.components.heating import Heating
from arthur_acausal.components.translational.flange import Flange
from arthur_acausal.components.translational.support import Supported


class _Guide(StickSlip, Heating, Supported):
    """A rod through a housing that rubs on it: what guide friction and brake share.

    ``f`` is positive against positive ``v``, the rod's velocity over the housing.
    """

    flange_a = Flange()
    flange_b = Flange()
    v_unit: Real = parameter("m/s", default=1.0, description="what a speed of 1 in the table means")
    m_path: Real = parameter("kg", default=1.0, description="scale of sa; no effect on the motion")
    s: Real = variable("m", start=0.0, description="position of the rod over the housing")
    v: Real = variable("m/s", start=0.0, state_select="prefer", description="its velocity")
    a: Real = variable("m/s^2", description="its acceleration")
    f: Real = variable("N", description="friction force, positive against positive v")
    sa: Real = variable("N", description="path parameter of the friction characteristic")

    def rubbing(self, least: SX, most: SX, ahead: SX, back: SX, free: SX | None = None) -> Equations:
        """Yield all equations for the friction's values: at speed zero, and sliding ``ahead`` and ``back``."""
        yield self.s == self.flange_a.s - self.s_support()
        yield self.flange_b.s == self.flange_a.s
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield "force balance", self.flange_a.f + self.flange_b.f == self.f
        yield from self.branches(self.v, self.sa, least, most, self.v_unit, free)
        yield "stuck or sliding", self.m_path * self.a == self.excess(self.sa, most)
        yield "friction force", self.f == self.friction(self.sa, ahead, back)
        yield self.P_loss == self.f * self.v
        yield from self.heat()
        if self.use_support:
            yield self.support.f + self.flange_a.f + self.flange_b.f == 0


class SupportFriction(_Guide):
    """Coulomb friction in a guide: it slides, or it sticks until ``peak`` times the friction at rest is exceeded.

    ``f_pos``: tuple of (speed / ``v_unit``, force / ``f_unit``), speeds from 0 on; linear between and beyond. The
    friction of negative speeds mirrors it.
    """

    f_pos: Points = ((0.0, 1.0),)
    peak: Real = parameter(
        "1", default=1.0, min=1.0, description="largest force at rest over that of f_pos at 0"
    )
    f_unit: Real = parameter("N", default=1.0, description="what a force of 1 in f_pos means")

    def equations(self) -> Equations:
        least = self.f_unit * at_zero(self.f_pos)
        ahead = self.f_unit * interpolated(self.f_pos, self.v / self.v_unit)
        back = self.f_unit * interpolated(self.f_pos, -self.v / self.v_unit)
        yield from self.rubbing(least, self.peak * least, ahead, back)


class Brake(_Guide):
    """A brake between rod and housing, pressed together with the normal force f_n = f_n_max f_normalized.

    Sliding: f = c_geo mu(v) f_n against the motion; stuck: up to ``peak`` c_geo mu(0) f_n. Without normal force it
    is free (mode 2). ``mu_pos``: tuple of (speed / ``v_unit``, coefficient of friction), speeds from 0 on, linear
    between and beyond. ``c_geo`` [1]: the number of friction faces.
    """

    mu_pos: Points = ((0.0, 0.5),)
    f_normalized: Real = real_input("1", default=0.0, description="normal force over f_n_max; 0: free")
    f_n_max: Real = parameter("N", min=0.0, description="largest normal force")
    c_geo: Real = parameter("1", default=1.0, min=0.0, description="number of friction faces")
    peak: Real = parameter("1", default=1.0, min=1.0, description="largest coefficient at rest over mu(0)")
    f_n: Real = variable("N", description="normal force")

    def equations(self) -> Equations:
        yield self.f_n == self.f_n_max * self.f_normalized
        force = self.c_geo * self.f_n
        least = force * at_zero(self.mu_pos)
        ahead = force * interpolated(self.mu_pos, self.v / self.v_unit)
        back = force * interpolated(self.mu_pos, -self.v / self.v_unit)
        yield from self.rubbing(least, self.peak * least, ahead, back, self.f_n <= 0)


class MassWithFriction(StickSlip, Heating, Supported):
    """A sliding mass with Stribeck friction on its support: f = F_C + F_v |v| + F_St exp(-f_exp |v|), against v.

    At rest it sticks up to F_C + F_St. States: ``s`` [m], ``v`` [m/s]. ``f_exp`` [s/m] says how fast the Stribeck
    part decays. Armstrong-Helouvry (1991), "Control of machines with friction"; parameters as in Modelica's
    MassWithStopAndFriction, whose stops are the element ``EndStops``.
    """

    flange = Flange()
    m: Real = parameter("kg", min=0.0, description="mass")
    F_C: Real = parameter("N", default=0.0, min=0.0, description="Coulomb friction")
    F_v: Real = parameter("N*s/m", default=0.0, min=0.0, description="viscous friction")
    F_St: Real = parameter("N", default=0.0, min=0.0, description="Stribeck effect at rest")
    f_exp: Real = parameter("s/m", default=2.0, min=0.0, description="decay of the Stribeck effect")
    v_unit: Real = parameter("m/s", default=1.0, description="any speed")
    s: Real = variable("m", start=0.0, description="position")
    v: Real = variable("m/s", start=0.0, description="velocity")
    v_rel: Real = variable("m/s", description="velocity over the support")
    a_rel: Real = variable("m/s^2", description="acceleration over the support")
    f: Real = variable("N", description="friction force, positive against positive v_rel")
    sa: Real = variable("N", description="path parameter of the friction characteristic")

    def equations(self) -> Equations:
        yield self.s == self.flange.s
        yield self.v == der(self.s)
        yield self.v_rel == der(self.s - self.s_support())
        yield self.a_rel == der(self.v_rel)
        yield "Newton's second law", self.m * der(self.v) == self.flange.f - self.f
        most = self.F_C + self.F_St
        yield from self.branches(self.v_rel, self.sa, most, most, self.v_unit)
        yield "stuck or sliding", self.m * self.a_rel == self.excess(self.sa, most)
        yield (
            "friction force",
            self.f == self.friction(self.sa, self._law(self.v_rel), self._law(-self.v_rel)),
        )
        yield self.P_loss == self.f * self.v_rel
        yield from self.heat()
        if self.use_support:
            yield self.support.f == -self.f

    def _law(self, speed: SX) -> SX:
        return self.F_C + self.F_v * speed + self.F_St * exp(-self.f_exp * speed)


class MassWithStopAndFriction(StickSlip, Heating):
    """A sliding mass of length ``L`` [m] with Stribeck friction on the ground, between two hard stops.

    m v' = f_a + f_b - f, f = F_v v + (F_C + F_St exp(-f_exp |v|)) sign(v); at rest it sticks up to ``peak`` times
    F_C + F_St. Where an end reaches ``s_min`` or ``s_max`` [m] the mass stops without rebound, an event: v and s
    become those of the stop, and the stop holds it until a force pulls it off. States: ``s`` [m], ``v`` [m/s];
    ``stop`` [1]: -1 at the lower stop, 1 at the upper one, 0 between. Start between the stops. Beater (1999), Entwurf
    hydraulischer Maschinen, as in the Modelica Standard Library 4.1, MassWithStopAndFriction.
    """

    flange_a = Flange()
    flange_b = Flange()
    m: Real = parameter("kg", min=0.0, description="mass")
    L: Real = parameter("m", default=0.0, description="length from flange_a to flange_b")
    s_min: Real = parameter("m", default=-25.0)
    s_max: Real = parameter("m", default=25.0)
    F_C: Real = parameter("N", default=0.0, min=0.0, description="Coulomb friction")
    F_v: Real = parameter("N*s/m", default=0.0, min=0.0, description="viscous friction")
    F_St: Real = parameter("N", default=0.0, min=0.0, description="Stribeck effect at rest")
    f_exp: Real = parameter("s/m", default=2.0, min=0.0, description="decay of the Stribeck effect")
    peak: Real = parameter("1", default=1.001, min=1.0, description="largest force at rest over F_C + F_St")
    v_unit: Real = parameter("m/s", default=1.0, description="any speed")
    s: Real = variable("m", start=0.0, state_select="always", description="position of the middle")
    v: Real = variable("m/s", start=0.0, state_select="always", description="velocity")
    a: Real = variable("m/s^2", description="acceleration")
    f: Real = variable("N", description="friction force, positive against positive v")
    sa: Real = variable("N", description="path parameter of the friction characteristic")
    stop: Real = discrete("1", description="-1, 1 at a stop, 0 between")

    def equations(self) -> Equations:
        half = self.L / 2
        yield self.flange_a.s == self.s - half
        yield self.flange_b.s == self.s + half
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield "Newton's second law", self.m * self.a == self.flange_a.f + self.flange_b.f - self.f
        least = self.F_C + self.F_St
        most = self.peak * least
        yield from self.branches(self.v, self.sa, least, most, self.v_unit, stop=self.stop)
        yield "stuck or sliding", self.m * self.a == self.excess(self.sa, most)
        yield "friction force", self.f == self.friction(self.sa, self._law(self.v), self._law(-self.v))
        yield self.P_loss == self.f * self.v
        yield from self.heat()
        low, high = self.s_min + half, self.s_max - half
        yield (
            when(
                logic_and(self.s > high, self.v > 0), self.stop == 1, reinit(self.v, 0), reinit(self.s, high)
            )
            .elsewhen(
                logic_and(self.s < low, self.v < 0), self.stop == -1, reinit(self.v, 0), reinit(self.s, low)
            )
            .elsewhen(self.stop * self.direction < -0.5, self.stop == 0)
        )

    def _law(self, speed: SX) -> SX:
        return self.F_C + self.F_v * speed + self.F_St * exp(-self.f_exp * speed)
