"""What spool valves are made of: a spool that follows its command, and the metering edges that it opens."""

from __future__ import annotations

from casadi import SX, fabs, fmax, sqrt

from arthur_acausal import (
    Component,
    Equations,
    Real,
    der,
    if_else,
    parameter,
    real_input,
    real_output,
    variable,
)
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.laws import clamp, turbulent_root
from arthur_acausal.components.hydraulic.ports import HydraulicPort
from arthur_acausal.components.hydraulic.two_port import TwoPort


class Spool(Component):
    """A spool with its actuator: x'' + 2 zeta omega x' + omega^2 x = omega^2 x_command (Merritt 1967, ch. 7).

    States: position ``x`` [m], velocity ``v`` [m/s]. x_command = ``command`` [1] times ``x_max`` [m], limited to
    ``x_min``..``x_max``. ``switched`` (structural): the command is logical, and the spool goes to x_max where it is
    above 0.5, to x_min elsewhere; an event. ``x_back`` = -x moves the edges that open the other way. Valid where
    flow forces are small beside the actuator's.
    """

    switched: bool = False
    command: Real = real_input("1", default=0.0, description="position over x_max, or on and off")
    x_max: Real = parameter("m", default=1e-3, min=0.0)
    x_min: Real = parameter("m", default=lambda self: -self.x_max)
    omega: Real = parameter("rad/s", default=1000.0, min=0.0, description="natural frequency; assumed")
    zeta: Real = parameter("1", default=0.7, min=0.0, description="damping ratio; assumed")
    x: Real = real_output("m", nominal=1e-3)
    x_back: Real = real_output("m", nominal=1e-3, description="-x")
    position: Real = variable("m", start=0.0, fixed=True, nominal=1e-3)
    v: Real = variable("m/s", start=0.0, fixed=True, nominal=1.0)

    def equations(self) -> Equations:
        if self.switched:
            wanted = if_else(self.command > 0.5, self.x_max, self.x_min)
        else:
            wanted = clamp(self.command * self.x_max, self.x_min, self.x_max)
        yield self.v == der(self.position)
        restoring = self.omega**2 * (wanted - self.position)
        yield "spool dynamics", der(self.v) == restoring - 2 * self.zeta * self.omega * self.v
        yield self.x == self.position
        yield self.x_back == -self.position


class MeteringEdge(TwoPort):
    """A sharp-edged slot that a spool opens: q = C_d width opening(x) sqrt(2 dp/rho) (Merritt 1967, ch. 5).

    opening = max(x - overlap, 0), with the spool's position ``x`` [m] as signal. ``overlap`` [m] is negative for an
    underlapped edge; -x_max makes one that the spool closes. ``width`` [m]: the part of the circumference that
    opens. Linear below about ``dp_small`` [Pa]. Either direction of flow.
    """

    x: Real = real_input("m", default=0.0, nominal=1e-3)
    width: Real = parameter("m", default=0.02, min=0.0)
    overlap: Real = parameter("m", default=0.0)
    C_d: Real = parameter("1", default=0.67, min=0.0)
    dp_small: Real = parameter("Pa", default=1e3, min=0.0)

    def opening(self) -> SX:
        """Return how far [m] the edge is open."""
        return fmax(self.x - self.overlap, 0)

    def equations(self) -> Equations:
        yield from super().equations()
        gain = self.C_d * self.width * self.opening() * sqrt(2 / self.fluid.rho)
        yield "orifice law", self.q == gain * turbulent_root(self.dp, self.dp_small)


class CentreEdge(MeteringEdge):
    """An edge that is open while the spool is in the middle: opening = x_max - (abs(x) - overlap) within 0..x_max."""

    x_max: Real = parameter("m", default=1e-3, min=0.0, description="where it is closed, less the overlap")

    def opening(self) -> SX:
        return self.x_max - clamp(fabs(self.x) - self.overlap, 0, self.x_max)


class LoadSelector(Component):
    """Passages in a spool that join ``port_l`` to ``port_a`` where x > 0 and to ``port_b`` where x < 0.

    Laminar, of the conductance ``G`` [m^3/(s Pa)], changing over within +-``x_switch`` [m]: they signal the load's
    pressure to a pump or a compensator (load sensing).
    """

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    port_l = HydraulicPort()
    fluid: Fluid = Fluid()
    x: Real = real_input("m", default=0.0, nominal=1e-3)
    G: Real = parameter("m^3/(s*Pa)", default=1e-9, min=0.0)
    x_switch: Real = parameter("m", default=1e-6, min=0.0)
    share: Real = variable("1", description="1 where port_a is joined, 0 where port_b is")
    P_loss: Real = real_output("W", description="power turned to heat")

    def equations(self) -> Equations:
        a, b, load = self.port_a, self.port_b, self.port_l
        yield self.share == clamp(0.5 + self.x / (2 * self.x_switch), 0, 1)
        yield "passage from a", a.q == self.G * self.share * (a.p - load.p)
        yield "passage from b", b.q == self.G * (1 - self.share) * (b.p - load.p)
        yield "mass balance", a.q + b.q + load.q == 0
        loss = self.fluid.throttling_loss
        yield self.P_loss == loss(a.q, a.p, load.p) + loss(b.q, b.p, load.p)
