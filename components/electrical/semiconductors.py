"""Semiconductors of exponential characteristics, as in the Modelica Standard Library (Analog.Semiconductors)."""

from __future__ import annotations

from casadi import SX, exp, fmax, fmin

from arthur_acausal import Component, Equations, Real, parameter, smooth_if_else, variable
from arthur_acausal.components.electrical.pin import HeatingTwoPin, Pin, TwoPin


def exp_linear(x: SX, limit: SX) -> SX:
    """Return exp(x), above ``limit`` continued by its tangent."""
    return smooth_if_else(x > limit, exp(limit) * (1 + x - limit), exp(fmin(x, limit)))


class Diode(HeatingTwoPin):
    """Shockley's law with a resistance ``R`` [ohm] beside: i = Ids (exp(v/Vt) - 1) + v/R.

    Above the exponent ``max_exp`` [1] the tangent. ``Ids`` [A]: saturation current, ``Vt`` [V]: thermal voltage
    times the emission coefficient. Continuous: no event. Shockley, Bell System Technical Journal 28 (1949), 435.
    """

    Ids: Real = parameter("A", default=1e-6, min=0.0, description="saturation current")
    Vt: Real = parameter("V", default=0.04, min=0.0, description="n k T/q")
    max_exp: Real = parameter("1", default=15.0)
    R: Real = parameter("ohm", default=1e8, min=0.0, description="parallel resistance")

    def equations(self) -> Equations:
        yield from super().equations()
        forward = self.Ids * (exp_linear(self.v / self.Vt, self.max_exp) - 1)
        yield "Shockley's law", self.i == forward + self.v / self.R


class HeatingDiode(HeatingTwoPin):
    """A diode whose law depends on its temperature T [K], that of its heat port.

    i = Ids (T/T_nom)^(XTI/N) exp((T/T_nom - 1) EG/(N v_T)) (exp(v/(N v_T)) - 1) + v/R with v_T = k_B T/q_e;
    above the exponent ``max_exp`` the tangent. ``EG`` [V]: band gap, ``XTI`` [1]: temperature exponent, ``N`` [1]:
    emission coefficient, ``Ids`` [A] at ``T_nom`` [K]. Law of SPICE (Nagel, UCB/ERL M520, 1975), as in the
    Modelica Standard Library 4.1, Electrical.Analog.Semiconductors.Diode. Constants: CODATA 2018.
    """

    use_heat_port: bool = True
    Ids: Real = parameter("A", default=1e-6, min=0.0, description="saturation current")
    max_exp: Real = parameter("1", default=15.0)
    R: Real = parameter("ohm", default=1e8, min=0.0, description="parallel resistance")
    EG: Real = parameter("V", default=1.11, description="band gap")
    N: Real = parameter("1", default=1.0, description="emission coefficient")
    T_nom: Real = parameter("K", default=300.15, min=0.0, display="degC", description="temperature of Ids")
    XTI: Real = parameter("1", default=3.0, description="temperature exponent")
    k_B: Real = parameter("J/K", default=1.380649e-23, description="Boltzmann constant")
    q_e: Real = parameter("C", default=1.602176634e-19, description="elementary charge")

    def equations(self) -> Equations:
        yield from super().equations()
        T = self.temperature()
        v_T = self.N * self.k_B * T / self.q_e
        forward = self.Ids * (exp_linear(self.v / v_T, self.max_exp) - 1)
        warm = (T / self.T_nom) ** (self.XTI / self.N) * exp((T / self.T_nom - 1) * self.EG / v_T)
        yield "Shockley's law", self.i == forward * warm + self.v / self.R


