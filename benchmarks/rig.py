"""A servo-hydraulic rig of n legs, from library components: what a test bench with many actuators is made of.

A pump of constant flow with its relief valve feeds a manifold; each leg is a four-way valve with a spool of second
order, a double-acting cylinder, and a mass on a spring, moved by a sine of a frequency and phase of its own. States:
the manifold's pressure and six a leg, 73 for twelve legs.

The pump delivers more than the legs take and the strokes stay within the cylinders: no chamber runs dry, no piston
meets a stop, the relief valve stays open. A leg's mass on its oil columns rings at about 150 Hz.
"""

from __future__ import annotations

from math import pi

from arthur_acausal import Component, Equations, connect, start
from arthur_acausal.components.blocks import Sine
from arthur_acausal.components.hydraulic import (
    Cylinder,
    FlowSource,
    Fluid,
    ReliefValve,
    ServoValve,
    Tank,
    Volume,
)
from arthur_acausal.components.translational import Fixed, Mass, Spring

RELIEF = 140e5  # [Pa]
P_A = 70e5  # [Pa] at the start
AREAS = 7.13e-5 / 5.35e-5  # of the cylinder's sides, A over B: the piston starts in balance
LEAKAGE = (
    5e-13  # [m^3/(s Pa)] of a land: 0.4 L/min through a valve at rest at 140 bar, as data sheets have it
)


class Rig(Component):
    """A pump of 40 L/min, a relief valve at 140 bar, a manifold of 1 L, and n legs at 2, 2.2, 2.4, ... Hz."""

    n: int = 12
    fluid: Fluid = Fluid()
    pump = FlowSource(q="40 L/min")
    relief = ReliefValve(p_c=RELIEF)
    tank = Tank()
    ground = Fixed()

    def build(self) -> None:
        self.manifold = Volume(fluid=self.fluid, V="1 L", p=start(RELIEF, fixed=True))
        legs = range(self.n)
        self.commands = [
            Sine.of("A")(amplitude=0.08, f=2.0 + 0.2 * k, phase=2.0 * pi * k / self.n) for k in legs
        ]
        self.valves = [
            ServoValve(
                spool="second order",
                f_spool=100.0,
                G_leak=LEAKAGE,
                x=start(0.0, fixed=True),
                v=start(0.0, fixed=True),
            )
            for _ in legs
        ]
        self.cylinders = [
            Cylinder(inertia=False, p_A=start(P_A, fixed=True), p_B=start(P_A * AREAS, fixed=True))
            for _ in legs
        ]
        self.loads = [Mass(m=5.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)) for _ in legs]
        self.springs = [Spring(c=2e4) for _ in legs]

    def equations(self) -> Equations:
        yield connect(self.pump.port, self.manifold.port)
        yield connect(self.relief.port_a, self.manifold.port)
        yield connect(self.relief.port_b, self.tank.port)
        legs = zip(self.commands, self.valves, self.cylinders, self.loads, self.springs, strict=True)
        for command, valve, cylinder, load, spring in legs:
            yield connect(command.y, valve.I)
            yield connect(valve.port_p, self.manifold.port)
            yield connect(valve.port_t, self.tank.port)
            yield connect(valve.port_a, cylinder.port_a)
            yield connect(valve.port_b, cylinder.port_b)
            yield connect(cylinder.flange, load.flange)
            yield connect(load.flange, spring.flange_a)
            yield connect(spring.flange_b, self.ground.flange)
