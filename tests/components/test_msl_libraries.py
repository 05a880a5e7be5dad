"""Electrical, thermal and block examples of the Modelica Standard Library against trajectories of another tool.

msl_libraries.json holds the figures, with their source and licence.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from arthur_acausal import translate
from arthur_acausal.models.conformance import msl_blocks, msl_electrical, msl_thermal

CASES = {**msl_blocks.CASES, **msl_electrical.CASES, **msl_thermal.CASES}
FIGURES: dict[str, Any] = json.loads(Path(__file__).with_name("msl_libraries.json").read_text())
OF_RANGE, OF_SPAN = 1e-3, 2e-3
"""The tube: part of the signal's range, part of the time span."""


@pytest.mark.parametrize("name", FIGURES["cases"])
def test_an_example_stays_in_the_tube(name: str) -> None:
    case, figures = CASES[name], FIGURES["cases"][name]
    solution = translate(case.model()).simulate(case.stop_time, options=case.options)
    half = OF_SPAN * case.stop_time
    for signal, reference in figures["signals"].items():
        values = solution[case.signals[signal]]
        allowed = OF_RANGE * reference["range"]
        for t, value in zip(figures["times"], reference["values"], strict=True):
            near = values[(solution.t >= t - half) & (solution.t <= t + half)]
            assert near.min() - allowed <= value <= near.max() + allowed, (signal, t)
