"""The default powertrain flattened by hand, as a careful person would write it for one solver.

Written from the report's section 5 and its corrections, not from the components, and held against them by
tests/benchmarks. 53 states, 23 energies of the audit where wanted, and one algebraic variable, the supply
pressure behind the filter; the rates are explicit, every flow and force substituted.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, pi, sin, sqrt

import casadi
import numpy as np
from casadi import SX
from numpy.typing import NDArray

from arthur_acausal.models.arthur.demo import (
    RISE,
    RISE_OF_VOLTAGE,
    STRIDES,
    VOLTAGE,
    joint_of,
    load,
    rise,
    stroke,
)

Array = NDArray[np.float64]
Inputs = Callable[[SX], tuple[SX, SX, SX]]  # t [s] -> motor voltage [V], 12 currents [A], 12 forces [N]
Powers = dict[str, SX]  # terms of the energy audit [W]

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
    z_path: str


def turbulent(dp: SX, dp_small: float) -> SX:
    """sign(dp) sqrt(|dp|) [Pa^(1/2)], linear below dp_small [Pa]."""
    return dp / casadi.sqrt(casadi.sqrt(dp * dp + dp_small**2))


def compression(p: SX) -> SX:
    """Density over the reference density, for a constant bulk modulus."""
    return casadi.exp(p / BETA)


def head(p: SX) -> SX:
    """Enthalpy times reference density [Pa]: a flow q carries the power q head(p)."""
    return -BETA * casadi.expm1(-p / BETA)


def shaft(V: SX, w: SX, p_d: SX, p_R: SX) -> tuple[SX, SX, Powers]:
    """5.3 to 5.20: angular acceleration [rad/s^2], pumped flow [m^3/s] of fluid at the inlet's density, powers."""
    D = 60 * 1.0 / (15852 * 0.85 * 5000)  # 6.3.1 for 1 gpm at 5000 rpm
    c_L, J = D / (2 * pi), 1.25 * pi * 7750 * (2 * D / pi) ** (5 / 3) + 3.147e-4
    K_T, R_LL, I_max, b_m, b_p = 0.078, 0.165, 50.0, 7.14e-6, 1e-3
    K_e = K_T * sqrt(2 / 3)
    current = casadi.fmin(casadi.fmax((V - K_e * w) / R_LL, 0), I_max)
    turns, dp = w / (2 * pi), p_d - p_R
    acceleration = (K_T * current - (b_m + b_p) * w - c_L * dp) / J
    displaced, leaked = D * turns * compression(p_R), turns / 100e6 + dp / 1e12
    powers = {
        "input": sqrt(3 / 2) * (R_LL * current + K_e * w) * current,
        "copper": sqrt(3 / 2) * R_LL * current**2,
        "motor_friction": b_m * w**2,
        "pump_friction": b_p * w**2,
        "pump_leakage": leaked * (head(p_d) - head(p_R)),
        "pump_compression": c_L * w * dp - displaced * (head(p_d) - head(p_R)),
    }
    return acceleration, displaced - leaked, powers


def relief_flow(p_d: SX, p_R: SX) -> SX:
    """5.22 to 5.28 [m^3/s], cracking at 20.68 MPa."""
    k, d, alpha = 5.16e4, 6.35e-3, 2 * pi / 3
    x_max = d / sin(alpha) * (sqrt(1 + cos(alpha / 2)) - 1)
    x = casadi.fmin(casadi.fmax(pi * d**2 / (4 * k) * (p_d - 20.68e6), 0), x_max)
    area = pi * (d + x * sin(alpha / 2) * cos(alpha / 2)) * x * sin(alpha / 2)
    return 0.78 * area * sqrt(2 / RHO_0) * turbulent(p_d - p_R, 1e4)


def valves(I: SX, p_S: SX, p_R: SX, p_A: SX, p_B: SX) -> tuple[SX, SX, SX]:
    """5.36, 5.37: flows out of port A, into port B [m^3/s], losses [W]; a negative current swaps the ports."""
    gain = 7.5e-3 / 60 / sqrt(35e5) * I
    forward = I >= 0
    Q_A = gain * turbulent(casadi.if_else(forward, p_S - p_A, p_A - p_R), 1e4)
    Q_B = gain * turbulent(casadi.if_else(forward, p_B - p_R, p_S - p_B), 1e4)
    Q_S, Q_R = casadi.if_else(forward, Q_A, -Q_B), casadi.if_else(forward, Q_B, -Q_A)
    loss = Q_S * head(p_S) - Q_R * head(p_R) - Q_A * head(p_A) + Q_B * head(p_B)
    return Q_A, Q_B, loss


