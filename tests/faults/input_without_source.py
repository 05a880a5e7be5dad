"""A part's input that nothing drives and that has no default."""

from __future__ import annotations

from arthur_acausal import Component, ConnectError, Equations, Real, real_input, translate, variable

ERROR = ConnectError
EXPECT = [r"^drive\.speed\b", r"not connected", r"default", r"connect it"]


class Drive(Component):
    speed: Real = real_input("rad/s")
    y: Real = variable("rad/s")

    def equations(self) -> Equations:
        yield self.y == self.speed


class Plant(Component):
    drive = Drive()


def run() -> object:
    return translate(Plant())
