"""The quadratic program of the pump's predictive control: voltages over the horizon that lose the least energy.

States: the motor's speed w and the supply's pressure p. Unknowns: the voltage V of each step, constant in it, and the
flow r over the relief valve. With the supply's capacitance C taken at the present pressure all is linear:

    J w' = K_T (V - K_e w)/R_LL - b w - c_L p
    C p' = delivery w - p/R_G - q - r

with q the flow that is foreseen. What the motor takes in is, by the balance of energy, what is stored and what is
lost, and the losses are a convex function of w, p, V and r:

    k_P R_LL I^2 + b w^2 + p^2/R_G + p_relief r + p q

(windings, friction, leakage, relief valve, and what the consumer draws at a pressure that it may not need). What is
stored in rotor and accumulator counts in full at the end of the horizon, so that it is no loss. So the least losses
are the least electrical energy for the motion that is planned.

Limits: 0 <= I <= I_max and V <= V_bus, where V_bus = V_oc - R_i k_P I at the limit; w <= w_max, which may be broken;
p <= p_relief, as r takes what is too much; and p >= p_min, which may be broken at a price.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import SimulationError

FloatArray = NDArray[np.float64]

BAR, CC = 1e5, 1e-6
"""Units of pressure [Pa] and flow [m^3/s] within the program."""
OVERRIDE = 5.5e8
"""Slope of the relief valve's pressure over its flow [Pa s/m^3]: 35 kPa a gpm, report, section 5.4."""
SOFT = 8
"""DAQP's mark of a constraint that may be broken."""


@dataclass(frozen=True, slots=True)
class Plant:
    """What the program knows of the supply, see SupplyModel; ``delivery`` [m^3], capacitance ``C`` [m^3/Pa]."""

    K_T: float
    K_e: float
    R_LL: float
    I_max: float
    k_P: float
    b: float
    J: float
    c_L: float
    R_G: float
    delivery: float
    p_relief: float
    V_oc: float
    R_i: float
    C: float


@dataclass(frozen=True, slots=True)
class Design:
    """What the program is tuned by.

    Attributes
    ----------
    steps, h : of the horizon [1], [s]. w_max : greatest speed [rad/s].
    undershoot : price of a pressure below its bound [W/Pa^2]. smoothness : of changes of the voltage [W/V^2].
    """

    steps: int
    h: float
    w_max: float
    undershoot: float
    smoothness: float


