"""A line connects two volumes with different fluids."""

from __future__ import annotations

from arthur_acausal import Component, ConnectError, Equations, connect, translate
from arthur_acausal.components.hydraulic import Fluid, LaminarPipe, Volume

ERROR = ConnectError
EXPECT = [r"two different media", r"left\.fluid", r"right\.fluid", r"one medium"]


class Plant(Component):
    left = Volume(V=1e-3, fluid=Fluid(rho=850.0))
    line = LaminarPipe(L=1.0, d=0.01)
    right = Volume(V=1e-3, fluid=Fluid(rho=1000.0))  # culprit

    def equations(self) -> Equations:
        yield connect(self.left.port, self.line.port_a)
        yield connect(self.line.port_b, self.right.port)


def run() -> object:
    return translate(Plant())
