"""Hydraulic line with waves, as a chain of volumes and inertances."""

from __future__ import annotations

from math import pi
from typing import Literal

from casadi import fabs, fmax

from arthur_acausal import Component, Equations, Real, connect, der, parameter, variable
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.ports import HydraulicPort
from arthur_acausal.components.hydraulic.resistance import RE_TURBULENT
from arthur_acausal.components.hydraulic.volume import Volume

LineFriction = Literal["none", "laminar", "turbulent"]


class LineSegment(Component):
    """A piece of line whose fluid has mass and friction, but does not compress.

    State: ``q`` [m^3/s]. rho L/A q' = dp - dp_friction. ``friction`` (structural): "none", "laminar" (Hagen
    and Poiseuille) or "turbulent" (the greater of laminar and Blasius, see ``Pipe``). Steady friction, also
    while the flow changes.
    """

    friction: LineFriction = "laminar"
    port_a = HydraulicPort()
    port_b = HydraulicPort()
    fluid: Fluid = Fluid()
    L: Real = parameter("m", min=0.0)
    d: Real = parameter("m", min=0.0)
    q: Real = variable(
        "m^3/s", start=0.0, nominal=1e-4, display="L/min", description="flow from port_a to port_b"
    )
    dp_friction: Real = variable("Pa", nominal=1e5, display="bar", description="pressure drop by friction")
    P_loss: Real = variable("W", description="power turned to heat by friction")
    E_stored: Real = variable("J", description="kinetic energy")

    def build(self) -> None:
        check_choice(self, "friction", LineFriction)

    def equations(self) -> Equations:
        a, b = self.port_a, self.port_b
        inertance = self.fluid.rho * self.L / (pi * self.d**2 / 4)
        yield self.q == a.q
        yield "mass balance", a.q + b.q == 0
        yield "momentum balance", inertance * der(self.q) == a.p - b.p - self.dp_friction
        if self.friction == "none":
            yield self.dp_friction == 0
        else:
            laminar = 128 * self.fluid.mu * self.L / (pi * self.d**4) * self.q
            Re = 4 * self.q / (pi * self.d * self.fluid.nu)
            factor = fmax(1, fabs(Re) / RE_TURBULENT) ** 0.75 if self.friction == "turbulent" else 1.0
            yield "friction", self.dp_friction == laminar * factor
        yield self.P_loss == self.dp_friction * self.q
        yield self.E_stored == inertance * self.q**2 / 2


class Line(Component):
    """A round line of ``n`` compressible cells joined by inertances with friction (Wylie and Streeter 1993).

    ``volume_a``, ``volume_b`` (structural): what stands at an end. False, the default, is half an
    inertance: the right one beside a volume or a pressure source. True is half a volume: the right one
    beside a flow source, a closed end, or a valve that shuts at once. ``cells`` are the volumes,
    ``segments`` the inertances; a cell is dx = L/n_dx long, n_dx being n, or n - 1/2 where just one end is
    a volume, or n - 1 where both are.

    Parameters: ``L`` [m], ``d`` [m]. Waves travel at sqrt(beta/rho); the first mode of the chain with one
    end open is 2 sqrt(beta/rho)/dx sin(pi dx/(4 L)) rad/s. Valid up to about n/10 modes; steady friction
    only.
    """

    n: int = 10
    friction: LineFriction = "laminar"
    volume_a: bool = False
    volume_b: bool = False
    port_a = HydraulicPort()
    port_b = HydraulicPort()
    fluid: Fluid = Fluid()
    L: Real = parameter("m", min=0.0)
    d: Real = parameter("m", min=0.0)

    def build(self) -> None:
        n, halves = self.n, 0.5 * self.volume_a + 0.5 * self.volume_b
        dx = self.L / (n - halves)
        V = pi * self.d**2 / 4 * dx
        shares = [
            1 - 0.5 * (self.volume_a and i == 0) - 0.5 * (self.volume_b and i == n - 1) for i in range(n)
        ]
        self.cells = [Volume(V=V * share) for share in shares]
        lengths = [0.5] * (not self.volume_a) + [1.0] * (n - 1) + [0.5] * (not self.volume_b)
        self.segments = [LineSegment(friction=self.friction, L=dx * share, d=self.d) for share in lengths]

    def equations(self) -> Equations:
        nodes = [cell.port for cell in self.cells]
        if self.volume_a:
            yield connect(self.port_a, nodes[0])
        else:
            nodes.insert(0, self.port_a)
        if self.volume_b:
            yield connect(self.port_b, nodes[-1])
        else:
            nodes.append(self.port_b)
        for segment, left, right in zip(self.segments, nodes, nodes[1:], strict=False):
            yield connect(left, segment.port_a)
            yield connect(segment.port_b, right)
