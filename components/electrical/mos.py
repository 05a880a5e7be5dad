"""Field-effect transistors, as in the Modelica Standard Library (Analog.Semiconductors)."""

from __future__ import annotations

from typing import ClassVar

from casadi import fmax, fmin

from arthur_acausal import Component, Equations, Real, parameter, smooth_if_else, variable
from arthur_acausal.components.electrical.pin import Pin
from arthur_acausal.components.thermal import HeatPort


class NMOS(Component):
    """An n-channel MOS transistor without capacitances.

    With u_ds >= 0 from drain to source (or from source to drain, whichever is higher), u_bs <= 0, the overdrive
    u = K5 (u_gs - V_t + K2 u_bs) and the conductance v = beta (W + dW)/(L + dL):
    i_d = v u_ds (u - u_ds/2) up to pinch-off at u_ds = u, then v u^2/2; plus u_ds/R_DS throughout.
    With a heat port, or ``T`` other than ``T_nom`` [K]: beta ~ (T/T_nom)^-1.5; V_t and K2 change linearly, by ``k_vt``
    and ``k_k2`` [1/K]. Gate and bulk take no current. Spiro, Simulation integrierter Schaltungen (1990), as in the
    Modelica Standard Library 4.1. Continuous: no event.
    """

    _polarity: ClassVar[int] = 1
    use_heat_port: bool = False
    drain = Pin()
    gate = Pin()
    source = Pin()
    bulk = Pin()
    W: Real = parameter("m", default=20e-6, min=0.0, description="width")
    L: Real = parameter("m", default=6e-6, min=0.0, description="length")
    beta: Real = parameter("A/V^2", default=4.1e-5, min=0.0, description="transconductance parameter")
    V_t: Real = parameter("V", default=0.8, description="threshold voltage at no bias")
    K2: Real = parameter("1", default=1.144, description="bulk threshold parameter")
    K5: Real = parameter("1", default=0.7311, min=0.0, description="reduction of the pinch-off region")
    dW: Real = parameter("m", default=-2.5e-6, description="change of the channel's width")
    dL: Real = parameter("m", default=-1.5e-6, description="change of the channel's length")
    R_DS: Real = parameter("ohm", default=1e7, min=0.0, description="resistance from drain to source")
    T_nom: Real = parameter("K", default=300.15, min=0.0, description="temperature of the parameters")
    T: Real = parameter("K", default=lambda self: self.T_nom, min=0.0)
    k_vt: Real = parameter("1/K", default=-6.96e-3, description="temperature coefficient of V_t")
    k_k2: Real = parameter("1/K", default=6e-4, description="temperature coefficient of K2")
    exponent: Real = parameter("1", default=-1.5, description="of beta over the temperature")
    i_d: Real = variable("A", description="channel current, positive")
    P_loss: Real = variable("W", description="power turned to heat")

    def build(self) -> None:
        if self.use_heat_port:
            self.heat_port = HeatPort()

    def equations(self) -> Equations:
        p, d, s = self._polarity, self.drain, self.source
        T = self.heat_port.T if self.use_heat_port else self.T
        beta = self.beta * (T / self.T_nom) ** self.exponent
        V_t = p * self.V_t * (1 + self.k_vt * (T - self.T_nom))
        K2 = self.K2 * (1 + self.k_k2 * (T - self.T_nom))
        high, low = fmax(p * d.v, p * s.v), fmin(p * d.v, p * s.v)
        u_ds, u_bs = high - low, fmin(p * self.bulk.v - low, 0)
        over = fmax(self.K5 * (p * self.gate.v - low - V_t + K2 * u_bs), 0)
        v = beta * (self.W + self.dW) / (self.L + self.dL)
        channel = v * smooth_if_else(over > u_ds, u_ds * (over - u_ds / 2), over**2 / 2)
        yield "channel", self.i_d == channel + u_ds / self.R_DS
        yield d.i == p * smooth_if_else(p * d.v < p * s.v, -self.i_d, self.i_d)
        yield s.i == -d.i
        yield self.gate.i == 0
        yield self.bulk.i == 0
        yield "loss", self.P_loss == d.i * (d.v - s.v)
        if self.use_heat_port:
            yield self.heat_port.Q_flow == -self.P_loss


class PMOS(NMOS):
    """A p-channel MOS transistor: the law of ``NMOS`` with the other sign of all voltages and currents; ``V_t`` < 0."""

    _polarity = -1
    beta: Real = parameter("A/V^2", default=1.05e-5, min=0.0, description="transconductance parameter")
    V_t: Real = parameter("V", default=-1.0, description="threshold voltage at no bias")
    K2: Real = parameter("1", default=0.41, description="bulk threshold parameter")
    K5: Real = parameter("1", default=0.839, min=0.0, description="reduction of the pinch-off region")
    dL: Real = parameter("m", default=-2.1e-6, description="change of the channel's length")
    k_vt: Real = parameter("1/K", default=-2.9e-3, description="temperature coefficient of V_t")
    k_k2: Real = parameter("1/K", default=6.2e-4, description="temperature coefficient of K2")
