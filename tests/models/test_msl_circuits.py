"""Circuits of the Modelica Standard Library against closed forms and an independent integration by SciPy."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from arthur_acausal import Solution, SolverOptions, simulate
from arthur_acausal.models.conformance import msl_circuits as circuits
from arthur_acausal.models.conformance import msl_resonance
from arthur_acausal.models.conformance.case import Case

CASES = circuits.CASES | msl_resonance.CASES
Floats = NDArray[np.float64]
PRECISE = SolverOptions(rtol=1e-8, intervals=1000)


def run(name: str, stop_time: float) -> Solution:
    return simulate(CASES[f"msl_Electrical_Analog_{name}"].model(), stop_time=stop_time, options=PRECISE)


def chua(t: float, x: Floats) -> list[float]:
    v1, v2, i = x
    diode = -0.409091 * v1 + (-0.757576 + 0.409091) * np.clip(v1, -1.0, 1.0)
    through = 0.565 * (v2 - v1)
    return [(through - diode) / 10.0, (-through - i) / 100.0, (v2 - 12.5e-3 * i) / 18.0]


def series(t: float, x: Floats) -> list[float]:
    i, v = x
    return [(np.sin(200 * np.pi * t**2) - v - 0.5 * i) / (0.1 / 2 / np.pi), i / (1e-3 / 2 / np.pi)]


def parallel(t: float, x: Floats) -> list[float]:
    i, v = x
    return [(v - 0.5 * i) / (0.1 / 2 / np.pi), (np.sin(200 * np.pi * t**2) - i) / (1e-3 / 2 / np.pi)]


def transformer(t: float, x: Floats) -> Floats:
    """Of the coupled coils, 20 % leakage left out: i1 into port 1, i2 into port 2."""
    leak = 0.05 / (20 * np.pi)
    L = np.array([[leak + 200 * leak, 100 * leak], [100 * leak, leak / 4 + 50 * leak]])
    v = np.array([0.1 + 0.1 * np.sin(20 * np.pi * t + np.pi / 2), 0.0])
    return np.asarray(np.linalg.solve(L, v - np.array([0.01, 0.2525]) * x), dtype=np.float64)


REFERENCES: dict[str, tuple[Callable[[float, Floats], object], list[float], list[str], float]] = {
    "ChuaCircuit": (chua, [4.0, 0.0, 0.0], ["C1.v", "C2.v", "L.i"], 500.0),
    "SeriesResonance": (series, [0.0, 0.0], ["inductor1.i", "capacitor1.v"], 0.3),
    "ParallelResonance": (parallel, [0.0, 0.0], ["inductor1.i", "capacitor1.v"], 0.3),
    "CompareTransformers": (transformer, [0.0, 0.0], ["basicTransformer.i1", "basicTransformer.i2"], 0.5),
}


@pytest.mark.parametrize("name", REFERENCES)
def test_a_circuit_agrees_with_an_independent_integration(name: str) -> None:
    law, start, paths, stop_time = REFERENCES[name]
    solution = run(name, stop_time)
    reference = solve_ivp(law, (0.0, stop_time), start, method="DOP853", rtol=1e-11, atol=1e-13)
    for path, value in zip(paths, reference.y[:, -1], strict=True):
        assert solution.final(path) == pytest.approx(value, abs=1e-6 * np.ptp(solution[path])), path


def test_the_leakage_transformer_passes_its_load_by_the_turns_ratio() -> None:
    solution = run("CompareTransformers", 0.5)
    assert solution["idealTransformer.i2"] == pytest.approx(-2 * solution["idealTransformer.i1"], abs=1e-12)


def test_a_resistor_heats_itself_to_the_root_of_a_quadratic() -> None:
    """P 100 (1 + 1e-3 P/50) = v^2."""
    solution = run("Resistor", 1.0)
    v = 220 * np.sin(2 * np.pi * solution.t)
    P = (np.sqrt(1 + 4 * 2e-5 * v**2 / 100) - 1) / (2 * 2e-5)
    assert solution["resistor.P_loss"] == pytest.approx(P, abs=1e-6)


def test_a_variable_resistor_divides_the_voltage() -> None:
    solution = run("ShowVariableResistor", 1.0)
    R, v = 2 + 2.5 * solution.t, -np.sin(2 * np.pi * solution.t)
    assert solution["VariableResistor.v"] == pytest.approx(v * R / (R + 2), abs=1e-9)


@pytest.mark.parametrize("name", ["SwitchWithArc", "ControlledSwitchWithArc"])
def test_an_arc_brings_a_current_down_until_it_is_quenched(name: str) -> None:
    """i' = (50 - i - v)/0.1; v = 0, then 30 + 1e4 t' up to 60, t' from the opening on."""
    on, off = (0.0, 0.5) if name == "SwitchWithArc" else (1 / 12, 5 / 12)
    solution = run(name, 1.0)
    i_0 = 50 * (1 - np.exp(-10 * (off - on)))
    assert solution.at(off - 1e-6, "inductor2.i") == pytest.approx(i_0, abs=1e-2)
    t_max = 3e-3  # particular solution of the ramp: 20 - 1e4 (t' - 0.1)
    i_max = 20 - 1e4 * (t_max - 0.1) + (i_0 - 20 - 1e3) * np.exp(-10 * t_max)
    assert solution.at(off + t_max, "inductor2.i") == pytest.approx(i_max, abs=1e-2)
    t_quenched = off + t_max + 0.1 * np.log((i_max + 10) / (10 + 6e-4))
    after = -10 + (i_max + 10) * np.exp(-10 * 0.05)
    assert solution.at(off + t_max + 0.05, "inductor2.i") == pytest.approx(after, abs=1e-2)
    quenched = solution["switch2.quenched"]
    assert solution.t[(quenched > 0.5) & (solution.t > off)][0] == pytest.approx(t_quenched, abs=1e-4)
    assert solution.at(off + 0.01, "inductor1.i") == pytest.approx(50e-5, abs=1e-5)


