"""The report's eight Matlab listings (6.3.1 to 6.3.8), transcribed line by line, slips and values as printed.

Source: ARTHuR report, NRL (2022), section 6.3; figure 6-1 joins the functions, equation 6.1 is the filter and
Table 5 the initial state. Nothing here imports the package under test. Names are the listings' own, so that
each line can be held against the printed one; only Matlab's loops over the twelve actuators are written as
NumPy arrays. A trailing axis of many states may follow every array.

Kept as printed: 15852 gpm a m^3/s; the motor's torque is clamped from above only; sqrt(abs(2*p_d/density))
in the relief valve; c_act 10 for actuator 1 and 100 for the others; A_B = 0.75 A_A; A_R 0.0011 m^2;
k 1.42e12 N/m; equation 6.1 with the pump's flow.

The state is [N (rpm), p_d (Pa), VAS(1,:) (m/s), VAS(2,:) (m), VAS(3,:) (Pa), VAS(4,:) (Pa),
RS (m/s, m, Pa, Pa)], 54 numbers.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, sin, sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

N_ACTUATORS = 12
N_STATES = 1 + 1 + 4 * N_ACTUATORS + 4


def rated_valve_gain(Q: float, I_rated: float, dp_land: float, rho: float) -> float:
    """Return K_V [m^2/A] of 5.36 from a rated flow [m^3/s] at a current [A] and a drop a land [Pa]."""
    return Q / (I_rated * sqrt(2 / rho * dp_land))


@dataclass(frozen=True, slots=True)
class Constants:
    """The top-level constants of 6.1 that the report does not give (or has redacted); all assumed."""

    beta: float = 1.4e9  # bulk modulus [Pa]
    rho: float = 850.0  # fluid density [kg/m^3]
    R_hf: float = 1e9  # filter's hydraulic resistance [Pa s/m^3]
    p_c: float = 20.68e6  # cracking pressure, 3000 psi [Pa]
    Q_req: float = 1.0  # required flow [gpm]
    N_0: float = 5000.0  # nominal pump speed [rpm]
    K_V: float = rated_valve_gain(7.5e-3 / 60, 1.0, 35e5, 850.0)  # valve gain [m^2/A]


def pump_scaling(Q_req: float, N_0: float) -> tuple[float, float, float]:
    """6.3.1: D [m^3], torque constant [m^3] and total inertia [kg m^2] from gpm and rpm."""
    eta_v = 0.85
    rho = 7750
    J_motor = 0.0003147
    D = 60 * Q_req / (15852 * eta_v * N_0)
    r_p = (2 * D / pi) ** (1 / 3)
    c_L = (1 / 2) * D / pi
    J_tot = (5 / 4) * pi * rho * r_p**5 + J_motor
    return D, c_L, J_tot


def motor(V_motor: Array, delta_p: Array, N: Array, c_L: float, J_tot: float) -> tuple[Array, Array]:
    """6.3.2: motor torque [N m] and dN/dt [rpm/s]."""
    K_T = 0.078
    R_LL = 0.165
    b_m = 7.14e-6
    b_p = 1e-3
    I_max = 50
    K_e = (2 * pi / 60) * sqrt(2 / 3) * K_T
    torque = K_T / R_LL * (V_motor - K_e * N)
    torque = np.where(torque > I_max * K_T, I_max * K_T, torque)
    N_dot = 60 / (2 * pi * J_tot) * (torque - 2 * pi / 60 * (b_m + b_p) * N - c_L * delta_p)
    return torque, N_dot


def pump(N: Array, delta_p: Array, D: float) -> Array:
    """6.3.3: pump output flow [m^3/s]."""
    R_G = 1000 * 10**9
    RR_G = 100 * 10**6
    return (N / 60) * (D - 1 / RR_G) - delta_p / R_G


def manifold(Q: Array, Q_RV: Array, Q_valves: Array, beta: float) -> Array:
    """6.3.4: rate of the manifold's pressure [Pa/s]."""
    V_m = 4.83e-6
    return beta / V_m * (Q - Q_RV - Q_valves)


def relief_valve(p_d: Array, p_c: float, density: float) -> Array:
    """6.3.5: flow through the relief valve [m^3/s]."""
    k = 5.16e4
    d_p = 6.35e-3
    alpha = 2 * pi / 3
    C_d = 0.78
    c_o = pi * d_p**2 / (4 * k) * sin(alpha / 2)
    opened = pi * d_p * c_o * (p_d - p_c) + pi * cos(alpha / 2) * c_o**2 * (p_d - p_c) ** 2
    A_o = np.where(p_d > p_c, opened, 0.0)
    return np.where(p_d < 0, 0.0, A_o * C_d * np.sqrt(np.abs(2 * p_d / density)))


