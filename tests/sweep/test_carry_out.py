"""Sweeps run for real: results against closed forms, the same bits however they are run, nothing ever lost."""

from __future__ import annotations

import json
import math
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import arthur_acausal.sweep
from arthur_acausal import SolverOptions, translate
from arthur_acausal.codegen.kernel import compiler
from arthur_acausal.errors import ResultError, UsageError
from arthur_acausal.request.locate import find_model
from arthur_acausal.sweep import store as stores
from arthur_acausal.sweep.carry_out import How, Tally, carry_out
from arthur_acausal.sweep.lock import Lock
from arthur_acausal.sweep.merge import merge
from arthur_acausal.sweep.plan import Plan
from arthur_acausal.sweep.specification import from_mapping
from tests.sweep.models import Parted, Turning

MODELS = "tests.sweep.models"
OF_THE_MACHINE = ["wall_s", "cpu_s", "attempts"]  # columns that may differ from run to run


def plan(model: str, folder: Path = Path("."), **given: Any) -> Plan:
    return Plan(from_mapping({"model": f"{MODELS}:{model}", "stop_time": 1.0, **given}), folder, find_model)


def swept(folder: Path, how: How = How(workers=1), model: str = "Decay", **given: Any) -> Tally:  # noqa: B008
    return carry_out(plan(model, **given), folder, how)


def table(folder: Path) -> Any:
    return arthur_acausal.sweep.open(folder).table


def same(a: Path, b: Path) -> None:
    """The same rows and trajectories, bit for bit."""
    first, second = arthur_acausal.sweep.open(a), arthur_acausal.sweep.open(b)
    pd.testing.assert_frame_equal(
        first.table.drop(columns=OF_THE_MACHINE), second.table.drop(columns=OF_THE_MACHINE), check_exact=True
    )
    assert first.dataset.time.equals(second.dataset.time)
    for path in first.about["trajectories"]["variables"]:
        np.testing.assert_array_equal(first.dataset[path].values, second.dataset[path].values)


def test_results_are_those_of_the_closed_form(tmp_path: Path) -> None:
    tally = swept(
        tmp_path / "d",
        vary={"tau": "0.5:2:4", "x0": "1,3"},
        output={"variables": ["x"], "reductions": ["final(x)", "integral(x)", "first(x < 0.5)"]},
    )
    assert (tally.total, tally.ok, tally.failed) == (8, 8, 0)
    result = arthur_acausal.sweep.open(tmp_path / "d")
    frame: Any = result.table
    tau, x0 = frame["tau"], frame["x0"]
    np.testing.assert_allclose(frame["final(x)"], x0 * np.exp(-1 / tau), rtol=1e-4)
    np.testing.assert_allclose(frame["integral(x)"], x0 * tau * (1 - np.exp(-1 / tau)), rtol=1e-4)
    crossing = np.where(x0 * np.exp(-1 / tau) < 0.5, tau * np.log(2 * x0), np.nan)
    np.testing.assert_allclose(frame["first(x < 0.5)"], crossing, rtol=1e-3)
    x = result.dataset["x"]
    assert x.dims == ("run", "time")
    assert x.shape == (8, 101)
    exact = x0.to_numpy()[:, None] * np.exp(-result.dataset.time.to_numpy() / tau.to_numpy()[:, None])
    np.testing.assert_allclose(x, exact, rtol=1e-4)
    assert result.factors == ["tau", "x0"]
    assert result.about["units"] == {
        "tau": "s",
        "x0": "1",
        "final(x)": "1",
        "integral(x)": "s",
        "first(x < 0.5)": "s",
    }


def test_files_are_readable_by_common_tools(tmp_path: Path) -> None:
    import xarray as xr

    swept(tmp_path / "d", vary={"tau": "1,2"})
    assert pd.read_parquet(tmp_path / "d" / "runs.parquet")["tau"].tolist() == [1.0, 2.0]
    whole = xr.open_zarr(tmp_path / "d" / "trajectories.zarr", consolidated=False)
    assert whole["trajectory"].dims == ("run", "variable", "time")
    assert json.loads((tmp_path / "d" / "sweep.json").read_text())["runs"] == 2
    assert sorted(p.name for p in (tmp_path / "d").iterdir()) == [
        "runs.parquet",
        "sweep.json",
        "trajectories.zarr",
    ]


