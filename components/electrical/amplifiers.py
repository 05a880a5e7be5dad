"""Operational amplifiers, named as in the Modelica Standard Library (Electrical.Analog.Ideal, Basic)."""

from __future__ import annotations

import casadi

from arthur_acausal import Component, Equations, Real, if_else, parameter, variable
from arthur_acausal.components.electrical.pin import Pin


class IdealOpAmp(Component):
    """An operational amplifier without limits, within a feedback: in_p and in_n have one potential, no current.

    The output ``out`` takes the potential that makes them equal.
    """

    in_p = Pin()
    in_n = Pin()
    out = Pin()

    def equations(self) -> Equations:
        yield self.in_p.v == self.in_n.v
        yield self.in_p.i == 0
        yield self.in_n.i == 0


class LimitedOpAmp(Component):
    """What amplifiers with supply pins share: ``v_in`` [V], in_p above in_n; no current but at ``out``.

    The supply's current is not modelled.
    """

    in_p = Pin()
    in_n = Pin()
    out = Pin()
    v_max = Pin()
    v_min = Pin()
    v_in: Real = variable("V", description="in_p above in_n")

    def equations(self) -> Equations:
        yield self.v_in == self.in_p.v - self.in_n.v
        for pin in (self.in_p, self.in_n, self.v_max, self.v_min):
            yield pin.i == 0


class IdealOpAmpLimited(LimitedOpAmp):
    """An ideal operational amplifier whose output stays between the potentials of v_min and v_max.

    ``s`` [1] along its characteristic: between -1 and 1 the inputs are equal, beyond, the output is at a limit;
    events. ``V_unit`` [V]: what s = 1 means there.
    """

    V_unit: Real = parameter("V", default=1.0, min=0.0)
    s: Real = variable("1", start=0.0, description="place on the characteristic")

    def equations(self) -> Equations:
        yield from super().equations()
        s, low, high = self.s, self.v_min.v, self.v_max.v
        above, below = if_else(s > 1, 1, 0), if_else(s < -1, 1, 0)
        inside = 1 - above - below
        yield "input", self.v_in == self.V_unit * (above * (s - 1) + below * (s + 1))
        middle = (high + low) / 2 + s * (high - low) / 2
        yield "output", self.out.v == above * high + below * low + inside * middle


class OpAmp(LimitedOpAmp):
    """An operational amplifier of finite gain whose output approaches v_min and v_max smoothly.

    out.v = (v_max + v_min)/2 + a v_in/(1 + a |v_in| 2/(v_max - v_min)); ``a`` [1]: gain at v_in = 0.
    Modelica Standard Library 4.1, Electrical.Analog.Basic.OpAmp. Continuous: no event.
    """

    a: Real = parameter("1", default=1e4, min=0.0, description="open-loop gain")

    def equations(self) -> Equations:
        yield from super().equations()
        low, high = self.v_min.v, self.v_max.v
        bend = 1 + self.a * casadi.fabs(self.v_in) * 2 / (high - low)
        yield "output", self.out.v == (high + low) / 2 + self.a * self.v_in / bend
