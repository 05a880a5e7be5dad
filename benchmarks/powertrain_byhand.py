"""The default powertrain flattened by hand, as a careful person would write it for one solver.

Written from the report's section 5 and its corrections, not from the components, and held against them by
tests/benchmarks. 53 states and one algebraic variable, the supply pressure behind the filter; the rates are
explicit, every flow and force substituted.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, pi, sin, sqrt

import casadi
import numpy as np
from casadi import SX
from numpy.typing import NDArray

Array = NDArray[np.float64]
Inputs = Callable[[SX], tuple[SX, SX, SX]]  # t [s] -> motor voltage [V], 12 currents [A], 12 forces [N]

N = 12
BETA, RHO_0 = 1.4e9, 850.0  # bulk modulus [Pa], reference density [kg/m^3]


@dataclass(frozen=True, slots=True)
class Flat:
    """x' = ode(t, x, z), 0 = alg(t, x, z), with start values, nominal values and our model's path of each."""

    t: SX
    x: SX
    z: SX
    ode: SX
    alg: SX
    x0: Array
    z0: Array
    x_nominal: Array
    z_nominal: Array
    paths: tuple[str, ...]


def turbulent(dp: SX, dp_small: float) -> SX:
    """sign(dp) sqrt(|dp|) [Pa^(1/2)], linear below dp_small [Pa]."""
    return dp / casadi.sqrt(casadi.sqrt(dp * dp + dp_small**2))


def compression(p: SX) -> SX:
    """Density over the reference density, for a constant bulk modulus."""
    return casadi.exp(p / BETA)


def pump_size(flow_gpm: float, speed_rpm: float) -> tuple[float, float, float]:
    """6.3.1: displacement [m^3 a revolution], c_L [m^3], inertia of motor and gears [kg m^2]."""
    D = 60 * flow_gpm / (15852 * 0.85 * speed_rpm)
    return D, D / (2 * pi), 1.25 * pi * 7750 * (2 * D / pi) ** (5 / 3) + 3.147e-4


def shaft(V: SX, w: SX, dp: SX) -> tuple[SX, SX]:
    """5.3 to 5.14: angular acceleration [rad/s^2] and pumped volume at the inlet [m^3/s]."""
    D, c_L, J = pump_size(1.0, 5000.0)
    K_T, R_LL, I_max = 0.078, 0.165, 50.0
    K_e = K_T * sqrt(2 / 3)
    torque = casadi.fmin(casadi.fmax(K_T / R_LL * (V - K_e * w), 0), I_max * K_T)
    acceleration = (torque - (7.14e-6 + 1e-3) * w - c_L * dp) / J
    return acceleration, w / (2 * pi) * (D - 1 / 100e6) - dp / 1e12


def relief_flow(p_d: SX, p_R: SX) -> SX:
    """5.22 to 5.28 [m^3/s], cracking at 20.68 MPa."""
    k, d, alpha = 5.16e4, 6.35e-3, 2 * pi / 3
    x_max = d / sin(alpha) * (sqrt(1 + cos(alpha / 2)) - 1)
    x = casadi.fmin(casadi.fmax(pi * d**2 / (4 * k) * (p_d - 20.68e6), 0), x_max)
    area = pi * (d + x * sin(alpha / 2) * cos(alpha / 2)) * x * sin(alpha / 2)
    return 0.78 * area * sqrt(2 / RHO_0) * turbulent(p_d - p_R, 1e4)


def valve_flows(I: SX, p_S: SX, p_R: SX, p_A: SX, p_B: SX) -> tuple[SX, SX]:
    """5.36, 5.37: flows out of port A and into port B [m^3/s]; a negative current swaps the ports."""
    gain = 7.5e-3 / 60 / sqrt(35e5) * I
    dp_A = casadi.if_else(I >= 0, p_S - p_A, p_A - p_R)
    dp_B = casadi.if_else(I >= 0, p_B - p_R, p_S - p_B)
    return gain * turbulent(dp_A, 1e4), gain * turbulent(dp_B, 1e4)


def cylinder(v: SX, y: SX, p_A: SX, p_B: SX, Q_A: SX, Q_B: SX, F: SX) -> tuple[SX, SX, SX]:
    """5.51 to 5.54: rates of v, p_A, p_B, with friction (1 - eta)|F| against the motion."""
    m, c, k, y_max = 0.05, 10.0, 1.436e6, 0.035
    A_A, A_B, V_0 = 7.13e-5, 5.35e-5, 6.5e-7
    pressure = A_A * p_A - A_B * p_B
    friction = 0.05 * casadi.fabs(pressure) * casadi.tanh(v / 5e-3)
    stop = -k * (casadi.fmin(y + y_max, 0) + casadi.fmax(y - y_max, 0))
    dv = (pressure - friction - c * v - F + stop) / m
    dp_A = BETA / (V_0 + A_A * (y + y_max)) * (Q_A / compression(p_A) - A_A * v)
    dp_B = BETA / (V_0 + A_B * (y_max - y)) * (-Q_B / compression(p_B) + A_B * v)
    return dv, dp_A, dp_B


def reservoir(w: SX, z: SX, p: SX, q: SX) -> tuple[SX, SX]:
    """5.61 to 5.69: rates of the piston's velocity w and of the fluid's pressure p, with the flow q in."""
    A, L, m, b, k, V_f0, V_g0 = 0.00115, 0.0635, 0.04, 10.0, 1.42e9, 2.3e-5, 2.3e-5
    p_gas = 3e5 * (V_g0 + A * (L - 0.04)) / (V_g0 + A * (L - z))
    stop = -k * (casadi.fmin(z, 0) + casadi.fmax(z - L, 0))
    dw = (A * (p - p_gas) - b * w + stop) / m
    return dw, BETA / (V_f0 + A * z) * (q / compression(p) - A * w)


def flat(inputs: Inputs) -> Flat:
    """Return the powertrain with the given inputs from Table 5's state."""
    t = SX.sym("t")
    w, p_d, p_s, w_r, z, p_R = (SX.sym(name) for name in ("w", "p_d", "p_s", "w_r", "z", "p_R"))
    v, y, p_A, p_B = (SX.sym(name, N) for name in ("v", "y", "p_A", "p_B"))
    V, I, F = inputs(t)

    dw, pumped = shaft(V, w, p_d - p_R)
    Q = pumped * compression(p_R)
    Q_RV = relief_flow(p_d, p_R)
    Q_A, Q_B = valve_flows(I, p_s, p_R, p_A, p_B)
    Q_S = casadi.sum1(casadi.if_else(I >= 0, Q_A, -Q_B))
    Q_R = casadi.sum1(casadi.if_else(I >= 0, Q_B, -Q_A))
    dp_d = BETA / 4.83e-6 * (Q - Q_RV - Q_S) / compression(p_d)
    dv, dp_A, dp_B = cylinder(v, y, p_A, p_B, Q_A, Q_B, F)
    dw_r, dp_R = reservoir(w_r, z, p_R, Q_R + Q_RV - Q)

    zeros, ones = np.zeros(N), np.ones(N)
    return Flat(
        t=t,
        x=casadi.vertcat(w, p_d, v, y, p_A, p_B, w_r, z, p_R),
        z=p_s,
        ode=casadi.vertcat(dw, dp_d, dv, v, dp_A, dp_B, dw_r, w_r, dp_R),
        alg=p_d - p_s - 1e9 * Q_S,
        x0=np.concatenate([[0, 3e5], zeros, zeros, 3e5 * ones, 3e5 * ones, [0, 0.04, 3e5]]),
        z0=np.array([3e5]),
        x_nominal=np.concatenate([[500, 1e7], 0.1 * ones, 0.01 * ones, np.full(24, 1e7), [0.1, 0.01, 1e7]]),
        z_nominal=np.array([1e7]),
        paths=(),
    )
