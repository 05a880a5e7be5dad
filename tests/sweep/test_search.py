"""Calibration finds the parameters that made the data; optimisation finds known optima within limits."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import arthur_acausal.sweep
from arthur_acausal.errors import SimulationError, UsageError
from arthur_acausal.sweep.carry_out import How
from arthur_acausal.sweep.fit import fit
from arthur_acausal.sweep.optimize import optimize
from tests.sweep.test_carry_out import plan

HOW = How(workers=1)


@pytest.fixture
def measured(tmp_path: Path) -> Path:
    """x = 1.5 exp(-t / 0.7) with noise of 0.001."""
    t = np.linspace(0.0, 1.0, 41)
    x = 1.5 * np.exp(-t / 0.7) + 1e-3 * np.random.default_rng(1).standard_normal(t.size)
    file = tmp_path / "m.csv"
    file.write_text("time,height\n" + "".join(f"{a},{b}\n" for a, b in zip(t, x, strict=True)))
    return file


def test_parameters_are_found_within_their_errors(tmp_path: Path, measured: Path) -> None:
    found = fit(
        plan("Decay", vary={"tau": "100ms:5000ms", "x0": "0:10"}),
        measured,
        {"x": "height"},
        tmp_path / "d",
        HOW,
    )
    assert found.success
    for p, (path, value) in zip(found.parameters, (("tau", 0.7), ("x0", 1.5)), strict=True):
        assert p.path == path
        assert 1e-5 < p.error < 5e-3
        assert abs(p.value - value) < 4 * p.error
        assert not p.at_bound
    assert found.rms["x"] == pytest.approx(1e-3, rel=0.3)
    assert json.loads((tmp_path / "d" / "fit.json").read_text())["evaluations"] == found.evaluations
    assert len(arthur_acausal.sweep.open(tmp_path / "d").table) == found.evaluations


def test_a_bound_is_told(tmp_path: Path, measured: Path) -> None:
    found = fit(
        plan("Decay", vary={"tau": "1:2"}, set={"x0": 1.5}), measured, {"x": "height"}, tmp_path / "d", HOW
    )
    assert found.parameters[0].value == pytest.approx(1.0, abs=1e-3)
    assert found.parameters[0].at_bound


def test_mistakes_are_told(tmp_path: Path, measured: Path) -> None:
    with pytest.raises(UsageError, match="tau is no range"):
        fit(plan("Decay", vary={"tau": "1,2"}), measured, {"x": "height"}, tmp_path / "a", HOW)
    with pytest.raises(UsageError, match="reaches to 1 s, and the run ends at"):
        fit(plan("Decay", vary={"tau": "1:2"}, stop_time=0.5), measured, {"x": "height"}, tmp_path / "b", HOW)
    with pytest.raises(SimulationError, match="the run at T = "):
        fit(plan("Explosion", vary={"T": "0.1:0.2"}), measured, {"x": "height"}, tmp_path / "c", HOW)
    with pytest.raises(UsageError, match="'max' is no limit"):
        optimize(plan("Decay", vary={"tau": "1:2"}), "final(x)", tmp_path / "d", HOW, limits=["max"])


def search(folder: Path, model: str = "Decay", **given: Any) -> Any:
    arguments: dict[str, Any] = {"population": 6, "generations": 12, **given}
    ranges = arguments.pop("vary", {"tau": "0.2:3"})
    return optimize(plan(model, vary=ranges), arguments.pop("objective"), folder, HOW, **arguments)


def test_the_least_and_the_greatest(tmp_path: Path) -> None:
    least = search(tmp_path / "a", objective="final(x)")
    assert math.exp(-1 / 0.2) - 1e-6 < least.objective < math.exp(-1 / 0.25)
    greatest = search(tmp_path / "b", objective="final(x)", maximize=True)
    assert greatest.parameters["tau"] == pytest.approx(3.0, abs=0.05)
    assert greatest.objective == pytest.approx(math.exp(-1 / greatest.parameters["tau"]), rel=1e-4)


def test_a_limit_holds(tmp_path: Path) -> None:
    found = search(tmp_path / "a", objective="final(x)", maximize=True, limits=["mean(x) < 0.5"])
    assert found.limits["mean(x)"] <= 0.5
    # mean(x) = tau (1 - exp(-1 / tau)) is 0.5 at tau = 0.6275
    assert found.parameters["tau"] == pytest.approx(0.6275, abs=0.01)


def test_failing_runs_are_the_worst_and_counted(tmp_path: Path) -> None:
    found = search(tmp_path / "a", "Explosion", vary={"T": "0.5:3"}, objective="final(x)", maximize=True)
    assert found.failed > 0
    assert found.parameters["T"] > 1.0  # below, x becomes infinite within the run


def test_a_run_that_ends_before_the_measurements_cannot_be_compared(tmp_path: Path, measured: Path) -> None:
    with pytest.raises(SimulationError, match="cannot be compared") as caught:
        fit(plan("Ending", vary={"T": "0.2:0.4"}), measured, {"x": "height"}, tmp_path / "d", HOW)
    assert "enough" in str(caught.value)


def test_a_limit_without_a_value_is_not_met(tmp_path: Path) -> None:
    with pytest.raises(SimulationError, match="every run failed"):
        search(tmp_path / "a", objective="final(x)", limits=["first(x > 5) < 1"], generations=1)
