"""Switches with an arc, with two ways, with a control pin, and the triac (Electrical.Analog.Ideal)."""

from __future__ import annotations

from casadi import SX, fabs, fmin, sign

from arthur_acausal import (
    Component,
    Equations,
    Real,
    connect,
    discrete,
    if_else,
    parameter,
    pre,
    real_input,
    smooth_if_else,
    time,
    variable,
    when,
)
from arthur_acausal.components.electrical.basic import Capacitor, Resistor
from arthur_acausal.components.electrical.ideal import IdealSwitch, IdealThyristor, either
from arthur_acausal.components.electrical.pin import HeatingTwoPin, Pin

NEVER = -1e60
"""A time [s] before every run."""


class ControlledIdealClosingSwitch(IdealSwitch):
    """Closed while the potential of the pin ``control`` is above ``level`` [V]; the pin takes no current."""

    control_pin = Pin()
    level: Real = parameter("V", default=0.5)
    control: Real = variable("1", description="1: closed")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "level", self.control == if_else(self.control_pin.v < self.level, 0, 1)
        yield self.control_pin.i == 0


class IdealTwoWaySwitch(Component):
    """Joins pin_p with pin_n1, or with pin_n2 while the signal ``control`` is true (above 0.5).

    ``Ron`` [ohm] on the closed way, ``Goff`` [S] on the open one. ``s1``, ``s2`` [1]: along the characteristic of
    either way, its current in A where it is closed, its voltage in V where it is open.
    """

    pin_p = Pin()
    pin_n1 = Pin()
    pin_n2 = Pin()
    Ron: Real = parameter("ohm", default=1e-5, min=0.0, description="resistance where closed")
    Goff: Real = parameter("S", default=1e-5, min=0.0, description="conductance where open")
    V_unit: Real = parameter("V", default=1.0, min=0.0)
    I_unit: Real = parameter("A", default=1.0, min=0.0)
    control: Real = real_input("1", description="0 or 1")
    s1: Real = variable("1", description="along the characteristic of the way to pin_n1")
    s2: Real = variable("1", description="along the characteristic of the way to pin_n2")
    P_loss: Real = variable("W", description="power turned to heat")

    def equations(self) -> Equations:
        on = if_else(self.control < 0.5, 0, 1)
        p, ways = self.pin_p, ((self.pin_n1, self.s1, 1 - on), (self.pin_n2, self.s2, on))
        for pin, s, closed in ways:
            yield "voltage", p.v - pin.v == s * either(closed, self.I_unit * self.Ron, self.V_unit)
            yield "current", -pin.i == s * either(closed, self.I_unit, self.V_unit * self.Goff)
        yield p.i + self.pin_n1.i + self.pin_n2.i == 0
        loss = sum((-(p.v - pin.v) * pin.i for pin, _, _ in ways), SX(0.0))
        yield "loss", self.P_loss == loss


