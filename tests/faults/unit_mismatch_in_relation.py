"""A pressure compared with a length decides a switch."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, UnitError, if_else, parameter, translate, variable

ERROR = UnitError
EXPECT = [r"^Switch", r"pressure, Pa", r"length, m", r"remedy"]


class Switch(Component):
    p: Real = parameter("Pa", default=1.0)
    h: Real = variable("m")
    y: Real = variable("1")

    def equations(self) -> Equations:
        yield self.h == 0
        yield self.y == if_else(self.h < self.p, 1.0, 2.0)  # culprit


def run() -> object:
    return translate(Switch())
