"""A voltage goes where a speed is expected."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, UnitError, connect, real_input, real_output, translate

ERROR = UnitError
EXPECT = [r"controller\.y\b", r"drive\.speed\b", r"voltage", r"angular velocity", r"remedy"]


class Controller(Component):
    y: Real = real_output("V")

    def equations(self) -> Equations:
        yield self.y == 0


class Drive(Component):
    speed: Real = real_input("rad/s")


class Loop(Component):
    controller = Controller()
    drive = Drive()

    def equations(self) -> Equations:
        yield connect(self.controller.y, self.drive.speed)  # culprit


def run() -> object:
    return translate(Loop())
