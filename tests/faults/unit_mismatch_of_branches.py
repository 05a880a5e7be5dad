"""A choice between a pressure and a force."""

from __future__ import annotations

from arthur_acausal import (
    Component,
    Equations,
    Real,
    UnitError,
    if_else,
    parameter,
    time,
    translate,
    variable,
)

ERROR = UnitError
EXPECT = [r"choice", r"Pa", r"\bN\b|force"]


class Choice(Component):
    x: Real = variable("Pa", start=1.0)
    p: Real = parameter("Pa", default=1.0)
    F: Real = parameter("N", default=1.0)
    t_1: Real = parameter("s", default=0.5)

    def equations(self) -> Equations:
        yield "choice", self.x == if_else(time() < self.t_1, self.p, self.F)  # culprit


def run() -> object:
    return translate(Choice())
