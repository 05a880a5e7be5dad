"""What a controller of the pump believes about the motor, the pump and the supply."""

from __future__ import annotations

from math import pi

from casadi import SX, fmax

from arthur_acausal import Real, Record, parameter, smooth_if_else


class SupplyModel(Record):
    """Data of the power unit, as its controller has them; a controller that errs has others than the parts.

    See BrushlessMotor, GearPump, Accumulator, ReliefValve and BatteryDrive. ``b`` and ``J`` are those of motor and pump
    together, ``k_P`` is electrical power over voltage and current. Without an accumulator ``V_gas`` is 0. The defaults
    are the quadruped's.
    """

    K_T: Real = parameter("N*m/A", default=0.078, min=0.0, description="torque constant of the motor")
    K_e: Real = parameter("V*s/rad", default=0.06369, min=0.0, description="back-emf constant of the motor")
    R_LL: Real = parameter("ohm", default=0.165, min=0.0, description="resistance of the motor")
    I_max: Real = parameter("A", default=50.0, min=0.0, description="greatest current of the motor")
    k_P: Real = parameter(
        "1", default=1.2247, min=0.0, description="electrical power over voltage and current"
    )
    b: Real = parameter("N*m*s/rad", default=1.00714e-3, min=0.0, description="friction")
    J: Real = parameter("kg*m^2", default=3.173e-4, min=0.0, description="moment of inertia")
    c_L: Real = parameter(
        "m^3", default=1.772e-7, min=0.0, description="torque constant of the pump, D/(2 pi)"
    )
    R_G: Real = parameter("Pa*s/m^3", default=1e12, min=0.0, description="gear resistance")
    RR_G: Real = parameter("1/m^3", default=1e8, min=0.0, description="gear reluctance")
    V_manifold: Real = parameter("m^3", default=4.83e-6, min=0.0, description="fluid of the manifold")
    beta: Real = parameter("Pa", default=1.4e9, min=0.0, description="bulk modulus of the fluid")
    V_gas: Real = parameter("m^3", default=10e-6, min=0.0, description="accumulator: gas at precharge")
    p_pre: Real = parameter("Pa", default=84e5, min=0.0, display="bar", description="accumulator: precharge")
    n: Real = parameter("1", default=1.4, min=1.0, description="accumulator: polytropic exponent")
    p_relief: Real = parameter("Pa", default=140e5, min=0.0, display="bar", description="cracking pressure")
    V_oc: Real = parameter("V", default=44.4, min=0.0, description="open-circuit voltage of the battery")
    R_i: Real = parameter("ohm", default=0.03, min=0.0, description="resistance of the battery")

    def capacitance(self, p: SX) -> SX:
        """Return the supply's capacitance [m^3/Pa] at the pressure ``p``: of the fluid, and of the gas above p_pre."""
        above = fmax(p, self.p_pre)
        gas = self.V_gas * (self.p_pre / above) ** (1 / self.n) / (self.n * above)
        return self.V_manifold / self.beta + smooth_if_else(p > self.p_pre, gas, 0)

    @property
    def delivery(self) -> SX:
        """Return the flow [m^3/s] a rad/s of the pump, without what its pressure makes leak."""
        return self.c_L - 1 / (2 * pi * self.RR_G)

    def balance(self, q: SX, p: SX) -> SX:
        """Return the voltage [V] at which the pump gives the flow ``q`` at the pressure ``p``, steadily."""
        w = (q + p / self.R_G) / self.delivery
        return self.K_e * w + self.R_LL * (self.c_L * p + self.b * w) / self.K_T
