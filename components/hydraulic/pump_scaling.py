"""Sizing of a gear pump from the flow that it shall give: ARTHuR report, sections 5.2, 6.2.1 and 6.3.1."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import TypeAlias

from casadi import SX

Number: TypeAlias = "float | SX"

GPM = 1 / 15852
"""One US gallon a minute [m^3/s] with the report's rounded factor."""
GPM_EXACT = 231 * 0.0254**3 / 60
"""One US gallon a minute [m^3/s]: 231 cubic inches; the report's factor should read 15850.32."""


@dataclass(frozen=True, slots=True)
class PumpSize:
    """Displacement ``D`` [m^3/turn], torque constant ``c_L`` [m^3], inertia ``J`` [kg m^2], pitch radius."""

    D: Number
    c_L: Number
    J: Number
    r_p: Number


def pump_scaling(
    Q_req: Number, N_0: Number, *, eta_v: Number | float = 0.85, rho_gear: Number | float = 7750.0
) -> PumpSize:
    """Size a pump for the flow ``Q_req`` [m^3/s] at the speed ``N_0`` [rad/s].

    The volumetric efficiency ``eta_v`` [1] is assumed: 0.85 in the report's Table 6 and code, 0.7 in its
    text; the leakage of Table 7 gives 0.71 to 0.93 at 207 bar. ``rho_gear`` [kg/m^3]: steel.
    """
    return gear_size(Q_req / (eta_v * N_0 / (2 * pi)), rho_gear=rho_gear)


def consistent_displacement(Q_req: Number, N_0: Number, dp: Number, R_G: Number, RR_G: Number) -> Number:
    """Return the displacement [m^3] that gives ``Q_req`` at ``N_0`` against ``dp`` [Pa] by eq. 5.14."""
    return (Q_req + dp / R_G) / (N_0 / (2 * pi)) + 1 / RR_G


def gear_size(D: Number, *, rho_gear: Number | float = 7750.0) -> PumpSize:
    """Return the pump of displacement ``D`` [m^3] whose gears are similar to the report's (5.15 to 5.20).

    Addendum and dedendum 0.1 r_p, width 1.25 r_p; the inertia is that of both gears as cylinders.
    """
    r_p = (2 * D / pi) ** (1 / 3)
    return PumpSize(D, D / (2 * pi), 5 / 4 * pi * rho_gear * r_p**5, r_p)