def test_inputs_structures_derived_and_fixed_values(tmp_path: Path) -> None:
    (tmp_path / "u.csv").write_text("time,value\n0,0\n1,2\n")
    given = {"inputs": {"u": "u.csv"}, "vary": {"x0": "0,1"}, "derive": {"tau": "1 + x0"}}
    carry_out(plan("Decay", tmp_path, **given), tmp_path / "a", How(workers=1))
    for _, row in table(tmp_path / "a").iterrows():
        tau, x0 = row["tau"], row["x0"]
        assert tau == 1 + x0
        ramp = 2 * (1 - tau * (1 - math.exp(-1 / tau)))  # response of a lag to the ramp 2 t
        assert row["final(x)"] == pytest.approx(ramp + x0 * math.exp(-1 / tau), rel=1e-4)
    swept(tmp_path / "b", model="Chain", vary={"n": "1,2,5", "tau": "1,2"}, output={"variables": ["x"]})
    frame = table(tmp_path / "b")
    np.testing.assert_allclose(
        frame["final(x)"], frame["n"].astype(float) * np.exp(-1 / frame["tau"]), rtol=1e-4
    )


@pytest.mark.skipif(compiler() is None, reason="no C compiler")
def test_runs_without_events_go_by_the_engine_in_c(tmp_path: Path) -> None:
    given: dict[str, Any] = {"vary": {"tau": "0.5:2:20", "x0": "1,3"}, "output": {"variables": ["x"]}}
    for name, engine in (("a", "auto"), ("b", "ida")):
        assert swept(tmp_path / name, engine=engine, **given).ok == 40
    fast, slow = table(tmp_path / "a"), table(tmp_path / "b")
    assert set(fast["engine"]) == {"straight"}
    assert set(slow["engine"]) == {"ida"}
    names = [name for name in fast.columns if name.endswith("(x)")]
    np.testing.assert_allclose(fast[names], slow[names], rtol=1e-5)
    np.testing.assert_allclose(fast["final(x)"], fast["x0"] * np.exp(-1.0 / fast["tau"]), rtol=1e-5)
    a, b = (arthur_acausal.sweep.open(tmp_path / name).dataset["x"].values for name in "ab")
    np.testing.assert_allclose(a, b, atol=1e-5)


def test_a_reduction_that_fails_is_a_failure_of_its_run(tmp_path: Path) -> None:
    output = {"variables": ["x"], "reductions": [f"{MODELS}:refused"]}
    tally = swept(tmp_path / "d", vary={"tau": "1,2,1.2"}, output=output)
    frame = table(tmp_path / "d")
    assert (tally.ok, tally.retried) == (2, 0)
    assert frame["status"].tolist() == ["ok", "failed", "ok"]
    assert frame["error"][1] == "ZeroDivisionError: no tau above 1.5"


def test_structures_of_parts(tmp_path: Path) -> None:
    given = plan("Parted", vary={"chain.n": "1,2,3", "chain.tau": "1,2"}, output={"variables": ["chain.x"]})
    tally = carry_out(given, tmp_path / "d", How(workers=1))
    assert (tally.ok, tally.failed) == (6, 0)
    frame = table(tmp_path / "d")
    expected = frame["chain.n"].astype(float) * np.exp(-1.0 / frame["chain.tau"])
    np.testing.assert_allclose(frame["final(chain.x)"], expected, rtol=1e-5)
    assert len({id(given.prepared(run)) for run in given.runs}) == 3  # each structure is translated once
    with pytest.raises(UsageError, match="n is a structural parameter of type int"):
        plan("Parted", vary={"chain.n": "1,x"}).task(plan("Parted", vary={"chain.n": "x"}).runs[0])


def test_structural_parameters_of_parts_by_path() -> None:
    assert translate(Parted(), structural={"chain.n": 3}).report.states == [
        f"chain.lags[{k}].x" for k in range(3)
    ]
    with pytest.raises(UsageError, match=r"chain\.m is no structural parameter of Parted"):
        translate(Parted(), structural={"chain.m": 3})


def test_several_models_in_one_sweep(tmp_path: Path) -> None:
    given = {"models": [f"{MODELS}:Decay", f"{MODELS}:Chain"], "vary": {"tau": "1,2"}, "stop_time": 1.0}
    given["output"] = {"variables": ["x"]}
    carry_out(Plan(from_mapping(given), Path("."), find_model), tmp_path / "d", How(workers=1))
    frame = table(tmp_path / "d")
    assert frame["model"].nunique() == 2
    assert frame["status"].tolist() == ["ok"] * 4


