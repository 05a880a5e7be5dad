"""Elements of straight characteristics, named as in the Modelica Standard Library (Electrical.Analog.Ideal).

Where an element blocks and where it conducts, voltage or current is the steep one. Both follow from one
dimensionless parameter s along the characteristic (Clauss, Elmqvist, Mattsson, Otter and Schwarz, Mixed
domain modeling in Modelica, FDL 2002), so that resistance and conductance may be small, and zero where the
circuit allows it. ``V_unit`` [V] and ``I_unit`` [A] are what s = 1 means.
"""

from __future__ import annotations

import casadi
from casadi import SX

from arthur_acausal import Equations, Real, discrete, if_else, parameter, pre, real_input, variable
from arthur_acausal.components.electrical.pin import HeatingTwoPin


def either(on: SX, then: SX | float, otherwise: SX | float) -> SX:
    """Return ``then`` where the mode ``on``, 0 or 1, is 1, else ``otherwise``: one relation serves many places."""
    return on * then + (1 - on) * otherwise


class IdealSemiconductor(HeatingTwoPin):
    """What diode and thyristor share: from the knee (Vknee, Goff Vknee), slope 1/Ron above, Goff below.

    ``Ron`` [ohm], ``Goff`` [S], ``Vknee`` [V]. ``s`` [1] is positive on the conducting branch.
    """

    Ron: Real = parameter("ohm", default=1e-5, min=0.0, description="resistance where it conducts")
    Goff: Real = parameter("S", default=1e-5, min=0.0, description="conductance where it blocks")
    Vknee: Real = parameter("V", default=0.0, min=0.0, description="forward threshold")
    V_unit: Real = parameter("V", default=1.0, min=0.0)
    I_unit: Real = parameter("A", default=1.0, min=0.0)
    s: Real = variable("1", start=0.0, description="place on the characteristic")

    def off(self) -> SX:
        """Return the condition under which it blocks."""
        return self.s < 0

    def equations(self) -> Equations:
        yield from super().equations()
        on, s = if_else(self.off(), 0, 1), self.s
        yield "voltage", self.v == s * either(on, self.I_unit * self.Ron, self.V_unit) + self.Vknee
        along = s * either(on, self.I_unit, self.V_unit * self.Goff)
        yield "current", self.i == along + self.Goff * self.Vknee


class IdealDiode(IdealSemiconductor):
    """Conducts above ``Vknee`` [V], blocks below. Each change is an event."""


class IdealThyristor(IdealSemiconductor):
    """Blocks until the signal ``fire`` is true (above 0.5) while v > Vknee; then conducts until s < 0."""

    fire: Real = real_input("1", default=0.0, description="1: the gate is fired")
    blocked: Real = discrete("1", start=1.0, description="1 while it blocks")

    def off(self) -> SX:
        return self.blocked

    def equations(self) -> Equations:
        held = casadi.logic_and(pre(self.blocked), self.fire < 0.5)
        yield self.blocked == if_else(casadi.logic_or(self.s < 0, held), 1, 0)
        yield from super().equations()


class IdealGTOThyristor(IdealThyristor):
    """Conducts while the signal ``fire`` is true (above 0.5) and s > 0; can be turned off by the gate."""

    def equations(self) -> Equations:
        yield self.blocked == if_else(casadi.logic_or(self.s < 0, self.fire < 0.5), 1, 0)
        yield from IdealSemiconductor.equations(self)


class IdealZener(IdealSemiconductor):
    """An ideal diode that breaks down below -``V_z`` [V], with the slope 1/Ron. Each change is an event."""

    V_z: Real = parameter("V", min=0.0, description="breakdown voltage, positive")

    def equations(self) -> Equations:
        yield from HeatingTwoPin.equations(self)
        s, s_z = self.s, (self.V_z + self.Vknee) / self.V_unit
        on, broken = if_else(s < 0, 0, 1), if_else(s + s_z < 0, 1, 0)
        conducts = either(on, 1, broken)
        beyond = s + broken * s_z  # from the knee, or from the point of breakdown
        v_knee, i_knee = (
            either(broken, -self.V_z, self.Vknee),
            self.Goff * either(broken, -self.V_z, self.Vknee),
        )
        yield "voltage", self.v == beyond * either(conducts, self.I_unit * self.Ron, self.V_unit) + v_knee
        yield "current", self.i == beyond * either(conducts, self.I_unit, self.V_unit * self.Goff) + i_knee


class IdealSwitch(HeatingTwoPin):
    """What switches share: ``Ron`` [ohm] where closed, ``Goff`` [S] where open; ``control`` is true above 0.5."""

    Ron: Real = parameter("ohm", default=1e-5, min=0.0, description="resistance where closed")
    Goff: Real = parameter("S", default=1e-5, min=0.0, description="conductance where open")
    V_unit: Real = parameter("V", default=1.0, min=0.0)
    I_unit: Real = parameter("A", default=1.0, min=0.0)
    control: Real = real_input("1", description="0 or 1")
    s: Real = variable("1", description="voltage where open, current where closed")

    def is_open(self) -> SX:
        """Return the condition under which it is open."""
        return self.control < 0.5

    def equations(self) -> Equations:
        yield from super().equations()
        on, s = if_else(self.is_open(), 0, 1), self.s
        yield "voltage", self.v == s * either(on, self.I_unit * self.Ron, self.V_unit)
        yield "current", self.i == s * either(on, self.I_unit, self.V_unit * self.Goff)


class IdealClosingSwitch(IdealSwitch):
    """Closed while ``control`` is true (above 0.5). ``Ron`` [ohm], ``Goff`` [S]."""


class IdealOpeningSwitch(IdealSwitch):
    """Open while ``control`` is true (above 0.5). ``Ron`` [ohm], ``Goff`` [S]."""

    def is_open(self) -> SX:
        return self.control > 0.5
