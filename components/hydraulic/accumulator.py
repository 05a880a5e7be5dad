"""Gas accumulator."""

from __future__ import annotations

from casadi import fmax

from arthur_acausal import Component, Equations, Real, der, if_else, parameter, variable
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.laws import gas_energy
from arthur_acausal.components.hydraulic.ports import HydraulicPort


class Accumulator(Component):
    """A bladder accumulator: below the precharge pressure it takes no fluid, above it p V_g^n = p_pre V_0^n.

    State: ``p`` [Pa]. The bladder has no mass, so the gas volume follows the fluid's pressure: V_g = V_0
    (p_pre/p)^(1/n), an ideal gas. The fluid in it, ``V_dead`` more than the bladder gives way, is
    compressible. Passing the precharge pressure is an event, as the stiffness jumps there.

    Parameters: ``V_0`` [m^3] gas volume at precharge, ``p_pre`` [Pa], ``n`` 1 (slow, isothermal) to about
    1.4 (fast, adiabatic; real nitrogen at high pressure has more).
    """

    port = HydraulicPort()
    fluid: Fluid = Fluid()
    V_0: Real = parameter("m^3", min=0.0, description="gas volume at precharge")
    p_pre: Real = parameter("Pa", min=0.0, display="bar", description="precharge pressure")
    n: Real = parameter("1", default=1.4, min=1.0, description="polytropic exponent")
    V_dead: Real = parameter(
        "m^3", default=lambda self: 0.01 * self.V_0, description="fluid volume below precharge"
    )
    p: Real = variable("Pa", start=1e5, nominal=1e7, display="bar", description="fluid pressure")
    V_g: Real = variable("m^3", nominal=1e-4, description="gas volume")
    V_f: Real = variable("m^3", nominal=1e-4, description="fluid volume")
    C_g: Real = variable("m^3/Pa", nominal=1e-11, description="capacitance of the gas")
    m_fluid: Real = variable("kg", nominal=0.1, description="mass of the fluid")
    E_stored: Real = variable("J", description="energy in the gas and the fluid")

    def equations(self) -> Equations:
        p, fluid = self.p, self.fluid
        yield self.p == self.port.p
        yield "gas", self.V_g == self.V_0 * (self.p_pre / fmax(p, self.p_pre)) ** (1 / self.n)
        yield self.V_f == self.V_dead + self.V_0 - self.V_g
        yield self.C_g == if_else(p > self.p_pre, self.V_g / (self.n * p), 0)
        capacitance = self.V_f / fluid.bulk_modulus(p) + self.C_g
        yield "mass balance", capacitance * der(p) == self.port.q * fluid.relative_volume(p)
        yield self.m_fluid == fluid.density(p) * self.V_f
        in_gas = gas_energy(self.p_pre, self.V_0, self.V_g, self.n)
        yield self.E_stored == in_gas + self.V_f * fluid.energy_density(p)
