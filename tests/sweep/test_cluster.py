"""Sweeps on a real Dask scheduler with worker processes of its own on loopback."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import arthur_acausal.sweep
from arthur_acausal.errors import UsageError
from arthur_acausal.sweep.carry_out import How, Tally, carry_out
from tests.sweep.test_carry_out import plan, same, swept

pytest.importorskip("distributed")

GIVEN: dict[str, Any] = {
    "vary": {"tau": "0.1:2"},
    "method": "sobol",
    "samples": 40,
    "output": {"variables": ["x"]},
}


@pytest.fixture
def cluster() -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """A scheduler and two workers, each a process of its own without a nanny."""
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2]), "OMP_NUM_THREADS": "1"}
    started: list[subprocess.Popen[bytes]] = []

    def start(*words: str) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", "distributed.cli." + words[0], *words[1:]]
        process = subprocess.Popen(
            command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE
        )
        started.append(process)
        return process

    scheduler = start("dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")
    address = ""
    assert scheduler.stderr is not None
    while not address:
        line = scheduler.stderr.readline().decode()
        assert line, "the scheduler did not start"
        if "Scheduler at:" in line:
            address = line.split()[-1]
    workers = [
        start(
            "dask_worker", address, "--no-nanny", "--nthreads", "1", "--no-dashboard", "--host", "127.0.0.1"
        )
        for _ in range(2)
    ]
    yield address, workers
    for process in started:
        process.kill()
        process.communicate()


def test_the_same_bits_from_a_cluster_that_loses_a_worker(
    tmp_path: Path, cluster: tuple[str, list[subprocess.Popen[bytes]]]
) -> None:
    address, workers = cluster

    def kill(tally: Tally) -> None:
        if tally.ok >= 10 and workers[0].poll() is None:
            workers[0].send_signal(signal.SIGKILL)
            workers[0].wait()

    tally = carry_out(plan("Decay", **GIVEN), tmp_path / "cluster", How(scheduler=address), kill)
    assert (tally.ok, tally.failed) == (40, 0)
    assert workers[0].poll() == -signal.SIGKILL
    swept(tmp_path / "here", **GIVEN)
    same(tmp_path / "cluster", tmp_path / "here")


def test_nobody_there() -> None:
    begun = time.perf_counter()
    with pytest.raises(UsageError, match="no Dask scheduler answers at"):
        arthur_acausal.sweep.sweep(
            "examples.jack", vary={}, stop_time=0.1, scheduler="tcp://127.0.0.1:1", progress=False
        )
    assert time.perf_counter() - begun < 60.0


def test_a_cluster_of_its_own_on_loopback(tmp_path: Path) -> None:
    result = arthur_acausal.sweep.sweep(
        "examples.jack",
        vary={"load.m": [100, "200 kg"]},
        stop_time="10 ms",
        folder=tmp_path / "d",
        scheduler="local-dask",
        workers=1,
        progress=False,
    )
    assert result.table["status"].tolist() == ["ok", "ok"]
    assert result.table["load.m"].tolist() == [100.0, 200.0]