def cylinders(v: SX, y: SX, p_A: SX, p_B: SX, Q_A: SX, Q_B: SX, F: SX) -> tuple[SX, SX, SX, SX]:
    """5.51 to 5.54: rates of v, p_A, p_B; losses [W] of friction (1 - eta)|F| and damping against the motion."""
    m, c, k, y_max = 0.05, 10.0, 1.436e6, 0.035
    A_A, A_B, V_0 = 7.13e-5, 5.35e-5, 6.5e-7
    pressure = A_A * p_A - A_B * p_B
    friction = 0.05 * casadi.fabs(pressure) * casadi.tanh(v / 5e-3) + c * v
    stop = -k * (casadi.fmin(y + y_max, 0) + casadi.fmax(y - y_max, 0))
    dv = (pressure - friction - F + stop) / m
    dp_A = BETA / (V_0 + A_A * (y + y_max)) * (Q_A / compression(p_A) - A_A * v)
    dp_B = BETA / (V_0 + A_B * (y_max - y)) * (-Q_B / compression(p_B) + A_B * v)
    return dv, dp_A, dp_B, friction * v


def reservoir(v: SX, z: SX, p: SX, q: SX) -> tuple[SX, SX, Powers]:
    """5.61 to 5.69: rates of the piston's velocity v and of the fluid's pressure p with the flow q in, losses."""
    A, L, m, b, k, V_f0, V_g0 = 0.00115, 0.0635, 0.04, 10.0, 1.42e9, 2.3e-5, 2.3e-5
    p_gas = 3e5 * (V_g0 + A * (L - 0.04)) / (V_g0 + A * (L - z))
    stop = -k * (casadi.fmin(z, 0) + casadi.fmax(z - L, 0))
    dv = (A * (p - p_gas) - b * v + stop) / m
    return dv, BETA / (V_f0 + A * z) * (q / compression(p) - A * v), {"reservoir": b * v**2}


def trot(t: SX) -> tuple[SX, SX, SX]:
    """The demo's inputs: motor voltage [V], currents [A] and load forces [N] at t [s]."""
    joints = [joint_of(i) for i in range(N)]
    currents = [stroke(t, joint.current, STRIDES, phase, RISE) for joint, phase in joints]
    forces = [load(t, joint.force, STRIDES, phase, RISE) for joint, phase in joints]
    return rise(t, VOLTAGE, RISE_OF_VOLTAGE), casadi.vertcat(*currents), casadi.vertcat(*forces)


def flat(inputs: Inputs, audit: bool = False) -> Flat:
    """Return the powertrain with the given inputs from Table 5's state; `audit` adds the integrals of the powers."""
    t = SX.sym("t")
    w, p_d, p_s, v_r, z, p_R = (SX.sym(name) for name in ("w", "p_d", "p_s", "v_r", "z", "p_R"))
    v, y, p_A, p_B = (SX.sym(name, N) for name in ("v", "y", "p_A", "p_B"))
    V, I, F = inputs(t)

    dw, Q, powers = shaft(V, w, p_d, p_R)
    Q_RV = relief_flow(p_d, p_R)
    Q_A, Q_B, lands = valves(I, p_s, p_R, p_A, p_B)
    Q_S = casadi.sum1(casadi.if_else(I >= 0, Q_A, -Q_B))
    Q_R = casadi.sum1(casadi.if_else(I >= 0, Q_B, -Q_A))
    dp_d = BETA / 4.83e-6 * (Q - Q_RV - Q_S) / compression(p_d)
    dv, dp_A, dp_B, friction = cylinders(v, y, p_A, p_B, Q_A, Q_B, F)
    dv_r, dp_R, damping = reservoir(v_r, z, p_R, Q_R + Q_RV - Q)
    powers |= damping | {
        "relief": Q_RV * (head(p_d) - head(p_R)),
        "filter": Q_S * (head(p_d) - head(p_s)),
        "cylinders": casadi.sum1(friction),
        "work": casadi.dot(F, v),
        **{f"valves[{i}]": lands[i] for i in range(N)},
    }
    energies = SX.sym("energies", len(powers) if audit else 0)
    metered = casadi.vertcat(*powers.values()) if audit else SX(0, 1)
    zeros, ones, none = np.zeros(N), np.ones(N), np.ones(energies.numel())
    piston, chambers = [0.1 * ones, 0.01 * ones], [np.full(2 * N, 1e7)]
    typical = [np.array([500, 1e7]), *piston, *chambers, np.array([0.1, 0.01, 1e7]), 100 * none]
    return Flat(
        t=t,
        x=casadi.vertcat(w, p_d, v, y, p_A, p_B, v_r, z, p_R, energies),
        z=p_s,
        ode=casadi.vertcat(dw, dp_d, dv, v, dp_A, dp_B, dv_r, v_r, dp_R, metered),
        alg=p_d - p_s - 1e9 * Q_S,
        x0=np.concatenate([[0, 3e5], zeros, zeros, np.full(2 * N, 3e5), [0, 0.04, 3e5], 0 * none]),
        z0=np.array([3e5]),
        x_nominal=np.concatenate(typical),
        z_nominal=np.array([1e7]),
        paths=(
            "motor.w",
            "manifold.p",
            *(f"cylinders[{i}].{name}" for name in ("v", "y", "p_A", "p_B") for i in range(N)),
            "reservoir.v",
            "reservoir.z",
            "reservoir.p",
            *(f"energy_{name}.E" for name in powers if audit),
        ),
        z_path="filter.p_s",
    )
