"""Throughput of sweeps, and what kills do to them.

    python -m benchmarks.sweep [--json] [--kills 20] [--quick]

- A direct-current motor with inertia, 200 values of J, 5 s at rtol 1e-6, the store written: runs a second on one
  core, beside CasADi's ``idas`` on equations flattened by hand (final values only) and rumoca.
- The powertrain, 256 Sobol samples of 8 parameters, 1 s each, with one worker and with two.
- The quadruped, 16 runs of 2 s of trot.
- 10,000 runs of a small model: memory of the process that keeps them, beside that for 1,000; how long opening the
  store and `arthur report` take.
- Sweeps whose parent is killed (SIGKILL) at a random moment and resumed, compared with an undisturbed one.
"""

from __future__ import annotations

import json
import os
import random
import resource
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from benchmarks.measure import fresh_json, fresh_process, load_average, parser, peak_mb, show
from benchmarks.rumoca_run import missing

MOTOR = "arthur_acausal.models.examples.dc_motor:DCMotor"
STOP_TIME, RTOL, RUNS = 5.0, 1e-6, 200  # s, -, -
POWERTRAIN = {
    "relief.p_c": "180bar:220bar",
    "relief.k": "uniform(5e3, 2e4)",
    "pump.D": "uniform(1.3e-7, 1.5e-7)",
    "pump.c_L": "loguniform(1e-14, 1e-12)",
    "motor.R_LL": "uniform(0.05, 0.2)",
    "reservoir.p_gi": "1bar:3bar",
    "motor.J": "uniform(1e-5, 1e-4)",
    "pump.J": "uniform(1e-6, 1e-5)",
}
KEPT = ["reservoir.p", "motor.I"]


def main() -> None:
    """Measure and print."""
    command_line = parser(__doc__.partition("\n")[0] if __doc__ else "")
    command_line.add_argument("--kills", type=int, default=20, metavar="N", help="sweeps that are killed")
    command_line.add_argument("--quick", action="store_true", help="fewer runs of the large models")
    command_line.add_argument("--part", choices=PARTS, help="measure one part here and print it")
    command_line.add_argument(
        "--fill", nargs=2, metavar=("RUNS", "DIR"), help="of many runs (used by itself)"
    )
    given = command_line.parse_args()
    if given.fill is not None:
        print(json.dumps(fill(int(given.fill[0]), Path(given.fill[1]))))
        return
    if given.part is not None:
        print(json.dumps(PARTS[given.part](given.quick)))
        return
    found: dict[str, Any] = {
        name: fresh_json(["-m", "benchmarks.sweep", "--part", name, *(["--quick"] * given.quick)])
        for name in PARTS
    }
    found["kills"] = kills(given.kills)
    found |= {"load": load_average()}
    if given.json:
        print(json.dumps(found))
        return
    report(found)


def dc_motor(quick: bool) -> dict[str, Any]:
    """Runs a second on one core: sweep with one worker, idas, rumoca."""
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})  # the worker, too
    with tempfile.TemporaryDirectory() as folder:
        ours = motor_sweep(Path(folder) / "d", "ida")
        native = statistics.median(motor_sweep(Path(folder) / f"n{k}", "auto") for k in range(3))
    return {
        "runs_per_s": ours,
        "native_runs_per_s": native,
        "casadi_idas_runs_per_s": motor_idas(),
        "rumoca_runs_per_s": motor_rumoca(20),
    }


def motor_sweep(folder: Path, engine: str) -> float:
    """Return the runs a second after those that a worker is given first: without start and translation."""
    from arthur_acausal.sweep import sweep
    from arthur_acausal.sweep.carry_out import Tally
    from arthur_acausal.sweep.prepare import BATCH

    ends: list[float] = []

    def watch(tally: Tally) -> None:
        ends.append(time.perf_counter())

    output = {"trajectories": False, "reductions": ["final(rotor.w)"]}
    sweep(
        MOTOR,
        vary={"rotor.J": f"1e-3:1e-2:{RUNS}"},
        stop_time=STOP_TIME,
        folder=folder,
        workers=1,
        progress=watch,
        output=output,
        tolerance=RTOL,
        engine=engine,
    )
    first = 1 if engine == "ida" else 2 * BATCH  # batches begin with 1, 2, 4, ... runs
    return (len(ends) - first) / (ends[-1] - ends[first - 1])


def motor_idas() -> float:
    """The same motor as two equations written by hand, in CasADi's interface to IDAS."""
    import casadi
    import numpy as np

    i, w, phi, inertia = (casadi.MX.sym(name) for name in ("i", "w", "phi", "J"))
    rates = casadi.vertcat((24.0 - 0.5 * i - 0.1 * w) / 1e-3, (0.1 * i - 1e-3 * w) / inertia, w)
    problem = {"x": casadi.vertcat(i, w, phi), "p": inertia, "ode": rates}
    options = {"reltol": RTOL, "abstol": 0.01 * RTOL}
    integrator = casadi.integrator("motor", "idas", problem, 0.0, STOP_TIME, options)
    integrator(x0=np.zeros(3), p=1e-3)
    begin = time.perf_counter()
    for value in np.linspace(1e-3, 1e-2, RUNS).tolist():
        integrator(x0=np.zeros(3), p=value)
    return RUNS / (time.perf_counter() - begin)


