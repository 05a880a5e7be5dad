"""The benchmark of the coupled robot keeps its runs, goes on where it was cut off, and counts the worst seed."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from benchmarks import walk
from benchmarks.coupled import Walked
from benchmarks.locomotion import Scenario

GOOD = Walked(
    scenario="",
    seed=0,
    seconds=10.0,
    message="",
    fell=False,
    mean_speed_m_s=0.5,
    speed_error=0.01,
    max_roll_deg=1.0,
    max_pitch_deg=1.0,
    slip_share=0.01,
    v_y=None,
    force_tracking_rms=0.05,
    closure=-1e-6,
    cost_of_transport=20.0,
    trouble={"at_stop": 0, "cavitating": 1},
    cpu_s_per_s=2.0,
    required=True,
    tracked=True,
)


@pytest.fixture
def ran(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, int]]:
    """The runs that were asked for, in place of the simulations."""
    asked = []

    def run(scenario: Scenario, seed: int, rtol: float) -> Walked:
        asked.append((scenario.name, seed))
        return replace(GOOD, scenario=scenario.name, seed=seed)

    monkeypatch.setattr(walk, "run", run)
    return asked


def call(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> None:
    monkeypatch.setattr(sys, "argv", ["walk", *arguments])
    walk.main()


def test_the_first_seed_goes_through_all_scenarios(
    ran: list[Any], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    call(monkeypatch, "--only", "stand", "walk", "--seeds", "2", "--json")
    assert ran == [("stand", 0), ("walk 0.15 m/s", 0), ("stand", 1), ("walk 0.15 m/s", 1)]
    assert [run["met"] for run in json.loads(capsys.readouterr().out)["runs"]] == [True] * 4


def test_a_kept_run_is_not_done_again(
    ran: list[Any], monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log = tmp_path / "runs.jsonl"
    call(monkeypatch, "--only", "stand", "--log", str(log))
    with log.open("a") as file:
        file.write('\n{"key": ["stand", 10')  # cut off
    ran.clear()
    for _ in range(2):
        call(monkeypatch, "--only", "stand", "pace", "--log", str(log))
    assert ran == [("pace 0.3 m/s", 0)]
    assert "1 of 1" in capsys.readouterr().out
    ran.clear()
    call(monkeypatch, "--only", "stand", "--seconds", "2", "--log", str(log))  # another run
    assert ran == [("stand", 0)]


def test_the_worst_seed_counts() -> None:
    bad = replace(GOOD, fell=True, slip_share=0.2, trouble={"at_stop": 2, "cavitating": 0})
    lost = replace(GOOD, message="the solver gave up", seconds=0.0, trouble={})
    loose = replace(GOOD, force_tracking_rms=0.2)
    found = walk.worst([GOOD, bad, lost, loose])
    assert (found["runs"], found["met"], found["falls"], found["seconds"]) == (4, 1, 1, 0.0)
    assert found["slip_share"] == 0.2 and found["v_y"] is None
    assert found["trouble"] == {"at_stop": 2, "cavitating": 1}
    assert replace(loose, tracked=False).met
