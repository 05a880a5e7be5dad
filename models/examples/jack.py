"""A hydraulic jack: the smallest model of two domains."""

from __future__ import annotations

from arthur_acausal import Component, Equations, connect, start
from arthur_acausal.components.hydraulic import Fluid, Orifice, PressureSource, Ram
from arthur_acausal.components.translational import ForceSource, Mass


class Jack(Component):
    """A pump lifts 500 kg through an orifice: pressure source, orifice, ram, mass.

    The weight acts as the external input ``weight.f`` [N], -4905 unless given. The piston starts at rest at
    0 with the pressure that carries the weight; it then rises at the speed that the orifice allows.
    """

    fluid: Fluid = Fluid()
    supply = PressureSource(p=100e5)
    orifice: Orifice = Orifice(area=2e-6)
    load: Mass = Mass(m=500.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    weight = ForceSource(f=-4905.0)

    def build(self) -> None:
        p = start(49.05e5, fixed=True)
        self.ram = Ram(area=1e-3, dead_volume=1e-5, p=p, fluid=self.fluid)

    def equations(self) -> Equations:
        yield connect(self.supply.port, self.orifice.port_a)
        yield connect(self.orifice.port_b, self.ram.port)
        yield connect(self.ram.rod, self.load.flange)
        yield connect(self.weight.flange, self.load.flange)