def motor_rumoca(runs: int) -> float | None:
    """The same motor as we export it, in rumoca; None where it is missing."""
    if missing():
        return None
    import rumoca

    from arthur_acausal import translate
    from arthur_acausal.models.examples.dc_motor import DCMotor

    text = translate(DCMotor()).to_modelica(stop_time=STOP_TIME)
    model = rumoca.Session().loads(text, model=text.split(maxsplit=2)[1])
    config = rumoca.SimConfig(rtol=RTOL, atol=0.01 * RTOL)
    model.simulate(t=(0.0, STOP_TIME), dt=STOP_TIME, config=config)
    begin = time.perf_counter()
    for _ in range(runs):
        model.simulate(t=(0.0, STOP_TIME), dt=STOP_TIME, config=config)
    return runs / (time.perf_counter() - begin)


def powertrain(quick: bool) -> dict[str, Any]:
    """Runs a minute and CPU seconds a run with one worker and with two."""
    from arthur_acausal.sweep import sweep
    from arthur_acausal.sweep.carry_out import Tally

    samples = 16 if quick else 256
    result: dict[str, Any] = {"runs_per_min": {}, "cpu_s_per_run": {}}
    for workers in (1, 2):
        ends: list[float] = []

        def watch(tally: Tally, ends: list[float] = ends) -> None:
            ends.append(time.perf_counter())

        with tempfile.TemporaryDirectory() as folder:
            found: Any = sweep(
                "arthur.demo",
                vary=POWERTRAIN,
                stop_time=1.0,
                method="sobol",
                samples=samples,
                folder=Path(folder) / "d",
                workers=workers,
                progress=watch,
                output={"variables": KEPT},
            ).table
        busy = float(found["wall_s"].iloc[workers:].sum())
        wall = ends[-1] - ends[workers - 1]
        result["runs_per_min"][str(workers)] = 60.0 * (samples - workers) / wall
        result["cpu_s_per_run"][str(workers)] = float(found["cpu_s"].mean())
        result["failed"] = int((found["status"] != "ok").sum())
        if workers == 2:
            result["idle_share"] = max(0.0, 1.0 - busy / (workers * wall))
    return result


def quadruped(quick: bool) -> dict[str, Any]:
    """Runs a minute of the walking robot."""
    from arthur_acausal.models import REGISTRY
    from arthur_acausal.sweep import sweep

    if "arthur.quadruped" not in REGISTRY:
        return {"runs_per_min": None}
    runs = 2 if quick else 16
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        found: Any = sweep(
            "arthur.quadruped",
            vary={"unit.relief.p_c": f"120bar:150bar:{runs}"},
            stop_time=2.0,
            folder=Path(folder) / "d",
            progress=False,
            tolerance=1e-4,
        ).table
        wall = time.perf_counter() - begin
    return {"runs_per_min": 60.0 * runs / wall, "failed": int((found["status"] != "ok").sum())}


def many(quick: bool) -> dict[str, Any]:
    """Memory of the parent for a few and for many runs; opening and reporting the many."""
    found: dict[str, Any] = {"peak_rss_mb": {}}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for runs in (100, 1000) if quick else (1000, 10_000):
            folder = Path(name) / str(runs)
            filled = fresh_json(["-m", "benchmarks.sweep", "--fill", str(runs), str(folder)])
            found["peak_rss_mb"][str(runs)] = filled["peak_rss_mb"]
        opened = fresh_json(["-c", OPENED, str(folder)])
        page = Path(name) / "report.html"
        begin, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
        command = "from arthur_acausal.cli import main; main()"
        fresh_process(["-c", command, "report", str(folder), "-o", str(page)])
        took, after = time.perf_counter() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
        cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        found |= opened | {"report_s": took, "report_cpu_s": cpu, "report_mb": page.stat().st_size / 1e6}
    return found


def fill(runs: int, folder: Path) -> dict[str, float]:
    """Run so many jacks, and return what this process took of memory at most."""
    from arthur_acausal.sweep import sweep

    vary = {"load.m": "uniform(100, 1000)", "orifice.area": "loguniform(1e-6, 1e-5)"}
    sampled = {"method": "random", "samples": runs, "output": {"interval": 1e-3}}
    sweep("examples.jack", vary=vary, stop_time=0.02, folder=folder, progress=False, **sampled)  # type: ignore[arg-type]
    return {"peak_rss_mb": peak_mb()}


