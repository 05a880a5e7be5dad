"""The default powertrain with the demo's inputs: translation and one simulated second, beside other ways.

    python -m benchmarks.powertrain [--json]

Each part runs in processes of its own: translation with an empty and with a filled cache (imports excluded);
the race against CasADi's IDAS (see race.py); explicit Euler and Runge-Kutta 4 compiled from C (explicit.py).
"""

from __future__ import annotations

import json
import shutil
import statistics
import tempfile
import time
from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from benchmarks.measure import fresh_json, load_average, parser, show

if TYPE_CHECKING:
    from arthur_acausal import Translation
    from benchmarks.powertrain_byhand import Array, Flat

STOP_TIME = 1.0  # [s]
INTERVALS = 1000  # of the output grid
TOLERANCES = {"1e-4": 1e-4, "1e-6": 1e-6}
TRANSLATIONS = 3
RUNS = 5
EULER_GUESS, RK4_GUESS = 0.4e-6, 4e-6  # [s], where the search for the largest stable step starts


def translate_once(_stop_time: float) -> dict[str, Any]:
    """Translate in this process, whatever the cache holds; imports come before the clock starts."""
    import casadi  # noqa: F401
    import scipy.sparse.linalg  # noqa: F401
    import sksundae.ida  # noqa: F401

    from arthur_acausal import translate
    from arthur_acausal.models.arthur.demo import Demo

    begin = time.perf_counter()
    translate(Demo())
    return {"translate_s": time.perf_counter() - begin}


def lap(
    translation: Translation, equations: Flat, label: str, grid: Array, reference: Array
) -> dict[str, Any]:
    """Race ours against IDAS at one tolerance; return the figures of both."""
    from arthur_acausal import SolverOptions
    from benchmarks.race import Idas, alternate, error, fastest, states_on

    rtol = TOLERANCES[label]
    options = SolverOptions(rtol=rtol, intervals=INTERVALS)
    ours = partial(translation.simulate, grid[-1], options=options)
    solver, idas = fastest(equations, grid, rtol)
    idas_jit = Idas(equations, grid, rtol, solver, jit=True)
    mine, theirs, theirs_jit = alternate([ours, idas.run, idas_jit.run], RUNS)
    solution = ours()
    statistics = solution.statistics
    mine_off = error(states_on(grid, solution, equations.paths), reference, equations.paths)
    theirs_off = error(idas.run(), reference, equations.paths)
    return {
        "simulate_s": mine.best,
        "simulate_median_s": mine.median,
        "idas_s": theirs.best,
        "idas_median_s": theirs.median,
        "idas_jit_s": theirs_jit.best,
        "ratio_to_idas": mine.best / theirs.best,
        "ratio_to_idas_jit": mine.best / theirs_jit.best,
        "idas_linear_solver": solver,
        "us_per_residual": statistics.us_per_residual_call,
        "steps": statistics.steps,
        "idas_steps": idas.steps,
        "residual_calls": statistics.residual_evaluations,
        "error": asdict(mine_off),
        "idas_error": asdict(theirs_off),
        "error_ratio": mine_off.rms / theirs_off.rms,
    }


def race(stop_time: float) -> dict[str, Any]:
    """Race the demo with its energy audit, and without; return each figure by tolerance."""
    from arthur_acausal import translate
    from arthur_acausal.models.arthur.demo import Demo
    from benchmarks.powertrain_byhand import flat, trot
    from benchmarks.race import REFERENCE_RTOL, Idas, with_nominals_of

    grid = np.linspace(0.0, stop_time, INTERVALS + 1)
    figures: dict[str, Any] = {}
    for audit in (True, False):
        translation = translate(Demo(audit=audit))
        equations = with_nominals_of(translation, flat(trot, audit=audit))
        reference = Idas(equations, grid, REFERENCE_RTOL).run()
        laps = {label: lap(translation, equations, label, grid, reference) for label in TOLERANCES}
        by_key = {key: {label: row[key] for label, row in laps.items()} for key in laps["1e-4"]}
        if audit:
            figures |= {"us_per_residual_call": by_key.pop("us_per_residual")["1e-6"], **by_key}
        else:
            figures["without_audit"] = by_key
    return figures


def explicit(stop_time: float) -> dict[str, Any]:
    """Find the largest stable steps of the two explicit methods in C, and what a second costs with them."""
    from benchmarks.explicit import compiled, largest_stable
    from benchmarks.powertrain_byhand import flat, trot
    from benchmarks.race import Idas

    equations = flat(trot)
    grid = np.linspace(0.0, stop_time, INTERVALS + 1)
    reference = Idas(equations, grid, 1e-9).run()
    with compiled(equations, reference[:, -1], np.ptp(reference, axis=1), stop_time) as program:
        euler = largest_stable(program, "euler", EULER_GUESS)
        rk4 = largest_stable(program, "rk4", RK4_GUESS)
    return {
        "euler_s": euler.wall_s,
        "euler_step_s": euler.step_s,
        "euler_error": euler.error,
        "rk4_s": rk4.wall_s,
        "rk4_step_s": rk4.step_s,
        "rk4_error": rk4.error,
    }


