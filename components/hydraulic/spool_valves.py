"""Directional and proportional spool valves, made of a spool and metering edges."""

from __future__ import annotations

from arthur_acausal import Component, Equations, Real, connect, real_input, real_output
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.ports import HydraulicPort
from arthur_acausal.components.hydraulic.spool import CentreEdge, LoadSelector, MeteringEdge, Spool


class Valve22(Component):
    """A valve with two ports: its spool opens P to A.

    ``command`` [1]: the spool's position over its x_max, or on and off where the spool is ``switched``. ``x`` [m]:
    the spool's position. Give the size with the parts: ``Valve22(spool=Spool(x_max=...),
    edge_pa=MeteringEdge(width=...))``. Fluid is neither stored nor compressed.
    """

    port_p = HydraulicPort()
    port_a = HydraulicPort()
    fluid: Fluid = Fluid()
    command: Real = real_input("1", default=0.0)
    x: Real = real_output("m", nominal=1e-3)
    spool: Spool = Spool()
    edge_pa: MeteringEdge = MeteringEdge()

    def equations(self) -> Equations:
        yield connect(self.command, self.spool.command)
        yield connect(self.spool.x, self.x)
        yield connect(self.spool.x, self.edge_pa.x)
        yield connect(self.port_p, self.edge_pa.port_a)
        yield connect(self.edge_pa.port_b, self.port_a)


class Valve33(Valve22):
    """A valve with three ports: a positive position opens P to A, a negative one A to T.

    With a ``switched`` spool from 0 to x_max and an overlap of -x_max of ``edge_at`` it is a 3/2 valve, which joins A
    to T at rest. See ``Valve22``.
    """

    port_t = HydraulicPort()
    edge_at: MeteringEdge = MeteringEdge()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.spool.x_back, self.edge_at.x)
        yield connect(self.port_a, self.edge_at.port_a)
        yield connect(self.edge_at.port_b, self.port_t)


class Valve43(Valve33):
    """A valve with four ports: a positive position opens P to A and B to T, a negative one P to B and A to T.

    Closed in the middle where the edges overlap. With a ``switched`` spool from 0 to x_max and overlaps of -x_max of
    ``edge_pb`` and ``edge_at`` it is a 4/2 valve. See ``Valve22``; ``ServoValve`` is the same with one gain from
    data sheet figures.
    """

    port_b = HydraulicPort()
    edge_pb: MeteringEdge = MeteringEdge()
    edge_bt: MeteringEdge = MeteringEdge()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.spool.x_back, self.edge_pb.x)
        yield connect(self.spool.x, self.edge_bt.x)
        yield connect(self.port_p, self.edge_pb.port_a)
        yield connect(self.edge_pb.port_b, self.port_b)
        yield connect(self.port_b, self.edge_bt.port_a)
        yield connect(self.edge_bt.port_b, self.port_t)


class OpenCentreValve(Valve43):
    """A ``Valve43`` with a passage from C1 to C2 that is open in the middle and closes at either end."""

    port_c1 = HydraulicPort()
    port_c2 = HydraulicPort()
    edge_cc: CentreEdge = CentreEdge()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.spool.x, self.edge_cc.x)
        yield connect(self.port_c1, self.edge_cc.port_a)
        yield connect(self.edge_cc.port_b, self.port_c2)


class LoadSensingValve(Valve43):
    """A ``Valve43`` whose ``port_l`` tells the pressure of the port that it feeds: A for x > 0, B for x < 0."""

    port_l = HydraulicPort()
    selector: LoadSelector = LoadSelector()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.spool.x, self.selector.x)
        yield connect(self.port_a, self.selector.port_a)
        yield connect(self.port_b, self.selector.port_b)
        yield connect(self.selector.port_l, self.port_l)
