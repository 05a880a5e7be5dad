"""Double-acting cylinder."""

from __future__ import annotations

from typing import Literal

from casadi import SX, exp, fabs, tanh

from arthur_acausal import Component, Equations, Real, der, parameter, real_output, variable
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.laws import stop_energy, stop_force
from arthur_acausal.components.hydraulic.ports import HydraulicPort
from arthur_acausal.components.translational import Flange

Efficiency = Literal["friction", "printed"]


class Cylinder(Component):
    """A double-acting cylinder with a rod on side B, elastic stops and friction: ARTHuR report, section 5.6.

    States: piston position ``y`` [m] (0 in the middle, positive extends), velocity ``v`` [m/s], chamber
    pressures ``p_A``, ``p_B`` [Pa]. ``flange`` is the rod's end: a load that pushes against the piston has
    flange.f < 0 here. m v' = F_p - F_friction + F_stop + flange.f with F_p = p_A A_A - p_B A_B (5.44,
    5.51); the chambers follow the conservation of mass (5.39 to 5.43, with the density's change). The
    damping c of the seals is in F_friction.

    Structural options:

    - ``efficiency``: "friction", the default: (1 - eta) |F_p| acts against the motion, rounded by
      tanh(v/v_small), so that it always takes energy; "printed": the force is eta F_p (5.38), which gives
      energy back when driven backwards.
    - ``stribeck``: adds (F_C + (F_S - F_C) exp(-(v/v_S)^2)) tanh(v/v_small), Coulomb friction ``F_C``,
      break-away ``F_S`` [N], Stribeck velocity ``v_S`` [m/s] (Armstrong-Helouvry, Dupont and Canudas de
      Wit, Automatica 30, 1994).
    - ``inertia``: False leaves the piston's mass out, where it is counted elsewhere (as armature of a
      joint, say).
    - ``stop_events``: True makes contact with a stop an event; the stops' force is continuous, so the
      default is False.

    Parameters: Table 10. ``A_B`` is 0.75 A_A in the report's code. ``G_leak`` [m^3/(s Pa)]: laminar leakage
    past the piston (pi d c_r^3/(12 mu L); Merritt 1967, ch. 3). Valid while the chambers' volumes stay
    positive, 9 mm into a stop.
    """

    efficiency: Efficiency = "friction"
    stribeck: bool = False
    inertia: bool = True
    stop_events: bool = False
    port_a = HydraulicPort()
    port_b = HydraulicPort()
    flange = Flange()
    fluid: Fluid = Fluid()
    A_A: Real = parameter("m^2", default=7.13e-5, min=0.0, description="piston area, side A")
    A_B: Real = parameter("m^2", default=5.35e-5, min=0.0, description="annular area, side B")
    V_A0: Real = parameter("m^3", default=6.5e-7, min=0.0, description="volume A at y_min")
    V_B0: Real = parameter("m^3", default=6.5e-7, min=0.0, description="volume B at y_max")
    y_min: Real = parameter("m", default=-0.035, description="position of the stop, retracted")
    y_max: Real = parameter("m", default=0.035, description="position of the stop, extended")
    m: Real = parameter("kg", default=0.05, min=0.0, description="mass of piston and rod")
    c: Real = parameter("N*s/m", default=10.0, min=0.0, description="damping of the seals")
    k: Real = parameter("N/m", default=1.436e6, min=0.0, description="stiffness of the stops, eq. 5.48")
    eta: Real = parameter("1", default=0.95, min=0.0, max=1.0, description="efficiency")
    v_small: Real = parameter("m/s", default=5e-3, min=0.0, description="friction is full above about this")
    F_C: Real = parameter("N", default=10.0, min=0.0, description="Coulomb friction (stribeck); assumed")
    F_S: Real = parameter("N", default=20.0, min=0.0, description="break-away friction (stribeck); assumed")
    v_S: Real = parameter("m/s", default=0.02, min=0.0, description="Stribeck velocity; assumed")
    G_leak: Real = parameter("m^3/(s*Pa)", default=0.0, min=0.0, description="leakage past the piston")
    y: Real = variable("m", start=0.0, nominal=0.01, display="mm", description="piston position")
    v: Real = variable("m/s", start=0.0, nominal=0.1, description="piston velocity")
    p_A: Real = variable("Pa", start=1e5, nominal=1e7, display="bar", description="pressure in chamber A")
    p_B: Real = variable("Pa", start=1e5, nominal=1e7, display="bar", description="pressure in chamber B")
    V_A: Real = variable("m^3", nominal=1e-6, description="volume of chamber A")
    V_B: Real = variable("m^3", nominal=1e-6, description="volume of chamber B")
    q_leak: Real = variable("m^3/s", nominal=1e-6, description="leakage from A to B")
    F_p: Real = variable("N", nominal=100.0, description="force of the pressures, positive extends")
    F_friction: Real = variable("N", nominal=100.0, description="friction, positive against extension")
    F_stop: Real = variable("N", nominal=100.0, description="force of the stops")
    m_fluid: Real = variable("kg", nominal=1e-3, description="mass of the fluid in both chambers")
    P_loss: Real = real_output("W", description="power turned to heat: friction and leakage")
    E_stored: Real = variable("J", description="kinetic, stop springs, compressed fluid")

    def build(self) -> None:
        check_choice(self, "efficiency", Efficiency)

    def equations(self) -> Equations:
        a, b, fluid = self.port_a, self.port_b, self.fluid
        yield self.y == self.flange.s
        yield self.v == der(self.y)
        yield self.p_A == a.p
        yield self.p_B == b.p
        yield self.V_A == self.V_A0 + self.A_A * (self.y - self.y_min)
        yield self.V_B == self.V_B0 + self.A_B * (self.y_max - self.y)
        yield self.q_leak == self.G_leak * (self.p_A - self.p_B)
        rate_A = fluid.pressure_rate(self.p_A, a.q - self.q_leak, self.V_A, self.A_A * self.v)
        rate_B = fluid.pressure_rate(self.p_B, b.q + self.q_leak, self.V_B, -self.A_B * self.v)
        yield "mass balance, chamber A", der(self.p_A) == rate_A
        yield "mass balance, chamber B", der(self.p_B) == rate_B
        yield self.F_p == self.p_A * self.A_A - self.p_B * self.A_B
        yield "friction", self.F_friction == self.friction()
        yield "stops", self.F_stop == stop_force(self.y, self.y_min, self.y_max, self.k, self.stop_events)
        force = self.F_p - self.F_friction + self.F_stop + self.flange.f
        yield "Newton's second law", (self.m * der(self.v) if self.inertia else SX(0.0)) == force
        yield from self._audit()

    def friction(self) -> SX:
        """Return the force [N] of seals, efficiency and Stribeck friction, positive against extension."""
        direction = tanh(self.v / self.v_small)
        share = self.F_p if self.efficiency == "printed" else fabs(self.F_p) * direction
        force = self.c * self.v + (1 - self.eta) * share
        if self.stribeck:
            force = force + (self.F_C + (self.F_S - self.F_C) * exp(-((self.v / self.v_S) ** 2))) * direction
        return force

    def _audit(self) -> Equations:
        fluid = self.fluid
        yield self.m_fluid == fluid.density(self.p_A) * self.V_A + fluid.density(self.p_B) * self.V_B
        leakage = fluid.throttling_loss(self.q_leak, self.p_A, self.p_B)
        yield "losses", self.P_loss == self.F_friction * self.v + leakage
        kinetic = self.m * self.v**2 / 2 if self.inertia else SX(0.0)
        in_fluid = self.V_A * fluid.energy_density(self.p_A) + self.V_B * fluid.energy_density(self.p_B)
        yield self.E_stored == kinetic + stop_energy(self.y, self.y_min, self.y_max, self.k) + in_fluid
