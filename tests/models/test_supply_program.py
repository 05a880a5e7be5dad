"""The program of the pump's predictive control, against balances and an integrator."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from arthur_acausal.models.arthur.supply_program import Design, Plant, SupplyProgram, discrete_model

FloatArray = NDArray[np.float64]

PLANT = Plant(
    K_T=0.078,
    K_e=0.0637,
    R_LL=0.165,
    I_max=50.0,
    k_P=1.2247,
    b=1.007e-3,
    J=3.17e-4,
    c_L=1.77e-7,
    R_G=1e12,
    delivery=1.754e-7,
    p_relief=140e5,
    V_oc=44.4,
    R_i=0.03,
    C=3.8e-13,
)
DESIGN = Design(steps=30, h=0.01, w_max=550.0, undershoot=2e-9, smoothness=0.0)
DEAR = Design(steps=30, h=0.01, w_max=550.0, undershoot=2e-7, smoothness=0.0)
BOUND = np.full(30, 130e5)


def balance(q: float, p: float) -> tuple[float, float]:
    """Speed and voltage at which the pump gives q at p: its flow, and its torque."""
    w = (q + p / PLANT.R_G) / PLANT.delivery
    return w, PLANT.K_e * w + PLANT.R_LL * (PLANT.c_L * p + PLANT.b * w) / PLANT.K_T


def test_the_model_is_that_of_the_plant() -> None:
    """A step with a voltage that is held and a flow that is drawn, by SciPy."""
    V, q, start = 35.0, 4e-5, np.array([300.0, 130.0])

    def rates(t: float, x: FloatArray) -> list[float]:
        w, p = x[0], 1e5 * x[1]
        torque = PLANT.K_T * (V - PLANT.K_e * w) / PLANT.R_LL - PLANT.b * w - PLANT.c_L * p
        flow = PLANT.delivery * w - p / PLANT.R_G - q
        return [torque / PLANT.J, flow / PLANT.C / 1e5]

    there = solve_ivp(rates, (0.0, 0.01), start, rtol=1e-10, atol=1e-10).y[:, -1]
    A, b_V, b_q = discrete_model(PLANT, 0.01)
    assert A @ start + b_V * V + b_q * q * 1e6 == pytest.approx(there, rel=1e-6)


def test_a_steady_flow_is_given_at_the_bound() -> None:
    """Pressure costs leakage and throttling: it is kept where it must be, up to what its price is worth."""
    q, p = 3e-5, 130e5
    w, V = balance(q, p)
    volts, (speed, pressure) = SupplyProgram(PLANT, DESIGN).solve(w, p, V, np.full(30, q), BOUND)
    assert volts[:20] == pytest.approx(np.full(20, V), rel=0.02)
    assert speed[:20] == pytest.approx(np.full(20, w), rel=0.02)
    assert pressure[:20] == pytest.approx(np.full(20, p), rel=0.005)
    _, (_, kept) = SupplyProgram(PLANT, DEAR).solve(w, p, V, np.full(30, q), BOUND)
    assert np.abs(kept[:20] - p).max() < 0.02e5 < np.abs(pressure[:20] - p).max()


def test_it_acts_before_a_peak_that_it_foresees() -> None:
    """A peak that the motor cannot follow is met from the accumulator, charged before; limits are kept."""
    flow = np.full(30, 1e-5)
    flow[15:18] = 7e-5
    w, V = balance(1e-5, 130e5)
    program = SupplyProgram(PLANT, DEAR)
    volts, (speed, pressure) = program.solve(w, 130e5, V, flow, BOUND)
    blind, _ = program.solve(w, 130e5, V, np.full(30, 1e-5), BOUND)
    assert pressure[14] > 135e5
    assert speed[14] > 1.5 * speed[5]
    assert blind[14] == pytest.approx(V, rel=0.02)
    current = (volts - PLANT.K_e * np.concatenate([[w], speed[:-1]])) / PLANT.R_LL
    assert current.min() > -1e-3
    assert current.max() < 50.0 + 1e-3
    assert (volts + PLANT.R_i * PLANT.k_P * current).max() < PLANT.V_oc + 1e-4
    assert pressure.max() < 140e5 * (1 + 1e-6)
    assert pressure.min() > 128e5


def test_too_much_pressure_leaves_over_the_relief_valve() -> None:
    """A supply full to the brim, a pump that cannot stop at once: the program stays feasible."""
    w, V = balance(8e-5, 140e5)
    volts, (speed, pressure) = SupplyProgram(PLANT, DESIGN).solve(w, 140e5, V, np.zeros(30), BOUND)
    assert pressure[0] == pytest.approx(140e5, rel=1e-6)
    assert volts[0] == pytest.approx(PLANT.K_e * w)  # no current
    assert speed[0] < 0.9 * w


def effort(volts: FloatArray, w: float, p: float, flow: FloatArray, bound: float) -> float:
    """Electrical energy less what is stored at the end, and the price of undershoot: by small steps of the plant."""
    fine = 20
    h = DESIGN.h / fine
    A, b_V, b_q = discrete_model(PLANT, h)
    energy, price = 0.0, 0.0
    x = np.array([w, p / 1e5])
    stored = PLANT.J * w**2 / 2 + PLANT.C * p**2 / 2
    for V, q in zip(volts, flow, strict=True):
        for _ in range(fine):
            before = x
            x = A @ x + b_V * V + b_q * q * 1e6
            middle = (before[0] + x[0]) / 2
            energy += PLANT.k_P * V * (V - PLANT.K_e * middle) / PLANT.R_LL * h
        price += DESIGN.undershoot * max(bound - 1e5 * x[1], 0.0) ** 2 * DESIGN.h
    gained = PLANT.J * x[0] ** 2 / 2 + PLANT.C * (1e5 * x[1]) ** 2 / 2 - stored
    return float(energy - gained + price)


def test_no_other_voltages_take_less_energy() -> None:
    """Whatever is changed about them: what the motor takes in, less what is stored, grows, or the pressure falls."""
    random = np.random.default_rng(4)
    flow = 3e-5 + 1e-5 * np.sin(np.linspace(0.0, 6.0, 30))
    w, V = balance(3e-5, 130e5)
    volts, (_, pressure) = SupplyProgram(PLANT, DESIGN).solve(w, 130e5, V, flow, BOUND)
    assert pressure.max() < 139e5  # nothing goes over the relief valve
    least = effort(volts, w, 130e5, flow, 130e5)
    for size in (0.5, 2.0):
        for _ in range(10):
            smooth = np.convolve(random.normal(size=34), np.ones(5) / 5, mode="valid")
            assert effort(volts + size * smooth, w, 130e5, flow, 130e5) > least
