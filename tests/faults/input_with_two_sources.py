"""Two controllers drive one input."""

from __future__ import annotations

from arthur_acausal import (
    Component,
    ConnectError,
    Equations,
    Real,
    connect,
    real_input,
    real_output,
    translate,
)

ERROR = ConnectError
EXPECT = [r"drive\.u\b", r"already has a source \(input_with_two_sources\.py:\d+\)", r"remedy"]


class Controller(Component):
    y: Real = real_output("V")

    def equations(self) -> Equations:
        yield self.y == 0


class Drive(Component):
    u: Real = real_input("V")


class Plant(Component):
    first = Controller()
    second = Controller()
    drive = Drive()

    def equations(self) -> Equations:
        yield connect(self.first.y, self.drive.u)
        yield connect(self.second.y, self.drive.u)  # culprit


def run() -> object:
    return translate(Plant())
