"""Reservoir with a gas-loaded piston."""

from __future__ import annotations

from typing import Literal

from arthur_acausal import Component, Equations, Real, der, parameter, real_output, variable
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.laws import gas_energy, stop_energy, stop_force
from arthur_acausal.components.hydraulic.ports import HydraulicPort

GasLaw = Literal["algebraic", "integrated"]


class GasReservoir(Component):
    """A closed reservoir: fluid on one side of a piston, gas on the other (ARTHuR report, section 5.7).

    States: piston position ``z`` [m] (0 at the fluid's end, positive towards the gas), velocity ``v``
    [m/s], fluid pressure ``p`` [Pa]. V_f = V_f0 + A_R z, V_g = V_g0 + A_R (L - z) (the report's code; 5.66
    has the sign wrong). The gas follows p_g V_g^n = const from ``p_gi`` at ``z_i``; n = 1, isothermal, as
    5.57.

    Structural options: ``gas``: "algebraic", the default, keeps that law exactly; "integrated" makes p_g a
    state by 5.64 (n = 1). ``stop_events``: True makes contact with a stop an event.

    Parameters: Table 11; ``k`` [N/m] is 1.42e9, the likely value, for the printed 1.42e12 (which means a
    piston 56 um thick). The piston rings at about 4.2 kHz with a damping ratio of 0.005.
    """

    gas: GasLaw = "algebraic"
    stop_events: bool = False
    port = HydraulicPort()
    fluid: Fluid = Fluid()
    L: Real = parameter("m", default=0.0635, min=0.0, description="stroke")
    A_R: Real = parameter("m^2", default=1.15e-3, min=0.0, description="piston area")
    V_f0: Real = parameter("m^3", default=2.3e-5, min=0.0, description="fluid volume at z = 0")
    V_g0: Real = parameter("m^3", default=2.3e-5, min=0.0, description="gas volume at z = L")
    z_i: Real = parameter("m", default=0.04, description="position at which the gas has p_gi")
    p_gi: Real = parameter("Pa", default=3e5, min=0.0, display="bar", description="gas pressure at z_i")
    n: Real = parameter("1", default=1.0, min=1.0, description="polytropic exponent of the gas")
    m_p: Real = parameter("kg", default=0.04, min=0.0, description="piston mass")
    k: Real = parameter("N/m", default=1.42e9, min=0.0, description="stiffness of the stops, eq. 5.68")
    b: Real = parameter("N*s/m", default=10.0, min=0.0, description="damping of the piston")
    z: Real = variable(
        "m", start=lambda self: self.z_i, nominal=0.01, display="mm", description="piston position"
    )
    v: Real = variable("m/s", start=0.0, nominal=0.1, description="piston velocity")
    p: Real = variable(
        "Pa", start=lambda self: self.p_gi, nominal=1e5, display="bar", description="fluid pressure"
    )
    p_g: Real = variable(
        "Pa", start=lambda self: self.p_gi, nominal=1e5, display="bar", description="gas pressure"
    )
    V_f: Real = variable("m^3", nominal=1e-5, description="fluid volume")
    V_g: Real = variable("m^3", nominal=1e-5, description="gas volume")
    m_fluid: Real = variable("kg", nominal=0.1, description="mass of the fluid")
    P_loss: Real = real_output("W", description="power turned to heat by the piston's damping")
    E_stored: Real = variable("J", description="kinetic, stop springs, gas and fluid")

    def build(self) -> None:
        check_choice(self, "gas", GasLaw)

    def equations(self) -> Equations:
        yield self.p == self.port.p
        yield self.v == der(self.z)
        yield self.V_f == self.V_f0 + self.A_R * self.z
        yield self.V_g == self.V_g0 + self.A_R * (self.L - self.z)
        rate = self.fluid.pressure_rate(self.p, self.port.q, self.V_f, self.A_R * self.v)
        yield "mass balance", der(self.p) == rate
        V_gi = self.V_g0 + self.A_R * (self.L - self.z_i)
        if self.gas == "integrated":
            yield "gas", der(self.p_g) == self.p_gi * V_gi / self.V_g**2 * self.A_R * self.v
        else:
            yield "gas", self.p_g == self.p_gi * (V_gi / self.V_g) ** self.n
        stop = stop_force(self.z, 0.0, self.L, self.k, self.stop_events)
        yield (
            "Newton's second law",
            self.m_p * der(self.v) == self.A_R * (self.p - self.p_g) - self.b * self.v + stop,
        )
        yield self.m_fluid == self.fluid.density(self.p) * self.V_f
        yield self.P_loss == self.b * self.v**2
        springs = stop_energy(self.z, 0.0, self.L, self.k)
        in_gas = gas_energy(self.p_gi, V_gi, self.V_g, self.n)
        in_fluid = self.V_f * self.fluid.energy_density(self.p)
        yield self.E_stored == self.m_p * self.v**2 / 2 + springs + in_gas + in_fluid
