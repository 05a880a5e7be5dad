"""The study of the pump's control: its design, its statistics, and its files from runs with known figures."""

from __future__ import annotations

import csv
import json
from collections.abc import Mapping, Sequence
from math import nan
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from arthur_acausal import UsageError
from arthur_acausal.models.arthur.locomotion.controller import Configuration
from arthur_acausal.models.arthur.locomotion.sensors import N_INPUTS
from arthur_acausal.models.arthur.powertrain_study import write_study
from arthur_acausal.models.arthur.study.comparison import Comparison
from arthur_acausal.models.arthur.study.design import (
    PARTS,
    QUICK,
    Case,
    Size,
    specification,
)
from arthur_acausal.models.arthur.study.measures import LOSSES
from arthur_acausal.models.arthur.study.results import Result
from arthur_acausal.models.arthur.study.schemes import SCHEMES, scheme_named
from arthur_acausal.models.arthur.study.statistics import at_equal, estimate, front, paired, share
from arthur_acausal.models.arthur.study.tasks import TASK, TASKS
from arthur_acausal.models.arthur.study.trial import TrialWalking
from arthur_acausal.models.arthur.walking import Walking
from arthur_acausal.sweep.design import runs
from arthur_acausal.sweep.specification import from_mapping

WITHOUT_RECORDING = [scheme for scheme in SCHEMES if not scheme.knows]


def result(scheme: str, seed: int, set_point: float = 135.0, **values: float) -> Result:
    return Result(scheme_named(scheme), Case(TASK["trot 0.5"], seed, set_point), "terminated", "", values)


def test_the_design_is_far_smaller_than_the_full_factorial() -> None:
    cases = [case for scheme in SCHEMES for part in PARTS.values() for case in part(scheme, Size())]
    assert 500 < len(cases) <= 1500
    quick = [case for scheme in SCHEMES for part in PARTS.values() for case in part(scheme, QUICK)]
    assert len(quick) < len(cases) / 5


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.name)
def test_a_sweep_has_a_row_for_each_case(scheme: Any, tmp_path: Path) -> None:
    cases = PARTS["main"](scheme, QUICK) + PARTS["varied"](scheme, QUICK)
    given = {"model": "arthur_acausal.models.arthur.study.trial:Trial", **specification(scheme, cases)}
    table = runs(from_mapping(given), tmp_path)
    assert [run.values["noise"] for run in table] == [case.seed for case in cases]
    assert [TASKS[int(float(run.values["task"]))] for run in table] == [case.task for case in cases]
    # Seeds pair: the same start whatever the scheme.
    assert len({run.values["body.FL_hip_phi"] for run in table}) == len({case.seed for case in cases})


@pytest.mark.parametrize("size", [QUICK, Size()], ids=["quick", "full"])
def test_no_case_is_run_twice(size: Size) -> None:
    for scheme in SCHEMES:
        cases = [case for part in PARTS.values() for case in part(scheme, size)]
        assert len(set(map(repr, cases))) == len(cases), scheme.name


def test_the_controller_does_the_task_that_its_inputs_name() -> None:
    rng = np.random.default_rng(0)
    sensors = rng.normal(0.0, 0.01, N_INPUTS + 12)
    sensors[3:7] = 1.0, 0.0, 0.0, 0.0
    task = TASK["trot 0.3"]
    plain = Walking(Configuration(commands=task.commands, seed=4))
    trial = TrialWalking.restore(TrialWalking().describe()).fresh()
    for t in (0.0, 0.002, 0.004):
        expected = plain(t, sensors)
        assert np.array_equal(trial(t, np.append(sensors, [TASKS.index(task), 4])), expected)


def test_students_interval() -> None:
    """Of 1..5: mean 3, deviation sqrt(5/2), t(0.975, 4) = 2.7764."""
    found = estimate([1.0, 2.0, 3.0, 4.0, 5.0, nan])
    assert found.mean == pytest.approx(3.0)
    assert found.ci95 == pytest.approx(2.7764 * np.sqrt(2.5 / 5), rel=1e-4)
    assert found.n == 5
    assert estimate([2.0]).ci95 is None
    assert estimate([]).mean is None


def test_no_falls_of_ten_are_not_certainly_none() -> None:
    """Wilson's interval for 0 of 10 ends at z^2/(n + z^2) = 0.2775."""
    found = share([False] * 10)
    assert found.mean == 0.0
    assert found.ci95 == pytest.approx(0.2775, abs=1e-4)


def test_pairing_takes_away_what_the_seeds_share() -> None:
    these = [result("foresight", k, electrical_W=900.0 + 50.0 * k) for k in range(4)]
    those = [result("feed-forward", k, electrical_W=910.0 + 50.0 * k) for k in range(4)]
    found = paired(these, those, "electrical_W")
    assert found.mean == pytest.approx(-10.0)
    assert found.ci95 == pytest.approx(0.0, abs=1e-9)
    assert found.certain
    shuffled = paired(these, those[::-1], "electrical_W")
    assert shuffled.mean == found.mean
    assert paired(these, those[:2], "electrical_W").n == 2


def test_power_at_equal_sag_is_read_off_the_others_curve() -> None:
    """The other takes 1000 W at 1 bar and 900 W at 3 bar: 950 W at 2 bar."""
    curve = [
        result("pressure", 0, 135.0, net_W=1000.0, undershoot_bar_rms=1.0),
        result("pressure", 0, 130.0, net_W=900.0, undershoot_bar_rms=3.0),
    ]
    at_two = result("foresight", 0, net_W=931.0, undershoot_bar_rms=2.0)
    beyond = result("foresight", 0, net_W=931.0, undershoot_bar_rms=4.0)
    found = at_equal([at_two], curve, "undershoot_bar_rms")
    assert found.mean == pytest.approx(931.0 / 950.0 - 1.0)
    assert at_equal([beyond], curve, "undershoot_bar_rms").mean is None