# xarray and what it looks for take a second to import: that is told apart from opening.
OPENED = """
import contextlib, json, sys, time
begin = time.perf_counter()
import pandas, xarray, zarr
with contextlib.suppress(ImportError):
    import dask.array
import arthur_acausal.sweep
imported, cpu = time.perf_counter(), time.process_time()
found = arthur_acausal.sweep.open(sys.argv[1])
found.table, found.dataset
times = {"open_s": time.perf_counter() - imported, "open_cpu_s": time.process_time() - cpu}
print(json.dumps({"import_s": imported - begin, **times}))
"""

KILLED = """
import sys
from pathlib import Path
from arthur_acausal.sweep import sweep
sweep("examples.jack", vary={"load.m": "uniform(100, 1000)", "orifice.area": "loguniform(1e-6, 1e-5)"}, method="sobol",
      samples=100, stop_time=0.1, folder=sys.argv[1], workers=2, resume="resume" in sys.argv, progress=False)
"""
OF_THE_MACHINE = ["wall_s", "cpu_s", "attempts"]


def kills(tries: int) -> dict[str, int]:
    """Kill sweeps at random moments, resume them, and compare with one that was left alone."""
    import numpy as np

    import arthur_acausal.sweep as sweeps

    def start(folder: Path, *words: str) -> subprocess.Popen[bytes]:
        root = str(Path(__file__).resolve().parents[1])
        environment = {**os.environ, "PYTHONPATH": root}
        return subprocess.Popen([sys.executable, "-c", KILLED, str(folder), *words], env=environment)

    counted = {"tried": 0, "lost": 0, "duplicated": 0, "changed": 0}
    if not tries:
        return counted
    with tempfile.TemporaryDirectory() as name:
        whole = Path(name) / "whole"
        begin = time.perf_counter()
        start(whole).wait()
        length = time.perf_counter() - begin
        expected = sweeps.open(whole)
        chance = random.Random(1)
        for k in range(tries):
            folder = Path(name) / str(k)
            process = start(folder)
            time.sleep(length * chance.uniform(0.2, 1.0))
            process.send_signal(signal.SIGKILL)
            process.wait()
            start(folder, "resume").wait()
            found = sweeps.open(folder)
            numbers = found.table["run"].tolist()
            counted["tried"] += 1
            counted["lost"] += len(set(expected.table["run"]) - set(numbers))
            counted["duplicated"] += len(numbers) - len(set(numbers))
            same = found.table.drop(columns=OF_THE_MACHINE).equals(
                expected.table.drop(columns=OF_THE_MACHINE)
            )
            paths = expected.about["trajectories"]["variables"]
            same &= all(np.array_equal(found.dataset[p], expected.dataset[p]) for p in paths)
            counted["changed"] += not same
            shutil.rmtree(folder)
    return counted


PARTS = {"dc_motor": dc_motor, "powertrain": powertrain, "quadruped": quadruped, "many": many}


def report(found: dict[str, Any]) -> None:
    """Print the figures as tables."""
    motor, drive, walk, killed = (found[k] for k in ("dc_motor", "powertrain", "quadruped", "kills"))
    idas = motor["casadi_idas_runs_per_s"]
    rows = [
        [
            "arthur sweep, the default engine",
            f"{motor['runs_per_s']:.0f}",
            f"{motor['runs_per_s'] / idas:.3f} (required 0.1)",
        ],
        [
            "arthur sweep, the engine in C",
            f"{motor['native_runs_per_s']:.0f}",
            f"{motor['native_runs_per_s'] / idas:.3f} (required 1)",
        ],
        ["CasADi idas, by hand", f"{idas:.0f}", "1"],
    ]
    if motor["rumoca_runs_per_s"] is not None:
        rows.append(
            ["rumoca", f"{motor['rumoca_runs_per_s']:.1f}", f"{motor['rumoca_runs_per_s'] / idas:.4f}"]
        )
    show("Direct-current motor, 5 s, one core", ["", "runs a second", "to idas"], rows)
    rows = [
        [f"powertrain, -j {j}", f"{drive['runs_per_min'][j]:.0f}", f"{drive['cpu_s_per_run'][j]:.3f}"]
        for j in ("1", "2")
    ]
    rows.append(["idle share of two workers", f"{drive['idle_share']:.3f}", "required < 0.05"])
    if walk["runs_per_min"] is not None:
        rows.append(["quadruped, 2 s of trot", f"{walk['runs_per_min']:.1f}", ""])
    show("Large models", ["", "runs a minute", "CPU s a run"], rows)
    lots = found["many"]
    rows = [
        [f"memory of the parent, {runs} runs", f"{size:.0f} MB"] for runs, size in lots["peak_rss_mb"].items()
    ]
    rows += [["opening", f"{lots['open_s']:.2f} s"], ["arthur report", f"{lots['report_s']:.1f} s"]]
    show("Many runs", ["", ""], rows)
    show("Killed and resumed", list(killed), [[str(v) for v in killed.values()]])


if __name__ == "__main__":
    main()
