"""Charging an accumulator until a relief valve opens."""

from __future__ import annotations

from arthur_acausal import Component, Equations, connect, start
from arthur_acausal.components.hydraulic import (
    Accumulator,
    CheckValve,
    FlowSource,
    Fluid,
    ReliefValve,
    Tank,
    Volume,
)


class AccumulatorCharge(Component):
    """A constant flow of 3.8 L/min passes a check valve into an accumulator of 0.1 L, precharged to 84 bar.

    The accumulator fills in a moment up to its precharge pressure (an event), then slowly along the gas's
    polytrope until the relief valve opens at 140 bar.
    """

    fluid: Fluid = Fluid()
    pump = FlowSource(q=3.8e-3 / 60)
    check: CheckValve = CheckValve(A_max=1e-5)
    accumulator: Accumulator = Accumulator(V_0=1e-4, p_pre=84e5, p=start(3e5, fixed=True))
    relief: ReliefValve = ReliefValve(p_c=140e5)
    tank = Tank()

    def build(self) -> None:
        self.line = Volume(V=5e-6, p=start(3e5, fixed=True), fluid=self.fluid)

    def equations(self) -> Equations:
        yield connect(self.pump.port, self.line.port)
        yield connect(self.line.port, self.check.port_a)
        yield connect(self.line.port, self.relief.port_a)
        yield connect(self.relief.port_b, self.tank.port)
        yield connect(self.check.port_b, self.accumulator.port)
