"""The walking benchmark prints what it promises."""

from __future__ import annotations

import json
import sys

import pytest

from benchmarks import locomotion


def test_it_prints_each_scenario_with_its_figures(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    command = ["locomotion", "--json", "--quick", "--seeds", "1", "--only", "stand", "--lag", "0.003"]
    monkeypatch.setattr(sys, "argv", command)
    locomotion.main()
    (row,) = json.loads(capsys.readouterr().out)["scenarios"]
    assert row["scenario"] == "stand" and row["falls"] == 0 and row["met"]
    assert 0.0 < row["lag_error"] < 0.1  # the torques lag
    assert row["speed_error"] is None and row["v_y"] is None


def test_the_worst_seed_counts() -> None:
    good = locomotion.Figures(False, 0.01, 1.0, 1.0, 0.01, None, 1.0, 1.0, 0.5, 0.9, 0.1, 0.0, 0.1)
    bad = locomotion.Figures(True, 0.2, 2.0, 0.5, 0.02, None, 2.0, 1.0, 0.5, 0.9, 0.1, 0.0, 0.1)
    found = locomotion.worst([good, bad])
    assert found["falls"] == 1 and found["speed_error"] == 0.2 and found["pitch_deg"] == 1.0
    assert locomotion.meets(locomotion.worst([good])) and not locomotion.meets(found)