class SwitchWithArc(HeatingTwoPin):
    """What switches share that draw an arc when they open under current.

    Closed: v = Ron i. Opened: the arc's voltage rises from ``V_0`` [V] by ``dVdt`` [V/s] to ``V_max``, against the
    current, until it is quenched, where the current has fallen to Goff v; then i = Goff v until it closes again.
    ``Goff`` [S] > 0. Discrete: ``open``, ``quenched`` [0 or 1], ``t_open`` [s], when it opened. Modelica Standard
    Library 4.1, Electrical.Analog.Interfaces.IdealSwitchWithArc.
    """

    Ron: Real = parameter("ohm", default=1e-5, min=0.0, description="resistance where closed")
    Goff: Real = parameter("S", default=1e-5, min=0.0, description="conductance where open")
    V_0: Real = parameter("V", default=30.0, min=0.0, description="voltage of the arc at first")
    dVdt: Real = parameter("V/s", default=1e4, min=0.0, description="rate of the arc's voltage")
    V_max: Real = parameter("V", default=60.0, min=0.0, description="largest voltage of the arc")
    A_unit: Real = parameter("A", default=1.0, min=0.0, description="any current")
    open: Real = discrete("1", start=1.0, description="1: opened, the arc may burn")
    quenched: Real = discrete("1", start=1.0, description="1: no arc")
    t_open: Real = discrete("s", start=NEVER, description="when it opened last")

    def opened(self) -> SX:
        """Return 1 where it is opened, else 0."""
        raise NotImplementedError

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.open == self.opened()
        yield when(self.open > 0.5, self.t_open == time())
        burning = self.open * (1 - pre(self.quenched))
        above = smooth_if_else(burning, fabs(self.i) - self.Goff * fabs(self.v), self.A_unit)
        out = if_else(above <= 0, 1, 0)
        yield self.quenched == self.open * (1 - (1 - out) * (1 - pre(self.quenched)))
        arc = fmin(self.V_max, self.V_0 + self.dVdt * (time() - self.t_open)) * sign(self.i)
        apart = smooth_if_else(self.quenched, self.i / self.Goff, arc)
        yield "switch and arc", self.v == smooth_if_else(self.open, apart, self.Ron * self.i)


class CloserWithArc(SwitchWithArc):
    """A switch with an arc, closed while the signal ``control`` is true (above 0.5)."""

    control: Real = real_input("1", description="0 or 1")

    def opened(self) -> SX:
        return if_else(self.control < 0.5, 1, 0)


class ControlledCloserWithArc(SwitchWithArc):
    """A switch with an arc, closed while the potential of ``control_pin`` is above ``level`` [V]."""

    control_pin = Pin()
    level: Real = parameter("V", default=0.5)

    def opened(self) -> SX:
        return if_else(self.control_pin.v < self.level, 1, 0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.control_pin.i == 0


class IdealTriac(Component):
    """Two ideal thyristors, one each way, with a resistor and a capacitor in series beside them.

    ``fire`` (above 0.5) fires both; each blocks again where its current ends. ``thyristor`` conducts from pin_n to
    pin_p. ``Ron`` [ohm], ``Goff`` [S], ``Vknee`` [V] as of ``IdealThyristor``; ``R_dis`` [ohm], ``C_dis`` [F]: what
    damps disturbances. Modelica Standard Library 4.1, Electrical.Analog.Ideal.IdealTriac.
    """

    pin_p = Pin()
    pin_n = Pin()
    Ron: Real = parameter("ohm", default=1e-5, min=0.0)
    Goff: Real = parameter("S", default=1e-5, min=0.0)
    Vknee: Real = parameter("V", default=0.8, min=0.0)
    R_dis: Real = parameter("ohm", default=100.0, min=0.0)
    C_dis: Real = parameter("F", default=0.005, min=0.0)
    fire: Real = real_input("1", default=0.0, description="1: the gate is fired")
    idealThyristor = IdealThyristor(
        Ron=lambda self: self.Ron, Goff=lambda self: self.Goff, Vknee=lambda self: self.Vknee
    )
    idealThyristor1 = IdealThyristor(
        Ron=lambda self: self.Ron, Goff=lambda self: self.Goff, Vknee=lambda self: self.Vknee
    )
    resistor = Resistor(R=lambda self: self.R_dis)
    capacitor = Capacitor(C=lambda self: self.C_dis)

    def equations(self) -> Equations:
        yield connect(self.pin_n, self.idealThyristor.pin_p)
        yield connect(self.idealThyristor.pin_n, self.pin_p)
        yield connect(self.pin_p, self.idealThyristor1.pin_p)
        yield connect(self.idealThyristor1.pin_n, self.pin_n)
        yield connect(self.pin_n, self.resistor.pin_p)
        yield connect(self.resistor.pin_n, self.capacitor.pin_p)
        yield connect(self.capacitor.pin_n, self.pin_p)
        yield connect(self.fire, self.idealThyristor.fire)
        yield connect(self.fire, self.idealThyristor1.fire)
