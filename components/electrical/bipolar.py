"""Bipolar transistors with stored charge and temperature, as in the Modelica Standard Library."""

from __future__ import annotations

from typing import ClassVar

from casadi import SX, exp, fmin

from arthur_acausal import Component, Equations, Real, der, parameter, smooth_if_else, variable
from arthur_acausal.components.electrical.pin import Pin
from arthur_acausal.components.electrical.semiconductors import exp_linear
from arthur_acausal.components.thermal import HeatPort


def depletion(x: SX, gradation: SX) -> SX:
    """Return (1 - x)^-gradation, for x > 0 continued by its tangent."""
    return smooth_if_else(x > 0, 1 + gradation * x, (1 - fmin(x, 0)) ** -gradation)


class HeatingNPN(Component):
    """A bipolar transistor: Ebers and Moll's law in its transport form, Early effect, stored charge, temperature.

    i_C = (i_F - i_R) (1 - v_BC/V_A) - i_R/beta_R - C_BC v_BC' + C_CS v_C', i_B = i_F/beta_F + i_R/beta_R +
    C_BC v_BC' + C_BE v_BE', with i_F = Is (exp(v_BE/v_T) - 1), i_R = Is (exp(v_BC/v_T) - 1), each with ``G_BE``,
    ``G_BC`` [S] beside its junction; above the exponent ``max_exp`` the tangent. C_BE and C_BC are those of the
    transit times ``tau_F``, ``tau_R`` [s] and of the depletion layers, C_CS that from the collector to the substrate,
    which is at ground. ``charge``: whether there is any. ``V_A_inverse`` [1/V]: one over the Early voltage.
    With a heat port v_T = k_B T/q_e and Is ~ (T/T_nom)^XTI exp((T/T_nom - 1) E_G/v_T), else v_T = ``V_T``.
    ``collector.i``, ``base.i``, ``emitter.i`` [A] are positive into the transistor. Vlach and Singhal, Computer
    Methods for Circuit Analysis and Design (1983), as in the Modelica Standard Library 4.1, Semiconductors.NPN.
    Constants: CODATA 2018.
    """

    _polarity: ClassVar[int] = 1
    use_heat_port: bool = True
    charge: bool = True
    collector = Pin()
    base = Pin()
    emitter = Pin()
    beta_F: Real = parameter("1", default=50.0, min=0.0, description="forward current gain")
    beta_R: Real = parameter("1", default=0.1, min=0.0, description="reverse current gain")
    Is: Real = parameter("A", default=1e-16, min=0.0, description="transport saturation current at T_nom")
    V_A_inverse: Real = parameter("1/V", default=0.02, min=0.0, description="one over the Early voltage")
    V_T: Real = parameter("V", default=0.02585, min=0.0, description="thermal voltage without a heat port")
    G_BE: Real = parameter("S", default=1e-15, min=0.0)
    G_BC: Real = parameter("S", default=1e-15, min=0.0)
    max_exp: Real = parameter("1", default=40.0)
    tau_F: Real = parameter("s", default=0.12e-9, min=0.0, description="forward transit time")
    tau_R: Real = parameter("s", default=5e-9, min=0.0, description="reverse transit time")
    C_CS: Real = parameter("F", default=1e-12, min=0.0, description="collector-substrate capacitance")
    C_JE: Real = parameter("F", default=0.4e-12, min=0.0, description="base-emitter depletion at zero bias")
    C_JC: Real = parameter("F", default=0.5e-12, min=0.0, description="base-collector depletion at zero bias")
    phi_E: Real = parameter("V", default=0.8, min=0.0, description="base-emitter diffusion voltage")
    m_E: Real = parameter("1", default=0.4, min=0.0, description="base-emitter gradation exponent")
    phi_C: Real = parameter("V", default=0.8, min=0.0, description="base-collector diffusion voltage")
    m_C: Real = parameter("1", default=0.333, min=0.0, description="base-collector gradation exponent")
    T_nom: Real = parameter("K", default=300.15, min=0.0, description="temperature of Is")
    XTI: Real = parameter("1", default=3.0, description="temperature exponent")
    E_G: Real = parameter("V", default=1.11, description="band gap")
    k_B: Real = parameter("J/K", default=1.380649e-23, description="Boltzmann constant")
    q_e: Real = parameter("C", default=1.602176634e-19, description="elementary charge")
    v_BE: Real = variable("V", description="base above emitter; of a PNP emitter above base")
    v_BC: Real = variable("V", description="base above collector; of a PNP collector above base")
    v_C: Real = variable("V", description="collector above the substrate")
    i_F: Real = variable("A", description="forward current")
    i_R: Real = variable("A", description="reverse current")
    i_BE: Real = variable("A", description="current that charges the base-emitter junction")
    i_BC: Real = variable("A", description="current that charges the base-collector junction")
    i_CS: Real = variable("A", description="current from the collector to the substrate")
    P_loss: Real = variable("W", description="power turned to heat")

    def build(self) -> None:
        if self.use_heat_port:
            self.heat_port = HeatPort()

    def equations(self) -> Equations:
        p, c, b, e = self._polarity, self.collector, self.base, self.emitter
        Is, v_T = self._temperature()
        yield self.v_BE == p * (b.v - e.v)
        yield self.v_BC == p * (b.v - c.v)
        yield self.v_C == c.v
        yield "forward", self.i_F == Is * (self._exp(self.v_BE / v_T) - 1) + self.G_BE * self.v_BE
        yield "reverse", self.i_R == Is * (self._exp(self.v_BC / v_T) - 1) + self.G_BC * self.v_BC
        yield from self._charges(Is, v_T)
        through = (self.i_F - self.i_R) * (1 - self.v_BC * self.V_A_inverse)
        yield "collector", p * (c.i - self.i_CS) == through - self.i_R / self.beta_R - self.i_BC
        into = self.i_F / self.beta_F + self.i_R / self.beta_R
        yield "base", p * b.i == into + self.i_BC + self.i_BE
        yield c.i + b.i + e.i == self.i_CS
        lost = self.v_BC * self.i_R / self.beta_R + self.v_BE * self.i_F / self.beta_F
        yield "loss", self.P_loss == lost + through * p * (c.v - e.v)
        if self.use_heat_port:
            yield self.heat_port.Q_flow == -self.P_loss

    def _exp(self, x: SX) -> SX:
        return exp_linear(x, self.max_exp)

    def _temperature(self) -> tuple[SX, SX]:
        """Return the saturation current [A] and the thermal voltage [V]."""
        if not self.use_heat_port:
            return self.Is, self.V_T
        T = self.heat_port.T
        v_T = self.k_B * T / self.q_e
        warm = (T / self.T_nom) ** self.XTI * exp((T / self.T_nom - 1) * self.E_G / v_T)
        return self.Is * warm, v_T

    def _charges(self, Is: SX, v_T: SX) -> Equations:
        """Yield the currents that charge junctions and substrate."""
        if not self.charge:
            for current in (self.i_BE, self.i_BC, self.i_CS):
                yield current == 0
            return
        E, C = depletion(self.v_BE / self.phi_E, self.m_E), depletion(self.v_BC / self.phi_C, self.m_C)
        C_BE = self.tau_F * Is / v_T * self._exp(self.v_BE / v_T) + self.C_JE * E
        C_BC = self.tau_R * Is / v_T * self._exp(self.v_BC / v_T) + self.C_JC * C
        yield "base-emitter charge", self.i_BE == C_BE * der(self.v_BE)
        yield "base-collector charge", self.i_BC == C_BC * der(self.v_BC)
        yield "substrate charge", self.i_CS == self.C_CS * der(self.v_C)


class HeatingPNP(HeatingNPN):
    """A PNP transistor: the law of ``HeatingNPN`` with the other sign of all voltages and currents.

    ``v_BE`` [V] is the emitter above the base, ``v_BC`` the collector above the base.
    """

    _polarity = -1
