"""A bounce that takes the height for the speed."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, UnitError, der, reinit, translate, variable, when

ERROR = UnitError
EXPECT = [r"^Ball", r"v becomes \(-h\)", r"velocity, m/s", r"length, m", r"remedy"]


class Ball(Component):
    h: Real = variable("m", start=1.0, fixed=True)
    v: Real = variable("m/s", start=-1.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.h) == self.v
        yield der(self.v) == 0
        yield when(self.h < 0, reinit(self.v, -self.h))  # culprit


def run() -> object:
    return translate(Ball())
