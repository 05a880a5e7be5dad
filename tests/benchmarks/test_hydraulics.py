"""Hydraulic cases of the conformance benchmark, with other numbers than the published ones."""

from __future__ import annotations

import json
from collections.abc import Mapping
from math import log, pi, sqrt
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmarks.conformance import run
from benchmarks.hydraulics import SOLVERS

DIVIDER = {"A1": 1e-6, "A2": 3e-6, "p1": 90e5, "p2": 10e5, "Cd": 0.6, "rho": 900.0}
P_MID = (1e-12 * 90e5 + 9e-12 * 10e5) / 10e-12
BLOWDOWN = {"Cd": 0.6, "A": 2e-6, "rho": 850.0, "V": 2e-3, "beta": 1e9, "p0": 50e5}
TRAPPED = {"beta": 1e9, "V0": 2e-3, "p0": 2e5}
GAS = {"n": 1.3, "V0": 2e-3, "p_precharge": 30e5}
CYLINDER = {"beta": 1e9, "A1": 2e-3, "A2": 1e-3, "V1": 3e-4, "V2": 4e-4, "m": 20.0, "x0": 1e-5}
STIFFNESS = 1e9 * (2e-3**2 / 3e-4 + 1e-3**2 / 4e-4)
LINE = {"L": 30.0, "a": 1000.0, "rho": 900.0, "v0": 0.5, "p0": 20e5}

CASES: dict[str, tuple[Mapping[str, float], Mapping[str, Any], float]] = {
    "hyd_orifice_divider": (
        DIVIDER,
        {"p_mid": P_MID, "q": 0.6 * 1e-6 * sqrt(2 * (90e5 - P_MID) / 900.0)},
        1e-5,
    ),
    "hyd_orifice_blowdown": (
        BLOWDOWN,
        {"t_empty": 2 * 2e-3 / 1e9 * sqrt(50e5) / (0.6 * 2e-6 * sqrt(2 / 850.0)), "p_at_half": 12.5e5},
        1e-4,
    ),
    "hyd_trapped_volume": (TRAPPED, {"values": {"V=1.9e-3": 2e5 + 1e9 * log(2 / 1.9)}}, 1e-7),
    "hyd_accumulator_polytropic": (
        GAS,
        {
            "isothermal_p": {"dV=0.001": 60e5},
            "polytropic_p": {"dV=0.001": 30e5 * 2**1.3},
            "stored_work_isothermal_J": {"dV=0.001": 6000.0 * log(2)},
        },
        1e-6,
    ),
    "hyd_cylinder_natural_frequency": (CYLINDER, {"omega": sqrt(STIFFNESS / 20.0)}, 1e-4),
    "hyd_water_hammer": (LINE, {"dp": 900.0 * 1000.0 * 0.5, "period": 4 * 30.0 / 1000.0}, 1e-3),
}


@pytest.mark.parametrize("name", CASES)
def test_a_case_with_other_numbers_meets_its_closed_form(name: str) -> None:
    given, reference, required = CASES[name]
    error, _ = SOLVERS[name]({"name": name, "parameters": given, "reference": reference}, Path())
    assert error <= required


def test_a_wrong_reference_is_an_error() -> None:
    name = "hyd_cylinder_natural_frequency"
    error, _ = SOLVERS[name]({"parameters": CYLINDER, "reference": {"omega": 2 * pi * 100}}, Path())
    assert error > 0.01


@pytest.mark.parametrize(("error", "passes"), [(0.0, True), (0.02, False)])
def test_a_model_of_hopsan_is_scored_in_the_tube_of_its_case(
    tmp_path: Path, error: float, passes: bool
) -> None:
    """A volume that fills through a laminar orifice: p = p_s (1 - exp(-t Kc beta/V)), as one line a signal."""
    part = {"supply": ("HydraulicPressureSourceC", {"p#Value": "1e7"})}
    part["orifice"] = ("HydraulicLaminarOrifice", {"Kc#Value": "1e-12"})
    part["volume"] = ("HydraulicVolumeMultiPort", {"V#Value": "1e-4", "P1#Pressure": "0"})
    part["gauge"] = ("HydraulicPressureSensor", {"P1#Pressure": "0"})
    case = {
        "name": "hopsan_Filling",
        "simulation": {"start": "0", "stop": "0.5", "timestep": "0.001"},
        "components": [
            {"name": name, "type": kind, "parameters": {k: {"value": v} for k, v in values.items()}}
            for name, (kind, values) in part.items()
        ],
        "connections": [["supply.P1", "orifice.P1"], ["orifice.P2", "volume.P1"], ["gauge.P1", "volume.P1"]],
        "reference": {
            "file": "reference.csv",
            "signals": [{"name": "gauge#out#Value", "timecolumn": 0, "column": 1}],
        },
        "required": {"measure": "a tube of 1e-2 of the range and 5e-3 of the time span", "value": 0.0},
    }
    t = np.linspace(0.0, 0.5, 200)
    p = 1e7 * (1 - np.exp(-t * 1e-12 * 1e9 / 1e-4)) + error * 1e7 * np.sin(100 * t)
    (tmp_path / "case.json").write_text(json.dumps(case))
    np.savetxt(tmp_path / "reference.csv", np.array([t, p]), delimiter=",")
    outcome = run(tmp_path)
    assert outcome.passed == passes
    assert outcome.error is not None and (outcome.error > 0.1) != passes
