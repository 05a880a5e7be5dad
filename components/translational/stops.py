"""Stops: elements that push only while they are compressed."""

from __future__ import annotations

import casadi

from arthur_acausal import (
    Component,
    Equations,
    Real,
    der,
    discrete,
    if_else,
    parameter,
    reinit,
    variable,
    when,
)
from arthur_acausal.components.heating import Heating
from arthur_acausal.components.translational.elements import Compliant
from arthur_acausal.components.translational.flange import Flange


class ElastoGap(Heating, Compliant):
    """A spring and damper that act in compression only; it never pulls.

    While s_rel > s_rel0 [m] there is no force. In contact the force is c (s_rel - s_rel0) + d v_rel,
    limited so that the damper neither pulls nor exceeds the spring's own force in amount (as in the
    Modelica Standard Library 4.1, Mechanics.Translational.Components.ElastoGap). Contact onset and end are
    events.
    """

    c: Real = parameter("N/m", min=0.0)
    d: Real = parameter("N*s/m", default=0.0, min=0.0)
    s_rel0: Real = parameter("m", default=0.0)
    v_rel: Real = variable("m/s", description="velocity of flange_b relative to flange_a")
    f_c: Real = variable("N", description="spring's part, negative in compression")
    f_d: Real = variable("N", description="damper's part")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v_rel == der(self.s_rel)
        depth = self.s_rel - self.s_rel0
        yield "spring in contact", self.f_c == if_else(depth < 0, self.c * depth, 0)
        limited = casadi.fmin(casadi.fmax(self.d * self.v_rel, self.f_c), -self.f_c)
        yield "damper in contact", self.f_d == limited
        yield self.f == self.f_c + self.f_d
        yield self.P_loss == self.f_d * self.v_rel
        yield from self.heat()


class EndStops(Component):
    """Two stops on the ground that keep a flange between ``s_min`` and ``s_max`` [m]: springs with dampers.

    Beyond a stop the force is c depth + d v, where the damper neither pulls nor exceeds the spring's own force in
    amount. Contact onset and end are events. ``f`` [N]: force on the flange, positive at the lower stop.
    """

    flange = Flange()
    s_min: Real = parameter("m")
    s_max: Real = parameter("m")
    c: Real = parameter("N/m", default=1e8, min=0.0, description="stiffness of a stop")
    d: Real = parameter("N*s/m", default=1e4, min=0.0, description="damping of a stop")
    v: Real = variable("m/s", description="velocity of the flange")
    depth: Real = variable(
        "m", description="deflection, positive at the upper stop, negative at the lower one"
    )
    f: Real = variable("N", description="force on the flange")

    def equations(self) -> Equations:
        s = self.flange.s
        yield self.v == der(s)
        below = if_else(s < self.s_min, s - self.s_min, 0)
        yield self.depth == if_else(s > self.s_max, s - self.s_max, below)
        spring, wanted = self.c * self.depth, self.d * self.v
        size = casadi.fabs(spring)
        yield "stops", self.f == -(spring + casadi.fmin(casadi.fmax(wanted, -size), size))
        yield self.flange.f + self.f == 0


class StoppedMass(Component):
    """A sliding mass between two rigid stops, at which it comes to rest without rebound.

    States: ``s`` [m], ``v`` [m/s]. m v' = f until s passes ``s_min`` or ``s_max`` [m]; there v becomes 0, an event,
    and the stop holds the mass until the force pulls it away. ``stop`` [1]: -1 at the lower stop, 1 at the upper one,
    0 between. The kinetic energy at the impact is lost (plastic impact). Starts between the stops.
    """

    flange = Flange()
    m: Real = parameter("kg", min=0.0, description="mass")
    s_min: Real = parameter("m")
    s_max: Real = parameter("m")
    s: Real = variable("m", start=0.0, description="position", state_select="always")
    v: Real = variable("m/s", start=0.0, description="velocity", state_select="always")
    stop: Real = discrete("1", description="-1, 1 at a stop, 0 between")
    f_stop: Real = variable("N", description="force of the stops")

    def equations(self) -> Equations:
        f = self.flange.f
        yield self.s == self.flange.s
        yield self.v == der(self.s)
        yield "Newton's second law", self.m * der(self.v) == f + self.f_stop
        yield "stops", self.f_stop == -casadi.fabs(self.stop) * f
        low = casadi.logic_and(self.s < self.s_min, self.v < 0)
        high = casadi.logic_and(self.s > self.s_max, self.v > 0)
        away = self.stop * f < 0
        yield (
            when(low, self.stop == -1, reinit(self.v, 0))
            .elsewhen(high, self.stop == 1, reinit(self.v, 0))
            .elsewhen(away, self.stop == 0)
        )
