"""Four-way servo valve."""

from __future__ import annotations

from math import pi
from typing import Literal

from casadi import SX, fmax, sqrt

from arthur_acausal import Component, Equations, Real, der, parameter, real_input, real_output, variable
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.laws import clamp, exact_root, turbulent_root
from arthur_acausal.components.hydraulic.ports import HydraulicPort

ValveLaw = Literal["laminar transition", "listing"]
Spool = Literal["ideal", "second order"]


class ServoValve(Component):
    """A spool valve with four lands: ARTHuR report, section 5.5 (Merritt 1967, ch. 5).

    Ports: supply ``port_p``, return ``port_t``, work ports ``port_a``, ``port_b``. A current I > 0 opens P
    to A and B to T, I < 0 P to B and A to T; each open land passes K_V |I| sqrt(2/rho) sign(dp) sqrt|dp|,
    so flow also goes backwards where the load drives it (eq. 5.36, 5.37, with the sign outside of the
    root). No event: at I = 0 all flows are zero.

    Structural options:

    - ``law``: "laminar transition", the default, is linear below about ``dp_small`` [Pa]; "listing" keeps
      the root (6.3.6), with a finite slope at dp = 0 in the Jacobian.
    - ``spool``: "ideal", the default (x = I/I_rated, unlimited), or "second order": x'' + 2 zeta omega x' +
      omega^2 x = omega^2 I/I_rated, with I/I_rated limited to +-1 (Merritt 1967, ch. 7: a servo valve's
      data sheet response). The natural frequency is ``f_spool`` [Hz as 1/s], the damping ratio
      ``zeta_spool``.

    Parameters: ``K_V`` [m^2/A], the gain of 5.35, by default from the rated flow ``q_rated`` [m^3/s] at the
    rated valve drop ``dp_rated`` [Pa] (both lands) and current ``I_rated`` [A] (7.5 L/min at 70 bar, 1 A:
    assumed, the report's value is redacted); ``overlap`` [1] of each land as a share of the rated stroke
    (negative: underlap); ``G_leak`` [m^3/(s Pa)], the laminar leakage across each land (Merritt 1967, ch. 5).
    """

    law: ValveLaw = "laminar transition"
    spool: Spool = "ideal"
    port_p = HydraulicPort()
    port_t = HydraulicPort()
    port_a = HydraulicPort()
    port_b = HydraulicPort()
    fluid: Fluid = Fluid()
    I: Real = real_input("A", default=0.0, nominal=0.1, description="current; positive extends (P to A)")
    q_rated: Real = parameter("m^3/s", default=7.5e-3 / 60, min=0.0, display="L/min", description="assumed")
    dp_rated: Real = parameter("Pa", default=70e5, min=0.0, display="bar", description="both lands; assumed")
    I_rated: Real = parameter("A", default=1.0, min=0.0, description="assumed")
    K_V: Real = parameter(
        "m^2/A",
        default=lambda self: self.q_rated / (self.I_rated * sqrt(self.dp_rated / self.fluid.rho)),
        description="valve gain of eq. 5.35",
    )
    dp_small: Real = parameter("Pa", default=1e4, min=0.0, description="laminar below about this drop")
    overlap: Real = parameter("1", default=0.0, description="of each land, over the rated stroke")
    G_leak: Real = parameter("m^3/(s*Pa)", default=0.0, min=0.0, description="leakage of each land")
    f_spool: Real = parameter("Hz", default=250.0, min=0.0, description="natural frequency; assumed")
    zeta_spool: Real = parameter("1", default=0.7, min=0.0, description="damping ratio; assumed")
    x: Real = variable("1", start=0.0, nominal=0.1, description="spool position over the rated one")
    v: Real = variable("1/s", start=0.0, nominal=500.0, description="spool velocity over the rated stroke")
    q_pa: Real = variable("m^3/s", nominal=1e-5, description="flow from P to A")
    q_pb: Real = variable("m^3/s", nominal=1e-5, description="flow from P to B")
    q_at: Real = variable("m^3/s", nominal=1e-5, description="flow from A to T")
    q_bt: Real = variable("m^3/s", nominal=1e-5, description="flow from B to T")
    P_loss: Real = real_output("W", description="power turned to heat in the four lands")

    def build(self) -> None:
        check_choice(self, "law", ValveLaw)
        check_choice(self, "spool", Spool)

    def land(self, x: SX, dp: SX) -> SX:
        """Return the flow [m^3/s] at the drop ``dp`` through a land that opens with positive ``x``."""
        root = exact_root(dp, self.dp_small) if self.law == "listing" else turbulent_root(dp, self.dp_small)
        gain = self.K_V * self.I_rated * sqrt(2 / self.fluid.rho)
        return gain * fmax(x - self.overlap, 0) * root + self.G_leak * dp

    def equations(self) -> Equations:
        p, t, a, b = self.port_p, self.port_t, self.port_a, self.port_b
        yield from self._spool()
        yield "land P to A", self.q_pa == self.land(self.x, p.p - a.p)
        yield "land B to T", self.q_bt == self.land(self.x, b.p - t.p)
        yield "land P to B", self.q_pb == self.land(-self.x, p.p - b.p)
        yield "land A to T", self.q_at == self.land(-self.x, a.p - t.p)
        yield p.q == self.q_pa + self.q_pb
        yield t.q == -(self.q_at + self.q_bt)
        yield a.q == self.q_at - self.q_pa
        yield b.q == self.q_bt - self.q_pb
        loss = self.fluid.throttling_loss
        yield (
            "losses",
            self.P_loss
            == loss(self.q_pa, p.p, a.p)
            + loss(self.q_pb, p.p, b.p)
            + loss(self.q_at, a.p, t.p)
            + loss(self.q_bt, b.p, t.p),
        )

    def _spool(self) -> Equations:
        command = self.I / self.I_rated
        if self.spool == "ideal":
            yield self.x == command
            yield self.v == 0
        else:
            omega = 2 * pi * self.f_spool
            yield self.v == der(self.x)
            yield (
                "spool dynamics",
                der(self.v)
                == omega**2 * (clamp(command, -1, 1) - self.x) - 2 * self.zeta_spool * omega * self.v,
            )