def valve_array(
    p_S: Array, p_A: Array, p_B: Array, p_R: Array, rho: float, I: Array, K_V: float
) -> tuple[Array, Array, Array, Array]:
    """6.3.6: flows Q_A, Q_B of 12 ports, total supply and return flow [m^3/s]. K_V is redacted there."""
    forward = I >= 0
    Q_A = np.where(
        forward,
        K_V * I * np.sqrt(2 / rho * np.abs(p_S - p_A)) * np.sign(p_S - p_A),
        K_V * I * np.sqrt(2 / rho * np.abs(p_A - p_R)) * np.sign(p_A - p_R),
    )
    Q_B = np.where(
        forward,
        K_V * I * np.sqrt(2 / rho * np.abs(p_B - p_R)) * np.sign(p_B - p_R),
        K_V * I * np.sqrt(2 / rho * np.abs(p_S - p_B)) * np.sign(p_S - p_B),
    )
    Q_S = np.where(forward, Q_A, -Q_B).sum(axis=0)
    Q_R = np.where(forward, Q_B, -Q_A).sum(axis=0)
    return Q_A, Q_B, Q_S, Q_R


def actuator_array(VAS: Array, Q_A: Array, Q_B: Array, F_L: Array, beta: float) -> Array:
    """6.3.7: rates of VAS(i) = [nu (m/s); y (m); p_A (Pa); p_B (Pa)]."""
    # The twelve differ in c_act(1) only; a column, so that a trailing axis may follow.
    c_act = np.full((N_ACTUATORS,) + (1,) * (VAS.ndim - 2), 100.0)
    c_act[0] = 10.0
    m_p = 0.05
    y_max = 0.035
    y_min = -0.035
    eta_act = 0.95
    A_A = 7.13e-5
    A_B = 0.75 * A_A
    V_A0 = 6.5e-7
    V_B0 = 6.5e-7
    k = 1.436e6
    V_A = V_A0 + A_A * (VAS[1] - y_min)
    V_B = V_B0 + A_B * (y_max - VAS[1])
    F_r = np.where(
        VAS[1] < y_min,
        -k * (VAS[1] - y_min),
        np.where(VAS[1] > y_max, -k * (VAS[1] - y_max), 0.0),
    )
    dVAS = np.empty_like(VAS)
    dVAS[0] = 1 / m_p * (eta_act * (A_A * VAS[2] - A_B * VAS[3]) - c_act * VAS[0] - F_L + F_r)
    dVAS[1] = VAS[0]
    dVAS[2] = beta / V_A * (Q_A - A_A * VAS[0])
    dVAS[3] = beta / V_B * (-Q_B + A_B * VAS[0])
    return dVAS


def reservoir(RS: Array, Q: Array, Q_RV: Array, Q_R: Array, beta: float) -> Array:
    """6.3.8: rates of RS = [z_dot (m/s); z (m); p_fluid (Pa); p_gas (Pa)]."""
    b = 10
    A_R = 0.0011
    m_p = 0.04
    L = 0.0635
    V_f0 = 2.3e-5
    V_g0 = 2.3e-5
    p_gi = 3 * 100000
    z_i = 0.04
    k = 1.42e12
    k_0 = p_gi * (V_g0 + A_R * (L - z_i))
    V_f = V_f0 + A_R * RS[1]
    V_g = V_g0 + A_R * (L - RS[1])
    F_r = np.where(RS[1] < 0, -k * RS[1], np.where(RS[1] > L, -k * (RS[1] - L), 0.0))
    dRS = np.empty_like(RS)
    dRS[0] = 1 / m_p * (A_R * (RS[2] - RS[3]) - b * RS[0] + F_r)
    dRS[1] = RS[0]
    dRS[2] = beta / V_f * (Q_R + Q_RV - Q - A_R * RS[0])
    dRS[3] = k_0 / V_g**2 * A_R * RS[0]
    return dRS


def initial_state() -> Array:
    """Table 5, with its arrays' ten columns extended to the twelve actuators."""
    state = np.zeros(N_STATES)
    state[1] = 300e3
    state[26:50] = 3e5
    state[50:54] = [0.0, 0.04, 3e5, 3e5]
    return state


def right_hand_side(state: Array, V: Array | float, I: Array, F_L: Array, given: Constants) -> Array:
    """Return the 54 rates of the state (of each column of it), as figure 6-1 joins the listings.

    V: motor voltage [V]; I: valve currents [A] (12); F_L: load forces [N] (12), positive against extension.
    """
    N, p_d = state[0], state[1]
    VAS = state[2:50].reshape((4, N_ACTUATORS, *state.shape[1:]))
    RS = state[50:54]
    D, c_L, J_tot = pump_scaling(given.Q_req, given.N_0)
    delta_p = p_d - RS[2]
    _, N_dot = motor(np.asarray(V), delta_p, N, c_L, J_tot)
    Q = pump(N, delta_p, D)
    Q_RV = relief_valve(p_d, given.p_c, given.rho)
    p_s = p_d - Q * given.R_hf  # 6.1
    Q_A, Q_B, Q_S, Q_R = valve_array(p_s, VAS[2], VAS[3], RS[2], given.rho, I, given.K_V)
    rates = np.empty_like(state)
    rates[0] = N_dot
    rates[1] = manifold(Q, Q_RV, Q_S, given.beta)
    rates[2:50] = actuator_array(VAS, Q_A, Q_B, F_L, given.beta).reshape(state[2:50].shape)
    rates[50:54] = reservoir(RS, Q, Q_RV, Q_R, given.beta)
    return rates
