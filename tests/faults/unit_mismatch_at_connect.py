"""Two connectors with the same names, but one counts moles, the other kilograms."""

from __future__ import annotations

from arthur_acausal import (
    Component,
    Connector,
    Equations,
    Real,
    UnitError,
    connect,
    flow,
    potential,
    translate,
)

ERROR = UnitError
EXPECT = [r"\btank\.port\.q\b", r"\bpump\.port\.q\b", r"is kg s\^-1 ", r"s\^-1 mol", r"remedy"]


class MassPort(Connector):
    p: Real = potential("Pa")
    q: Real = flow("kg/s")


class MolePort(Connector):
    p: Real = potential("Pa")
    q: Real = flow("mol/s")


class Tank(Component):
    port = MassPort()

    def equations(self) -> Equations:
        yield self.port.p == 0


class Pump(Component):
    port = MolePort()

    def equations(self) -> Equations:
        yield self.port.q == 0


class Plant(Component):
    tank = Tank()
    pump = Pump()

    def equations(self) -> Equations:
        yield connect(self.tank.port, self.pump.port)  # culprit


def run() -> object:
    return translate(Plant())
