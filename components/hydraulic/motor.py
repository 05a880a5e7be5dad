"""Brushless motor that drives a pump."""

from __future__ import annotations

from typing import Literal

from casadi import SX, fmax, fmin

from arthur_acausal import Component, Equations, Real, der, parameter, real_input, real_output, variable
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.rotational import Flange

LINE_TO_LINE = (2 / 3) ** 0.5
"""K_e/K_T of eq. 5.4, with K_e in V s/rad."""

MotorLaw = Literal["line", "dc"]
Clamp = Literal["both", "above", "none"]


class BrushlessMotor(Component):
    """A brushless DC motor behind an ideal drive: ARTHuR report, section 5.1.

    V = R_LL I + K_e w (5.1), torque K_T I (5.3), J w' = K_T I - b_m w + flange.tau (5.5). State: ``w``
    [rad/s] (and the angle). ``V`` [V] is the voltage that the drive is asked for. The drive limits the
    current; while it does, the terminal voltage is ``V_t`` = R_LL I + K_e w, so that the electrical power
    stays true.

    Structural options:

    - ``law``: "line", the default: K_e = sqrt(2/3) K_T (5.4) with line-to-line voltage and line current,
      whose power is P_el = sqrt(3/2) V_t I (with V I, as the report has it, the shaft would give more than
      it gets); "dc": a consistent DC motor, K_e = K_T and P_el = V_t I.
    - ``clamp``: "both", the default, keeps the current in 0..I_max (no regeneration); "above" only below
      I_max, as the report's listing; "none".

    Parameters: Table 8 and Table 6 (J). No inductance, no iron loss. The clamp is continuous and makes no
    event.
    """

    law: MotorLaw = "line"
    clamp: Clamp = "both"
    flange = Flange()
    V: Real = real_input("V", default=0.0, nominal=40.0, description="voltage asked for")
    P_el: Real = real_output("W", nominal=1e3, description="electrical power taken in")
    K_T: Real = parameter("N*m/A", default=0.078, min=0.0, description="torque constant")
    K_e: Real = parameter(
        "V*s/rad",
        default=lambda self: self.K_T * (LINE_TO_LINE if self.law == "line" else 1.0),
        description="back-emf constant, eq. 5.4",
    )
    R_LL: Real = parameter("ohm", default=0.165, min=0.0, description="line-to-line resistance")
    b_m: Real = parameter("N*m*s/rad", default=7.14e-6, min=0.0, description="friction of the bearings")
    J: Real = parameter("kg*m^2", default=3.147e-4, min=0.0, description="moment of inertia of the rotor")
    I_max: Real = parameter("A", default=50.0, min=0.0, description="limit of the current")
    phi: Real = variable("rad", start=0.0, description="angle of the shaft")
    w: Real = variable("rad/s", start=0.0, nominal=500.0, display="rpm", description="speed")
    I: Real = variable("A", nominal=10.0, description="line current")
    V_t: Real = variable("V", nominal=10.0, description="terminal voltage")
    tau: Real = variable("N*m", description="torque of the rotor's field")
    P_copper: Real = real_output("W", description="power turned to heat in the windings")
    P_friction: Real = real_output("W", description="power turned to heat in the bearings")
    E_stored: Real = variable("J", description="kinetic energy")

    def build(self) -> None:
        check_choice(self, "law", MotorLaw)
        check_choice(self, "clamp", Clamp)

    def equations(self) -> Equations:
        power = 1 / LINE_TO_LINE if self.law == "line" else 1.0
        yield self.phi == self.flange.phi
        yield self.w == der(self.phi)
        yield "current", self.I == self.limited((self.V - self.K_e * self.w) / self.R_LL)
        yield "voltage balance", self.V_t == self.R_LL * self.I + self.K_e * self.w
        yield self.tau == self.K_T * self.I
        yield "Newton's second law", self.J * der(self.w) == self.tau - self.b_m * self.w + self.flange.tau
        yield self.P_el == power * self.V_t * self.I
        yield self.P_copper == power * self.R_LL * self.I**2
        yield self.P_friction == self.b_m * self.w**2
        yield self.E_stored == self.J * self.w**2 / 2

    def limited(self, current: SX) -> SX:
        """Return the current [A] within the drive's limits."""
        if self.clamp == "none":
            return current
        below = fmin(current, self.I_max)
        return below if self.clamp == "above" else fmax(below, 0)
