"""Stops: elements that push only while they are compressed."""

from __future__ import annotations

import casadi

from arthur_acausal import Equations, Real, der, if_else, parameter, variable
from arthur_acausal.components.translational.elements import Compliant


class ElastoGap(Compliant):
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