class ZenerDiode(HeatingTwoPin):
    """A diode that breaks down: i = Ids (exp(v/Vt) - 1) - Ibv exp(-(v + Bv)/(Nbv Vt)) + v/R.

    ``Bv`` [V]: breakdown voltage, ``Ibv`` [A]: its knee current, ``Nbv`` [1]: its emission coefficient. Above the
    exponent ``max_exp`` of either branch the tangent. Modelica Standard Library 4.1, Semiconductors.ZDiode.
    """

    Ids: Real = parameter("A", default=1e-6, min=0.0, description="saturation current")
    Vt: Real = parameter("V", default=0.04, min=0.0, description="n k T/q")
    max_exp: Real = parameter("1", default=30.0)
    R: Real = parameter("ohm", default=1e8, min=0.0, description="parallel resistance")
    Bv: Real = parameter("V", default=5.1, min=0.0, description="breakdown voltage")
    Ibv: Real = parameter("A", default=0.7, min=0.0, description="breakdown knee current")
    Nbv: Real = parameter("1", default=0.74, description="breakdown emission coefficient")

    def equations(self) -> Equations:
        yield from super().equations()
        forward = self.Ids * (exp_linear(self.v / self.Vt, self.max_exp) - 1)
        back = self.Ibv * exp_linear(-(self.v + self.Bv) / (self.Nbv * self.Vt), self.max_exp)
        yield "Zener's law", self.i == forward - back + self.v / self.R


class ChuaDiode(TwoPin):
    """A resistor of negative conductance: i = G_a v within -V_e..V_e, beyond with the slope G_b.

    Kennedy, Three steps to chaos I, IEEE Transactions on Circuits and Systems I 40 (1993), 640. ``G_a``, ``G_b`` [S],
    ``V_e`` [V]. Continuous: no event.
    """

    G_a: Real = parameter("S", description="inner conductance")
    G_b: Real = parameter("S", description="outer conductance")
    V_e: Real = parameter("V", default=1.0, min=0.0, description="end of the inner range")

    def equations(self) -> Equations:
        yield from super().equations()
        inner = fmin(fmax(self.v, -self.V_e), self.V_e)
        yield "characteristic", self.i == self.G_b * self.v + (self.G_a - self.G_b) * inner


class NPN(Component):
    """A bipolar transistor without charge storage: Ebers and Moll's law in its transport form, Early effect.

    i_C = (i_F - i_R) (1 - v_BC/V_A) - i_R/beta_R, i_B = i_F/beta_F + i_R/beta_R, with
    i_F = Is (exp(v_BE/Vt) - 1), i_R = Is (exp(v_BC/Vt) - 1), each with ``G_min`` [S] beside its junction; above
    the exponent ``max_exp`` the tangent. Getreu, Modeling the Bipolar Transistor (1976), ch. 2.
    ``collector.i``, ``base.i``, ``emitter.i`` [A] are positive into the transistor.
    """

    collector = Pin()
    base = Pin()
    emitter = Pin()
    beta_F: Real = parameter("1", default=50.0, min=0.0, description="forward current gain")
    beta_R: Real = parameter("1", default=0.1, min=0.0, description="reverse current gain")
    Is: Real = parameter("A", default=1e-16, min=0.0, description="transport saturation current")
    V_A: Real = parameter("V", default=50.0, min=0.0, description="Early voltage")
    Vt: Real = parameter("V", default=0.02585, min=0.0, description="thermal voltage")
    G_min: Real = parameter("S", default=1e-15, min=0.0)
    max_exp: Real = parameter("1", default=40.0)
    v_BE: Real = variable("V", start=0.6, description="base above emitter")
    v_BC: Real = variable("V", start=0.6, description="base above collector")
    i_F: Real = variable("A", description="forward current")
    i_R: Real = variable("A", description="reverse current")

    def equations(self) -> Equations:
        yield self.v_BE == self.base.v - self.emitter.v
        yield self.v_BC == self.base.v - self.collector.v
        for i, v in ((self.i_F, self.v_BE), (self.i_R, self.v_BC)):
            yield "junction", i == self.Is * (exp_linear(v / self.Vt, self.max_exp) - 1) + self.G_min * v
        early = 1 - self.v_BC / self.V_A
        yield "collector", self.collector.i == (self.i_F - self.i_R) * early - self.i_R / self.beta_R
        yield "base", self.base.i == self.i_F / self.beta_F + self.i_R / self.beta_R
        yield self.collector.i + self.base.i + self.emitter.i == 0
