"""Mechanical examples of the Modelica Standard Library against trajectories of another tool.

msl_mechanics.json holds the figures, with their source and licence.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from arthur_acausal import translate
from arthur_acausal.models.conformance import msl_mechanics, msl_rotational, msl_translational

FIGURES: dict[str, Any] = json.loads(Path(__file__).with_name("msl_mechanics.json").read_text())
OF_RANGE, OF_SPAN = 1e-3, 2e-3
"""The tube: part of the signal's range, part of the time span."""


@pytest.mark.parametrize("name", FIGURES["cases"])
def test_an_example_stays_in_the_tube(name: str) -> None:
    case, figures = msl_mechanics.CASES[name], FIGURES["cases"][name]
    solution = translate(case.model()).simulate(case.stop_time, options=case.options)
    half = OF_SPAN * case.stop_time
    for signal, reference in figures["signals"].items():
        values = solution[case.signals[signal]]
        allowed = OF_RANGE * reference["range"]
        for t, value in zip(figures["times"], reference["values"], strict=True):
            near = values[(solution.t >= t - half) & (solution.t <= t + half)]
            assert near.min() - allowed <= value <= near.max() + allowed, (signal, t)


# ends of the same references (modelica/MAP-LIB_ReferenceResults, BSD-3-Clause, Modelica Association)
ENDS: dict[str, dict[str, float]] = {
    "Rotational_CoupledClutches": {
        "J1.phi": 7.48609218,
        "J1.w": 3.24703457,
        "clutch1.phi_rel": -3.37894250,
        "clutch1.w_rel": -0.783826964,
        "clutch2.phi_rel": -1.39667287,
        "clutch3.phi_rel": -1.53672566,
        "clutch1.mode": 2.0,
        "clutch2.mode": 0.0,
        "clutch3.mode": 0.0,
    },
    "Rotational_LossyGearDemo1": {"Inertia2.w": -0.0162619240, "gear.mode": -1.0},
    "Rotational_LossyGearDemo2": {
        "Inertia2.phi": -0.000589183323,
        "Inertia2.w": -0.00962427809,
        "gear.mode": -1.0,
        "bearingFriction.mode": -1.0,
    },
    "Rotational_LossyGearDemo3": {"Inertia2.phi": 0.1, "Inertia2.w": 0.0, "gear.mode": 0.0},
    "Rotational_OneWayClutch": {
        "inertiaIn.phi": -0.212330873,
        "inertiaIn.w": -0.249978914,
        "oneWayClutch.phi_rel": 0.485732618,
    },
    "Rotational_OneWayClutchDisengaged": {
        "inertiaIn.phi": -0.312877505,
        "inertiaIn.w": -0.971458399,
        "oneWayClutch.phi_rel": 1.21734964,
        "oneWayClutch.w_rel": 1.44297892,
    },
    "Rotational_ElasticBearing": {
        "load.phi": 148.266382,
        "shaft.w": 114.462801,
        "springDamper.phi_rel": -0.00168389346,
    },
    "Rotational_RollingWheel": {"inertia.phi": 21.0345477, "inertia.w": 4.99944476},
    "Translational_Damper": {
        "damper1.s_rel": 0.6,
        "damper2.s_rel": 0.614473244,
        "springDamper3.v_rel": 0.0154458322,
    },
    "Translational_InitialConditions": {
        "m1.s": 0.504849117,
        "m3.s": 4.5,
        "sd1.s_rel": 0.927549519,
        "sd2.s_rel": 4.0,
    },
    "Translational_PreLoad": {
        "friction.v_rel": 9.42470033e-06,
        "innerContactA.s_rel": 0.000985307077,
        "innerContactB.s_rel": 0.000985281159,
        "outerContactB.s_rel": 0.00148530708,
    },
}


@pytest.mark.parametrize("name", ENDS)
def test_an_example_ends_where_the_reference_ends(name: str) -> None:
    """Within the reference's own tolerance, about 1e-4."""
    case = (msl_rotational.CASES | msl_translational.CASES)[f"msl_Mechanics_{name}"]
    solution = translate(case.model()).simulate(case.stop_time, options=case.options)
    for signal, value in ENDS[name].items():
        path = case.signals[signal]
        allowed = 2e-4 * float(np.ptp(solution[path])) if signal[-4:] != "mode" else 0.0
        assert float(solution.final(path)) == pytest.approx(value, abs=allowed + 1e-12), signal


@pytest.mark.parametrize("name", ["Accelerate", "Brake", "WhyArrows", "Sensors"])
def test_the_small_examples_have_closed_forms(name: str) -> None:
    case = msl_translational.CASES[f"msl_Mechanics_Translational_{name}"]
    solution = translate(case.model()).simulate(case.stop_time, options=case.options)
    ends = {
        "Accelerate": {"accelerate.s": 0.5, "mass.s": 1.0, "mass.v": 1.0},
        "Brake": {"mass1.s": 0.1 + 0.5, "mass2.s": 0.1 + 0.5, "brake.mode": 0.0, "brake1.mode": 0.0},
        "WhyArrows": {p: -0.9 + 0.9 * np.cos(11.0**0.5) for p in ("mass1.s", "inertia2.s")},
        "Sensors": {"mass.s": 10.0 / (8.0 * np.pi), "mass.v": 0.0},
    }
    for path, value in ends[name].items():
        assert float(solution.final(path)) == pytest.approx(value, abs=1e-6), path