def test_a_saturating_inductor_has_the_flux_of_the_voltage() -> None:
    solution = run("ShowSaturatingInductor", 6.2832)
    flux = 1.25 * np.sin(solution.t)
    assert solution["SaturatingInductance1.psi"] == pytest.approx(flux, abs=1e-6)
    at_nominal = np.interp(
        1.0, *np.sort([solution[f"SaturatingInductance1.{q}"][:200] for q in ("i", "psi")])
    )
    assert at_nominal == pytest.approx(1.0, abs=1e-3)  # L_nom I_nom


def test_zener_diodes_limit_a_voltage_both_ways() -> None:
    """Breakdown at about 5.1 V, and one forward drop."""
    solution = run("OvervoltageProtection", 0.4)
    v = solution["RL.v"]
    assert 5.1 < v.max() < 5.8
    assert v.max() == pytest.approx(-v.min(), rel=1e-4)
    blocked = np.abs(solution["sineVoltage.v"]) < 4.0
    assert v[blocked] == pytest.approx(solution["sineVoltage.v"][blocked] * 2000 / 2020, abs=2e-2)


def test_a_triac_conducts_both_ways_from_firing_to_the_end_of_the_current() -> None:
    """While it conducts the load has the source's voltage less the knee of 0.8 V."""
    solution = run("IdealTriacCircuit", 2.0)
    v, load = solution["V.v"], solution["R.v"]
    for thyristor, sign in (("idealThyristor", 1), ("idealThyristor1", -1)):
        on = (solution[f"idealTriac.{thyristor}.blocked"] < 0.5) & (np.abs(v) > 1.0)
        assert on.sum() > 50
        assert load[on] == pytest.approx(v[on] - sign * 0.8, abs=1e-4)


def test_a_rectifier_keeps_its_energy_balance() -> None:
    solution = run("Rectifier", 0.1)
    t, phases = solution.t, range(1, 4)
    given = -sum(solution[f"SineVoltage{k}.v"] * solution[f"SineVoltage{k}.i"] for k in phases)
    spent = solution["Losses"] + 500.0 * solution["uDC"]
    parts = ("Capacitor1", "Capacitor2", *(f"Inductor{k}" for k in phases))
    stored = np.sum([solution[f"{part}.E"] for part in parts], axis=0)
    balance = np.trapezoid(given - spent, t) - (stored[-1] - stored[0])
    assert abs(balance) < 1e-3 * np.trapezoid(spent, t)
    assert sum(solution[f"Inductor{k}.i"] for k in phases) == pytest.approx(0.0, abs=1e-6)
    assert solution["uDC"][t > 0.05].mean() == pytest.approx(400 * np.sqrt(2) * 3 / np.pi, rel=0.06)


def test_a_signal_of_modelica_finds_its_variable() -> None:
    case = Case("any", circuits.ChuaCircuit, {"phi": "sine.phi"}, 1.0)
    known = {"sine.phi", "a.pin_p.v", "b.x_1", "c[0].P_loss", "d.heat_port.T"}
    names = {
        "phi": "sine.phi",
        "a.p.v": "a.pin_p.v",
        "b.x[2]": "b.x_1",
        "c[1].lossPower": "c[0].P_loss",
        "d.heatPort.T": "d.heat_port.T",
        "nothing": None,
    }
    assert {name: case.path(name, known) for name in names} == names
