"""Linear and saturating elements, named as in the Modelica Standard Library (Electrical.Analog.Basic)."""

from __future__ import annotations

from math import pi

from casadi import SX, atan

from arthur_acausal import Component, Equations, Real, der, parameter, real_input, variable
from arthur_acausal.components.electrical.pin import HeatingTwoPin, Pin, TwoPin

NEWTON_STEPS = 12  # of the knee of a saturating inductor: from below, quadratic; 1e-15 up to Lnom/Lzer = 0.99


class Ground(Component):
    """The potential 0."""

    pin = Pin()

    def equations(self) -> Equations:
        yield self.pin.v == 0


class Resistor(HeatingTwoPin):
    """Ohm's law: v = R (1 + alpha (T - T_ref)) i.

    ``R`` [ohm] at ``T_ref`` [K]; ``alpha`` [1/K]: its temperature coefficient. ``T`` is that of the heat port, or
    without one the parameter, by default T_ref.
    """

    R: Real = parameter("ohm", description="resistance at T_ref")
    T_ref: Real = parameter("K", default=300.15, min=0.0, display="degC")
    alpha: Real = parameter("1/K", default=0.0, description="temperature coefficient")
    T: Real = parameter("K", default=lambda self: self.T_ref, min=0.0, display="degC")

    def equations(self) -> Equations:
        yield from super().equations()
        R_actual = self.R * (1 + self.alpha * (self.temperature() - self.T_ref))
        yield "Ohm's law", self.v == R_actual * self.i


class HeatingResistor(Resistor):
    """A resistor whose heat leaves by its heat port."""

    use_heat_port: bool = True


class VariableResistor(HeatingTwoPin):
    """Ohm's law with the signal ``R`` [ohm]."""

    R: Real = real_input("ohm", description="resistance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "Ohm's law", self.v == self.R * self.i


class Conductor(HeatingTwoPin):
    """Ohm's law: i = G v/(1 + alpha (T - T_ref)). ``G`` [S] at ``T_ref`` [K]; ``alpha`` [1/K] of the resistance."""

    G: Real = parameter("S", description="conductance at T_ref")
    T_ref: Real = parameter("K", default=300.15, min=0.0, display="degC")
    alpha: Real = parameter("1/K", default=0.0, description="temperature coefficient of the resistance")
    T: Real = parameter("K", default=lambda self: self.T_ref, min=0.0, display="degC")

    def equations(self) -> Equations:
        yield from super().equations()
        G_actual = self.G / (1 + self.alpha * (self.temperature() - self.T_ref))
        yield "Ohm's law", self.i == G_actual * self.v


class Capacitor(TwoPin):
    """C der(v) = i. State: ``v`` [V]; ``C`` [F]. ``E`` [J]: the energy in the field."""

    C: Real = parameter("F", min=0.0, description="capacitance")
    v: Real = variable("V", start=0.0, description="potential of pin_p above pin_n")
    E: Real = variable("J", description="energy in the field")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "charge", self.C * der(self.v) == self.i
        yield self.E == self.C * self.v**2 / 2


class Inductor(TwoPin):
    """L der(i) = v. State: ``i`` [A]; ``L`` [H]. ``E`` [J]: the energy in the field."""

    L: Real = parameter("H", min=0.0, description="inductance")
    i: Real = variable("A", start=0.0, description="current from pin_p to pin_n")
    E: Real = variable("J", description="energy in the field")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "flux", self.L * der(self.i) == self.v
        yield self.E == self.L * self.i**2 / 2


def knee_current(inductor: SaturatingInductor) -> SX:
    """Return I_par [A] with L(I_nom) = L_nom: x atan(1/x) = (L_nom - L_inf)/(L_zer - L_inf), x = I_par/I_nom.

    Newton's method from below: the left side is concave, so every step stays below the root.
    """
    part = (inductor.L_nom - inductor.L_inf) / (inductor.L_zer - inductor.L_inf)
    x = 2 / pi * part
    for _ in range(NEWTON_STEPS):
        x = x - (x * atan(1 / x) - part) / (atan(1 / x) - x / (1 + x**2))
    return inductor.I_nom * x


class SaturatingInductor(TwoPin):
    """An inductor whose iron saturates: psi = L_inf i + (L_zer - L_inf) I_par atan(i/I_par), der(psi) = v.

    The chord psi/i is ``L_zer`` [H] at no current, ``L_nom`` at ``I_nom`` [A], ``L_inf`` at large currents;
    L_inf < L_nom < L_zer. State: ``i`` [A]. Modelica Standard Library 4.1, Electrical.Analog.Basic.
    """

    I_nom: Real = parameter("A", default=1.0, min=0.0)
    L_nom: Real = parameter("H", default=1.0, min=0.0)
    L_zer: Real = parameter("H", default=lambda self: 2 * self.L_nom, min=0.0)
    L_inf: Real = parameter("H", default=lambda self: self.L_nom / 2, min=0.0)
    I_par: Real = parameter("A", default=knee_current, description="where it begins to saturate")
    i: Real = variable("A", start=0.0, state_select="prefer", description="current from pin_p to pin_n")
    psi: Real = variable("V*s", description="flux linkage")
    L_actual: Real = variable("H", description="slope of the flux linkage")

    def equations(self) -> Equations:
        yield from super().equations()
        L, I_par = self.L_zer - self.L_inf, self.I_par
        yield "saturation", self.psi == self.L_inf * self.i + L * I_par * atan(self.i / I_par)
        yield self.L_actual == self.L_inf + L / (1 + (self.i / I_par) ** 2)
        yield "flux", der(self.psi) == self.v
