"""Displacement machines: a pump at a given speed, and a motor on a shaft; both fixed or variable."""

from __future__ import annotations

from math import pi

from arthur_acausal import (
    Component,
    Equations,
    Real,
    der,
    parameter,
    real_input,
    real_output,
    smooth_if_else,
    variable,
)
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.laws import clamp
from arthur_acausal.components.hydraulic.ports import HydraulicPort
from arthur_acausal.components.rotational import Flange


class Displacing(Component):
    """What displacement machines share: ``D`` [m^3 a turn] times ``setting`` [1] passes from port_a to port_b.

    ``G_leak`` [m^3/(s Pa)] is the laminar leakage between the ports. The fluid is displaced at its reference density.
    """

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    fluid: Fluid = Fluid()
    setting: Real = real_input("1", default=1.0, description="displacement over D, -1 to 1")
    D: Real = parameter("m^3", min=0.0, description="displacement a turn")
    G_leak: Real = parameter("m^3/(s*Pa)", default=0.0, min=0.0, description="leakage")
    q: Real = variable("m^3/s", nominal=1e-4, display="L/min", description="flow from port_a to port_b")
    dp: Real = variable(
        "Pa", nominal=1e7, display="bar", description="pressure at port_a less that at port_b"
    )
    q_leak: Real = variable(
        "m^3/s", nominal=1e-6, display="L/min", description="leakage from port_a to port_b"
    )

    def equations(self) -> Equations:
        a, b = self.port_a, self.port_b
        yield self.dp == a.p - b.p
        yield self.q_leak == self.G_leak * self.dp
        yield a.q == self.q
        yield "mass balance", a.q + b.q == 0


class SpeedPump(Displacing):
    """A pump turned at the speed of a signal: q = D setting w/(2 pi), less leakage (Merritt 1967, ch. 4).

    ``w`` [rad/s]. port_a is the suction side for a positive flow. Where the pressure there falls to ``p_fill`` [Pa]
    the pump fills only in part, and not at all at zero pressure, so that it never draws a vacuum. ``P`` [W]: power
    given to the fluid. Either direction.
    """

    w: Real = real_input("rad/s", default=0.0, display="rpm")
    p_fill: Real = parameter("Pa", default=1e3, min=1e-3, description="suction pressure that fills it")
    fill: Real = variable("1", start=1.0, description="share of the displacement that fills")
    P: Real = real_output("W", description="power given to the fluid")

    def equations(self) -> Equations:
        yield from super().equations()
        ideal = self.D * self.setting * self.w / (2 * pi)
        suction = smooth_if_else(ideal > 0, self.port_a.p, self.port_b.p)
        yield "filling", self.fill == clamp(suction / self.p_fill, 0, 1)
        yield "displacement", self.q == ideal * self.fill + self.q_leak
        yield self.P == -self.q * self.dp


class HydraulicMotor(Displacing):
    """A motor, or a pump where its shaft is turned: tau = D setting dp/(2 pi) - b w (Merritt 1967, ch. 4).

    A flow from port_a to port_b turns the flange to positive phi. No inertia. ``P_loss`` [W]: friction and leakage.
    """

    flange = Flange()
    b: Real = parameter("N*m*s/rad", default=0.0, min=0.0, description="viscous friction")
    w: Real = variable("rad/s", nominal=100.0, display="rpm", description="speed")
    P_loss: Real = real_output("W", description="power turned to heat: friction and leakage")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w == der(self.flange.phi)
        per_rad = self.D * self.setting / (2 * pi)
        yield "displacement", self.q == per_rad * self.w + self.q_leak
        yield "torque", self.flange.tau == self.b * self.w - per_rad * self.dp
        yield self.P_loss == self.b * self.w**2 + self.q_leak * self.dp