def test_the_same_bits_whatever_the_number_of_workers_and_shards(tmp_path: Path) -> None:
    given: Any = {"vary": {"tau": "0.1:2", "x0": "normal(1, 1)"}, "method": "sobol", "samples": 12, "seed": 4}
    swept(tmp_path / "one", **given)
    swept(tmp_path / "two", How(workers=2), **given)
    for i in (1, 2):
        swept(tmp_path / f"shard{i}", How(workers=1, shard=(i, 2)), **given)
    assert merge([tmp_path / f"shard{i}" for i in (2, 1)], tmp_path / "merged") == 12
    same(tmp_path / "one", tmp_path / "two")
    same(tmp_path / "one", tmp_path / "merged")


def test_samples_are_added_to_a_finished_sweep(tmp_path: Path) -> None:
    given: dict[str, Any] = {"vary": {"tau": "0.1:2"}, "method": "sobol"}
    swept(tmp_path / "d", samples=5, **given)
    tally = swept(tmp_path / "d", How(workers=1, resume=True), samples=11, **given)
    assert (tally.total, tally.kept, tally.ok) == (11, 5, 11)
    swept(tmp_path / "whole", samples=11, **given)
    same(tmp_path / "d", tmp_path / "whole")


def test_failures_are_rows_with_partial_trajectories(tmp_path: Path) -> None:
    tally = swept(tmp_path / "d", model="Explosion", vary={"T": "0.5,2,-1"}, output={"variables": ["x"]})
    assert (tally.ok, tally.failed) == (2, 1)
    result = arthur_acausal.sweep.open(tmp_path / "d")
    row = result.table.iloc[0]
    assert row["status"] == "failed"
    assert "x" in row["error"]
    assert row["end_time"] == pytest.approx(0.5, abs=1e-3)
    x = result.dataset["x"].values[0]
    np.testing.assert_allclose(x[:45], 1 / (1 - result.dataset.time.values[:45] / 0.5), rtol=1e-3)
    assert np.isnan(x[51:]).all()
    assert np.isnan(row["final(x)"])


def test_values_out_of_bounds_are_rows(tmp_path: Path) -> None:
    tally = swept(tmp_path / "d", vary={"tau": "-1,1,1e400"})
    assert (tally.ok, tally.failed) == (1, 2)
    assert "outside of" in table(tmp_path / "d")["error"][0]


def test_a_model_that_ends_itself_is_told_apart(tmp_path: Path) -> None:
    swept(tmp_path / "d", model="Ending", vary={"T": "0.5,2"})
    frame = table(tmp_path / "d")
    assert frame["status"].tolist() == ["terminated", "ok"]
    assert frame["error"][0] == "enough"
    assert frame["end_time"][0] == pytest.approx(0.5, abs=1e-6)