PARTS: dict[str, Callable[[float], dict[str, Any]]] = {
    "translate": translate_once,
    "race": race,
    "explicit": explicit,
}


def translation_times() -> dict[str, Any]:
    """Return the best of several translations, cache empty and filled, each in a new process [s]."""
    command = ["-m", "benchmarks.powertrain", "--part", "translate"]
    cold: list[float] = []
    cached: list[float] = []
    for _ in range(TRANSLATIONS):
        with tempfile.TemporaryDirectory() as cache:
            for times in (cold, cached):
                times.append(fresh_json(command, {"ARTHUR_CACHE_DIR": cache})["translate_s"])
    return {
        "translate_cold_s": min(cold),
        "translate_cold_median_s": statistics.median(cold),
        "translate_cached_s": min(cached),
    }


def measure(stop_time: float) -> dict[str, Any]:
    """Run all parts and gather their figures."""
    figures = {"load_average": load_average(), **translation_times()}
    command = ["-m", "benchmarks.powertrain", "--stop-time", repr(stop_time), "--part"]
    figures |= fresh_json([*command, "race"])
    if shutil.which("cc") or shutil.which("gcc"):
        figures |= fresh_json([*command, "explicit"])
    else:
        figures |= {"euler_s": None, "rk4_s": None}
    return figures


def race_rows(figures: dict[str, Any]) -> list[list[str]]:
    """Return the table of one race: ours, and IDAS by hand, at each tolerance."""
    rows = []
    for label in TOLERANCES:
        for who, seconds, prefix in (("ours", "simulate_s", ""), ("idas by hand", "idas_s", "idas_")):
            worth = figures[f"{prefix}error"][label]
            counts = [f"{1e3 * figures[seconds][label]:.1f}", str(figures[f"{prefix}steps"][label])]
            rows.append(
                [f"{who}, {label}", *counts, f"{worth['worst']:.1e}", worth["path"], f"{worth['rms']:.1e}"]
            )
        compiled = f"{1e3 * figures['idas_jit_s'][label]:.1f}"
        rows.append([f"idas by hand, compiled, {label}", compiled, "", "", "", ""])
    return rows


def report(figures: dict[str, Any]) -> None:
    """Print the tables."""
    show(
        "Translation of the 12-actuator powertrain, new process, best of 3",
        ["what", "s", "required, s"],
        [
            ["empty cache, C compiler included", f"{figures['translate_cold_s']:.2f}", "1.5"],
            ["cached", f"{figures['translate_cached_s']:.2f}", "0.3"],
        ],
    )
    heads = ["who, rtol", "ms", "steps", "worst error/range", "of", "rms"]
    for title, race in (("energy audit included", figures), ("without audit", figures["without_audit"])):
        show(f"The demo, {title}; best of {RUNS}", heads, race_rows(race))
        for label in TOLERANCES:
            ratio, compiled = race["ratio_to_idas"][label], race["ratio_to_idas_jit"][label]
            print(
                f"rtol {label}: {ratio:.2f} times idas (required 3), {compiled:.2f} times idas compiled, "
                f"rms error {race['error_ratio'][label]:.2f} times theirs (required 2)"
            )
    print(f"{figures['us_per_residual_call']:.1f} us a residual call, all that IDA does included")
    for name, key in (("explicit Euler", "euler"), ("Runge-Kutta 4", "rk4")):
        if figures[f"{key}_s"] is not None:
            step, error = 1e6 * figures[f"{key}_step_s"], figures[f"{key}_error"]
            seconds = figures[f"{key}_s"]
            print(
                f"{name} in C: {seconds:.2f} s at its largest stable step of {step:.2f} us, error {error:.0e}"
            )


def main() -> None:
    """Measure and print."""
    command_line = parser("The powertrain: translation, one simulated second, and other ways to it.")
    command_line.add_argument("--part", choices=sorted(PARTS), help="one part, in this process, as JSON")
    command_line.add_argument(
        "--stop-time", type=float, default=STOP_TIME, help="[s]; requirements hold for 1"
    )
    arguments = command_line.parse_args()
    if arguments.part:
        print(json.dumps(PARTS[arguments.part](arguments.stop_time)))
        return
    figures = measure(arguments.stop_time)
    if arguments.json:
        print(json.dumps(figures))
    else:
        report(figures)


if __name__ == "__main__":
    main()
