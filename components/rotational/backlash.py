"""Play between two shafts."""

from __future__ import annotations

from casadi import fmax, fmin

from arthur_acausal import Equations, Real, der, if_else, parameter, smooth_if_else, variable
from arthur_acausal.components.heating import Heating
from arthur_acausal.components.rotational.elements import Compliant


class ElastoBacklash(Heating, Compliant):
    """A play of ``b`` [rad] in series with a spring ``c`` and damper ``d`` that act while there is contact.

    In contact the torque is c depth + d w_rel, where the damper neither pulls nor exceeds the spring's own torque in
    amount, so that the torque is continuous and never sticks. Onset and end of contact are events. Modelica Standard
    Library 4.1, Mechanics.Rotational.Components.ElastoBacklash.
    """

    c: Real = parameter("N*m/rad", min=0.0)
    d: Real = parameter("N*m*s/rad", default=0.0, min=0.0)
    b: Real = parameter("rad", default=0.0, min=0.0, description="total play, half of it on either side")
    phi_rel0: Real = parameter("rad", default=0.0, description="angle in the middle of the play")
    w_rel: Real = variable("rad/s", description="speed of flange_b relative to flange_a")
    depth: Real = variable("rad", description="deflection in contact; 0 within the play")
    tau_c: Real = variable("N*m", description="spring's part")
    tau_d: Real = variable("N*m", description="damper's part")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w_rel == der(self.phi_rel)
        deflection, half = self.phi_rel - self.phi_rel0, self.b / 2
        beyond = if_else(deflection < -half, deflection + half, 0)
        yield "play", self.depth == if_else(deflection > half, deflection - half, beyond)
        yield "spring in contact", self.tau_c == self.c * self.depth
        wanted = self.d * self.w_rel
        pushing = fmax(fmin(wanted, self.tau_c), -self.tau_c)
        pulling = fmin(fmax(wanted, self.tau_c), -self.tau_c)
        yield "damper in contact", self.tau_d == smooth_if_else(self.depth > 0, pushing, pulling)
        yield self.tau == self.tau_c + self.tau_d
        yield self.P_loss == self.tau_d * self.w_rel
        yield from self.heat()