@pytest.fixture
def mark(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("ARTHUR_TEST_MARK", str(tmp_path / "mark"))
    return tmp_path / "mark"


def test_a_killed_workers_run_is_tried_again(tmp_path: Path, mark: Path) -> None:
    tally = swept(tmp_path / "d", How(workers=2), "Misbehaving", vary={"die": "0,1,0,0"})
    assert (tally.ok, tally.failed, tally.retried) == (4, 0, 1)
    assert table(tmp_path / "d")["attempts"].tolist() == [1, 2, 1, 1]


def test_a_run_that_always_kills_its_worker_is_a_row(tmp_path: Path, mark: Path) -> None:
    tally = swept(tmp_path / "d", How(workers=2, retry=1), "Misbehaving", vary={"die": "0,2,0"})
    assert (tally.ok, tally.failed) == (2, 1)
    row = table(tmp_path / "d").iloc[1]
    assert row["status"] == "crashed"
    assert "exit code -9" in row["error"]
    assert row["attempts"] == 2


def test_a_run_over_its_time_is_stopped(tmp_path: Path, mark: Path) -> None:
    how = How(workers=2, timeout=0.6)
    tally = swept(tmp_path / "d", how, "Misbehaving", vary={"seconds": "0,0.2,30"})
    frame = table(tmp_path / "d")
    assert frame["status"].tolist() == ["ok", "timeout", "timeout"]
    assert (tally.ok, tally.failed) == (1, 2)
    assert 0.1 <= frame["end_time"][1] < 1.0  # ended by itself, with what it had
    assert "stopped after 0.6 s" in frame["error"][2]


def test_another_sweep_in_the_same_directory_is_refused(tmp_path: Path) -> None:
    with Lock(tmp_path), pytest.raises(UsageError, match="another sweep is at work"):
        swept(tmp_path, vary={"tau": "1,2"})
    swept(tmp_path, vary={"tau": "1,2"})


def test_a_dead_lock_is_taken_over(tmp_path: Path) -> None:
    import socket

    (tmp_path / "lock.json").write_text(json.dumps({"host": socket.gethostname(), "pid": 1, "born": 0.5}))
    swept(tmp_path, vary={"tau": "1,2"})
    (tmp_path / "lock.json").write_text("")
    with pytest.raises(UsageError, match="another sweep is at work"):
        swept(tmp_path, How(workers=1, resume=True), vary={"tau": "1,2"})
    os.utime(tmp_path / "lock.json", (0.0, time.time() - 60.0))
    swept(tmp_path, How(workers=1, resume=True), vary={"tau": "1,2"})
    (tmp_path / "lock.json").write_text(json.dumps({"host": "another", "pid": 1, "born": 0.5}))
    with pytest.raises(UsageError, match="process 1 on another"):
        swept(tmp_path, How(workers=1, resume=True), vary={"tau": "1,2"})
    os.utime(tmp_path / "lock.json", (0.0, time.time() - 3600.0))
    swept(tmp_path, How(workers=1, resume=True), vary={"tau": "1,2"})


def test_another_specification_is_refused_with_the_difference(tmp_path: Path) -> None:
    swept(tmp_path / "d", vary={"tau": "1,2"})
    with pytest.raises(UsageError, match="holds a sweep already"):
        swept(tmp_path / "d", vary={"tau": "1,2"})
    with pytest.raises(UsageError, match="another specification") as caught:
        swept(tmp_path / "d", How(workers=1, resume=True), vary={"tau": "1,3"})
    assert "vary.tau: '1,2' there, '1,3' now" in str(caught.value)


def test_a_torn_line_is_as_if_it_were_not_there(tmp_path: Path) -> None:
    store = stores.Store.create(tmp_path, {"specification": {}, "runs": 3})
    for k in range(3):
        store.add({"run": k, "status": "ok"}, None, k)
    store.close()
    journal = tmp_path / stores.JOURNAL
    whole = journal.read_bytes()
    for cut in range(len(whole)):
        journal.write_bytes(whole[:cut])
        assert len(list(stores.journal(tmp_path))) == whole[:cut].count(b"\n")
    journal.write_bytes(whole[:-3])
    store = stores.Store.existing(tmp_path)
    store.add({"run": 2, "status": "again"}, None, 2)
    store.close()
    assert list(stores.done(tmp_path).values()) == ["ok", "ok", "again"]


COMMAND = """
import sys
from pathlib import Path
from tests.sweep.test_carry_out import How, carry_out, plan
given = {"vary": {"tau": "0.1:2"}, "method": "sobol", "samples": 60, "output": {"variables": ["x"]}}
carry_out(plan("Decay", **given), Path(sys.argv[1]), How(workers=2, resume="resume" in sys.argv))
"""


def start(folder: Path, *words: str, limit: int | None = None) -> subprocess.Popen[bytes]:
    command = COMMAND
    if limit is not None:
        command = f"import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, ({limit}, {limit}))\n{command}"
        command = "import signal\nsignal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n" + command
    root = str(Path(__file__).parents[2])
    environment = {**os.environ, "PYTHONPATH": root}
    return subprocess.Popen(
        [sys.executable, "-c", command, str(folder), *words], env=environment, stderr=subprocess.PIPE
    )


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sweep") / "whole"
    process = start(folder)
    assert process.communicate()[1] == b""
    return folder


@pytest.mark.parametrize("seed", [1])
def test_killed_and_resumed_it_is_as_if_nothing_had_been(
    tmp_path: Path, uninterrupted: Path, seed: int
) -> None:
    folder, wanted = tmp_path / "d", random.Random(seed).randint(3, 50)
    process = start(folder)
    while process.poll() is None and len(list(stores.journal(folder))) < wanted:
        time.sleep(0.005)
    process.send_signal(signal.SIGKILL)
    process.communicate()
    kept = stores.done(folder)
    assert kept
    if len(kept) < 60:
        process = start(folder, "resume")
        assert process.communicate()[1] == b""
    same(folder, uninterrupted)
    assert table(folder)["run"].tolist() == list(range(60))


def test_a_full_disk_is_told_and_nothing_is_damaged(tmp_path: Path, uninterrupted: Path) -> None:
    process = start(tmp_path / "d", limit=6000)  # the journal may not grow beyond
    told = process.communicate()[1].decode()
    assert process.returncode == 1
    assert "cannot write in" in told
    kept = stores.done(tmp_path / "d")
    assert 0 < len(kept) < 60
    assert start(tmp_path / "d", "resume").communicate()[1] == b""
    same(tmp_path / "d", uninterrupted)


def test_a_place_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(ResultError, match="cannot make"):
        swept(tmp_path / "file" / "d", vary={"tau": "1,2"})
    with pytest.raises((ResultError, UsageError), match=r"cannot|not empty"):
        swept(Path("/proc/1"), vary={"tau": "1,2"})
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.tex").write_text("")
    with pytest.raises(UsageError, match="is not empty"):
        swept(tmp_path / "mine", vary={"tau": "1,2"})


def test_a_file_beside_the_model_that_is_called_like_a_library_hides_nothing(tmp_path: Path) -> None:
    (tmp_path / "json.py").write_text("")
    text = (Path(__file__).parent / "models.py").read_text()
    (tmp_path / "decay.py").write_text(text)
    given = {"model": f"{tmp_path / 'decay.py'}:Decay", "stop_time": 1.0, "vary": {"tau": "1,2"}}
    tally = carry_out(Plan(from_mapping(given), tmp_path, find_model), tmp_path / "d", How(workers=1))
    assert (tally.ok, tally.failed) == (2, 0)


def test_a_first_run_that_fails_hides_no_reduction(tmp_path: Path) -> None:
    swept(tmp_path / "d", vary={"tau": "-1,1"}, output={"variables": ["x"], "reductions": ["max(x)"]})
    result = arthur_acausal.sweep.open(tmp_path / "d")
    assert result.reductions == ["max(x)"]
    names = list(result.table.columns)
    assert names.index("max(x)") == names.index("end_time") + 1


def test_shards_that_contradict_each_other_are_refused(tmp_path: Path) -> None:
    for name in "ab":
        swept(tmp_path / name, vary={"tau": "1,2"})
    frame = table(tmp_path / "b")
    frame.loc[1, "final(x)"] += 1e-9
    stores.write_table(tmp_path / "b", frame)
    with pytest.raises(UsageError, match="run 1 of") as caught:
        merge([tmp_path / "a", tmp_path / "b"], tmp_path / "whole")
    assert "final(x) differ" in str(caught.value)
    assert merge([tmp_path / "a", tmp_path / "a"], tmp_path / "same") == 2


def test_a_damaged_line_costs_only_itself(tmp_path: Path) -> None:
    store = stores.Store.create(tmp_path, {"specification": {}, "runs": 3})
    for k in range(3):
        store.add({"run": k, "status": "ok"}, None, k)
    store.close()
    journal = tmp_path / stores.JOURNAL
    content = bytearray(journal.read_bytes())
    content[len(content) // 2] ^= 1
    journal.write_bytes(content)
    store = stores.Store.existing(tmp_path)
    store.add({"run": 1, "status": "again"}, None, 1)
    store.close()
    assert stores.done(tmp_path) == {0: "ok", 1: "again", 2: "ok"}


def test_a_set_of_states_that_becomes_singular_gives_way_to_another(tmp_path: Path) -> None:
    tally = swept(
        tmp_path / "d",
        model="Turning",
        stop_time=3.0,
        vary={"w": "8 rad/s,9 rad/s"},
        output={"variables": list("xyvu")},
    )
    assert (tally.ok, tally.failed) == (2, 0)
    frame = table(tmp_path / "d")
    assert all("changes of the set of states" in note for note in frame["notes"])
    x, y, v, u = (frame[f"final({name})"].to_numpy() for name in "xyvu")
    np.testing.assert_allclose(x**2 + y**2, 1.0, rtol=1e-12)
    # the energy that it began with, per mass: (w L)^2 / 2
    np.testing.assert_allclose((v**2 + u**2) / 2 + 9.81 * y, np.array([8.0, 9.0]) ** 2 / 2, rtol=1e-3)
    here = translate(Turning()).simulate(
        3.0, parameters={"w": 9.0}, options=SolverOptions(output_interval=1e-3)
    )
    assert here["x"][-1] == x[1]


def test_what_the_solver_tells_stands_in_the_table(tmp_path: Path) -> None:
    swept(tmp_path / "d", model="Guessed", vary={"tau": "1,2"})
    assert "start values that nothing uses: y" in table(tmp_path / "d")["notes"][0]