def test_the_front() -> None:
    points = {"a": (1.0, 5.0), "b": (2.0, 2.0), "c": (3.0, 2.0), "d": (5.0, 1.0), "e": (5.0, 5.0)}
    assert front(points) == {"a", "b", "d"}


def test_an_unknown_scheme_is_refused() -> None:
    with pytest.raises(UsageError, match="no scheme 'foreshigt'"):
        scheme_named("foreshigt")


def known_runs(name: str, given: Mapping[str, Any]) -> Mapping[str, Sequence[Any]]:
    """Stand for the sweeps: powers that depend on scheme and seed in a known way; one run falls, one fails."""
    vary, scheme = given["vary"], given["set"]["scheme"]
    n = len(vary["task"])
    order = [s.name for s in SCHEMES].index(scheme)
    base = 2000.0 if scheme == "constant speed" else 1000.0
    fell = [float(scheme == "pressure" and name.endswith("main") and k == n - 1) for k in range(n)]
    failed = [scheme == "feed-forward" and name.endswith("main") and k == n - 1 for k in range(n)]
    gone = [bool(f) or bad for f, bad in zip(fell, failed, strict=True)]
    powers = [base + 10.0 * seed for seed in vary["noise"]]
    columns = {
        "electrical_W": powers,
        "undershoot_bar_rms": [1.0 + order] * n,
        "force_error_rms": [10.0] * n,
        "closure": [1e-6] * n,
    }
    columns |= {f"{part}_W": [0.05 * power for power in powers] for part in (*LOSSES, "work", "stored")}
    columns["relief_W"] = [0.3 * base if base > 1500.0 else 0.0] * n
    table: dict[str, Sequence[Any]] = {
        f"measures.{key}": [nan if none else x for x, none in zip(values, gone, strict=True)]
        for key, values in columns.items()
    }
    status = ["failed" if bad else "terminated" for bad in failed]
    return {
        "run": list(range(n)), "status": status, "error": ["broke" if bad else "" for bad in failed],
        "measures.fell": [nan if bad else f for f, bad in zip(fell, failed, strict=True)], **table,
    }  # fmt: skip


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("study")
    write_study(folder, known_runs, QUICK, WITHOUT_RECORDING)
    return folder


def test_the_summary_gives_means_by_scheme_and_task(folder: Path) -> None:
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    assert list(summary) == [scheme.name for scheme in WITHOUT_RECORDING]
    found = summary["constant speed"]["trot 0.5"]
    assert found["electrical_W"] == {"mean": 2010.0, "ci95": pytest.approx(24.84, abs=0.01), "n": 3}
    assert found["falls"]["mean"] == 0.0


def test_falls_and_failures_are_told_and_in_no_mean(folder: Path) -> None:
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    assert summary["pressure"]["trot 0.5"]["falls"]["mean"] == pytest.approx(1 / 3)
    assert summary["pressure"]["trot 0.5"]["electrical_W"]["n"] == 2
    assert summary["feed-forward"]["trot 0.5"]["failures"] == 1
    told = json.loads((folder / "comparisons.json").read_text(encoding="utf-8"))["fell_or_failed"]
    assert [(row["scheme"], row["status"]) for row in told] == [
        ("pressure", "fell"),
        ("feed-forward", "failed"),
    ]
    with (folder / "runs.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert sum(row["status"] == "failed" for row in rows) == 1
    assert "1 fell, 1 failed" in (folder / "findings.md").read_text(encoding="utf-8")


def test_savings_are_paired_and_judged(folder: Path) -> None:
    """Half of the power is saved, all of the relief loss."""
    told = json.loads((folder / "comparisons.json").read_text(encoding="utf-8"))
    (row,) = (
        row
        for row in told["differences"]
        if (row["scheme"], row["less"], row["task"]) == ("foresight", "constant speed", "stand")
    )
    assert row["electrical_W"] == {"mean": -1000.0, "ci95": pytest.approx(0.0, abs=1e-9), "n": 3}
    text = (folder / "findings.md").read_text(encoding="utf-8")
    assert "| foresight | stand | 100.0% ± 0.0% | 95% to 100% | confirmed | 49.8% ± 0.6%" in text
    assert "foresight, stand: it does not pay" in text  # more sag, no less power


def test_the_points_say_what_nothing_is_better_than(folder: Path) -> None:
    with (folder / "pareto.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    best = {row["scheme"] for row in rows if row["front_undershoot_bar_rms"] == "True"}
    assert best == {"constant speed", "tuned speed", "pressure"}
    assert {file.name for file in folder.glob("*.png")} == {
        "pareto.png",
        "cascade-stand.png",
        "cascade-trot-0.5.png",
    }


def test_the_table_says_how_it_was_made(folder: Path) -> None:
    lines = (folder / "study.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0] == "# arthur study powertrain --seeds 3 --few 2; seeds from 0; rtol 0.001"
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    (row,) = (
        row
        for row in rows
        if (row["scheme"], row["task"], row["measure"]) == ("constant speed", "stand", "electrical_W")
    )
    assert (float(row["mean"]), row["n"]) == (2010.0, "3")


def test_a_scheme_without_runs_at_a_task_has_no_estimate() -> None:
    comparison = Comparison([result("foresight", 0, electrical_W=900.0)])
    assert comparison.mean("pressure", "trot 0.5", "electrical_W").mean is None
    assert comparison.mean("foresight", "trot 0.5", "electrical_W").mean == 900.0