class SupplyProgram:
    """The program of a plant and a design; pressures in bar and flows in cm^3/s keep it well scaled.

    Unknowns: the voltages, the flows over the relief valve and the pressure's undershoots, one each a step.
    """

    def __init__(self, plant: Plant, design: Design) -> None:
        self.plant, self.design = plant, design
        n, h = design.steps, design.h
        self._A_d, self._b_V, self._b_q = discrete_model(plant, h)
        # Rows w, p at the steps' ends over the present state, the voltages and the flows.
        self._free, by_V, by_q = predictions(self._A_d, self._b_V, self._b_q, n)
        nothing, one = np.zeros((n, n)), np.eye(n)
        self._by_z = np.concatenate([by_V, by_q, np.zeros((2, n, n))], axis=2)
        self._by_q = by_q
        shift = np.eye(n, k=-1)
        speed = shift @ self._by_z[0]  # at the steps' beginnings, without the present one
        volts = np.concatenate([one, nothing, nothing], axis=1)
        self._begin = (volts - plant.K_e * speed) / plant.R_LL
        self._end = (volts - plant.K_e * self._by_z[0]) / plant.R_LL
        self._shift = shift
        self._H = self._hessian(volts)
        bus = volts + plant.R_i * plant.k_P * self._begin
        low = self._by_z[1] + np.concatenate([nothing, nothing, one], axis=1)
        self._A = np.concatenate([self._begin, bus, low, self._by_z[1], self._by_z[0]])
        self._sense = np.zeros(3 * n + len(self._A), dtype=np.int32)
        self._sense[-n:] = SOFT

    def _hessian(self, volts: FloatArray) -> FloatArray:
        n, p, d = self.design.steps, self.plant, self.design
        w, pressure = self._by_z
        first, last = self._begin, self._end
        copper = first.T @ first + last.T @ last + (first.T @ last + last.T @ first) / 2
        change = volts - self._shift @ volts
        H = p.k_P * p.R_LL / 3 * copper + p.b * w.T @ w + BAR**2 / p.R_G * pressure.T @ pressure
        H += d.smoothness * change.T @ change
        diagonal = np.concatenate(
            [np.zeros(n), np.full(n, OVERRIDE * CC**2), np.full(n, BAR**2 * d.undershoot)]
        )
        return np.asarray(2 * d.h * (H + np.diag(diagonal)))

    def solve(
        self, w: float, p: float, V_before: float, flow: FloatArray, p_min: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the voltages [V] (steps,), and speed [rad/s] and pressure [Pa] at the steps' ends (2, steps).

        Parameters
        ----------
        w, p : present speed [rad/s] and pressure [Pa]. V_before : voltage of the step before [V].
        flow : that will be drawn, mean of each step [m^3/s]. p_min : bound at the steps' ends [Pa].
        """
        import daqp

        state, q = np.array([w, p / BAR]), flow / CC
        base = self._free @ state + self._by_q @ q
        g, lower, upper = self._terms(state, base, V_before, q, p_min / BAR)
        result: Any = daqp.solve(self._H, g, self._A, upper, lower, self._sense)
        z, _, flag, _ = result
        if flag not in (1, 2):  # 2: a soft constraint is broken
            raise SimulationError(
                f"the program of the pump's predictive control was not solved: DAQP ends with {flag}",
                cause=f"speed {w:.4g} rad/s, pressure {p / BAR:.4g} bar",
                remedy="check its parameters: prices must be positive, a period of a few milliseconds",
            )
        ahead = base + self._by_z @ np.asarray(z)
        return np.asarray(z)[: self.design.steps], ahead * np.array([[1.0], [BAR]])

    def _terms(
        self, state: FloatArray, base: FloatArray, V_before: float, q: FloatArray, p_min: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the gradient and the bounds for a state, and for what comes without any voltage, ``base``."""
        n, p, d = self.design.steps, self.plant, self.design
        w_base, p_base = base
        w_begin = np.concatenate([[state[0]], w_base[:-1]])
        first, last = (-p.K_e / p.R_LL * w for w in (w_begin, w_base))
        g = p.k_P * p.R_LL / 3 * (self._begin.T @ (2 * first + last) + self._end.T @ (2 * last + first))
        g += self._by_z[0].T @ (2 * p.b * w_base)
        g += self._by_z[1].T @ (2 * BAR**2 / p.R_G * p_base + BAR * CC * q)
        g[0] -= 2 * d.smoothness * V_before
        g[n : 2 * n] += p.p_relief * CC
        free = np.full(n, np.inf)
        bus = p.V_oc - p.R_i * p.k_P * first
        lower = [-free, np.zeros(2 * n), -first, -free, p_min - p_base, -free, -free]
        highest = p.p_relief / BAR - p_base
        upper = [free, free, free, p.I_max - first, bus, free, highest, d.w_max - w_base]
        return d.h * g, np.concatenate(lower), np.concatenate(upper)


@lru_cache(maxsize=256)
def program(plant: Plant, design: Design) -> SupplyProgram:
    """Return the program of a plant and a design, made once."""
    return SupplyProgram(plant, design)


def discrete_model(plant: Plant, h: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return A, b_V, b_q of x+ = A x + b_V V + b_q q over ``h`` [s], exactly; x = (w, p), q what is drawn."""
    from scipy.linalg import expm

    p = plant
    field = np.zeros((4, 4))
    field[0, 0] = -(p.K_T * p.K_e / p.R_LL + p.b) / p.J
    field[0, 1] = -p.c_L * BAR / p.J
    field[0, 2] = p.K_T / (p.R_LL * p.J)
    field[1, 0] = p.delivery / (p.C * BAR)
    field[1, 1] = -1 / (p.R_G * p.C)
    field[1, 3] = -CC / (p.C * BAR)
    moved: FloatArray = np.asarray(expm(field * h), dtype=float)
    return moved[:2, :2], moved[:2, 2], moved[:2, 3]


def predictions(
    A: FloatArray, b_V: FloatArray, b_q: FloatArray, n: int
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the states at the ends of n steps over the first one (2, n, 2), over V (2, n, n), over q (2, n, n)."""
    powers = [np.eye(2)]
    for _ in range(n):
        powers.append(A @ powers[-1])
    free = np.array(powers[1:]).transpose(1, 0, 2)
    late = np.subtract.outer(np.arange(n), np.arange(n))
    both = []
    for b in (b_V, b_q):
        response = np.array([power @ b for power in powers[:n]]).T
        both.append(np.where(late >= 0, response[:, np.maximum(late, 0)], 0.0))
    return free, both[0], both[1]
