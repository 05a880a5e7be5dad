"""Two outputs meet."""

from __future__ import annotations

from arthur_acausal import Component, ConnectError, Equations, Real, connect, real_output, translate

ERROR = ConnectError
EXPECT = [r"first\.y\b", r"second\.y\b", r"both give a value", r"remedy"]


class Controller(Component):
    y: Real = real_output("V")

    def equations(self) -> Equations:
        yield self.y == 0


class Plant(Component):
    first = Controller()
    second = Controller()

    def equations(self) -> Equations:
        yield connect(self.first.y, self.second.y)  # culprit


def run() -> object:
    return translate(Plant())
