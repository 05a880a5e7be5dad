"""One simulated second of the servo-hydraulic rig of 12 legs: ours with an empty cache, and rumoca's.

    python -m benchmarks.rig_race [--legs 12]

One JSON object. rumoca reads the model that we export. Simulations are the least of three on both sides.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
from typing import Any

from benchmarks.measure import fresh_json, peak_mb, repeat
from benchmarks.rumoca_run import in_rumoca, missing

STOP_TIME = 1.0  # [s]
RTOL = 1e-6
RUNS = 3


def watched(legs: int) -> list[str]:
    """Return the variables on which both are compared."""
    of_leg = ("loads[{}].s", "loads[{}].v", "cylinders[{}].p_A", "cylinders[{}].p_B", "valves[{}].x")
    return ["manifold.p"] + [path.format(k) for k in sorted({0, legs - 1}) for path in of_leg]


def race(legs: int) -> dict[str, Any]:
    """Measure here, rumoca in a process of its own; the difference is in units of each variable's range."""
    import casadi  # noqa: F401  imported before the clock starts
    import numpy as np
    import scipy.sparse  # noqa: F401
    import sksundae.ida  # noqa: F401

    from arthur_acausal import Solution, translate
    from benchmarks.rig import Rig

    begin = time.perf_counter()
    translation = translate(Rig(n=legs))
    translated = time.perf_counter() - begin
    solutions: list[Solution] = []
    taken = repeat(lambda: solutions.append(translation.simulate(STOP_TIME, tolerance=RTOL)), RUNS)
    figures: dict[str, Any] = {
        "states": len(translation.report.states),
        "translate_s": translated,
        "simulate_s": taken.best,
        "steps": solutions[-1].statistics.steps,
        "peak_mb": peak_mb(),
        "rumoca_translate_s": None,
        "rumoca_simulate_s": None,
        "difference": None,
    }
    if missing():
        return figures
    theirs = in_rumoca(translation.to_modelica(stop_time=STOP_TIME), STOP_TIME, RTOL, watched(legs), RUNS)
    t, worst = np.array(theirs["t"]), 0.0
    for path, values in theirs["values"].items():
        own = solutions[-1].at(t, path)
        worst = max(worst, float(np.max(np.abs(np.array(values) - own)) / np.ptp(own)))
    return figures | {
        "rumoca_translate_s": theirs["translate_s"],
        "rumoca_simulate_s": theirs["simulate_s"],
        "difference": worst,
    }


def in_fresh_process(legs: int = 12) -> dict[str, Any]:
    """Return the figures of a new process with an empty cache."""
    with tempfile.TemporaryDirectory() as cache:
        return fresh_json(["-m", "benchmarks.rig_race", "--legs", str(legs)], {"ARTHUR_CACHE_DIR": cache})


if __name__ == "__main__":
    command_line = argparse.ArgumentParser(description="The servo-hydraulic rig, ours and rumoca's.")
    command_line.add_argument("--legs", type=int, default=12)
    print(json.dumps(race(command_line.parse_args().legs)))
