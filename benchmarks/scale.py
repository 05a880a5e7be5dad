"""Translation, simulation and memory of an RC ladder of N sections, built by `connect`.

    python -m benchmarks.scale [--json] [--sizes 10,100,1000,10000]

1 kOhm and 1 uF a section, a 1 V step, 1 s, rtol 1e-6; an empty cache; each size in a process of its own.
Imports are excluded. The last node, and six more along the ladder, are checked against the closed form.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
from typing import Any

from benchmarks.measure import fresh_json, load_average, parser, peak_mb, show

SIZES = (10, 100, 1000, 10000)
STOP_TIME = 1.0  # [s]
RTOL = 1e-6
REQUIRED = {1000: "2 s, 300 MB", 10000: "30 s, 2000 MB"}  # translation and simulation together


def checked_nodes(n: int) -> list[int]:
    """Return the nodes held against the closed form: seven, evenly spread in the logarithm."""
    return sorted({round(n ** (k / 6)) for k in range(7)})


def measure_one(n: int) -> dict[str, Any]:
    """Translate and simulate the ladder of n sections here; return the figures of this process."""
    import casadi  # noqa: F401  imported before the clock starts
    import numpy as np
    import scipy.sparse  # noqa: F401
    import sksundae.ida  # noqa: F401

    from arthur_acausal import translate
    from benchmarks.ladder import Ladder, exact_voltage

    begin = time.perf_counter()
    translation = translate(Ladder(n=n))
    translated = time.perf_counter()
    solution = translation.simulate(STOP_TIME, tolerance=RTOL)
    simulated = time.perf_counter()
    peak = peak_mb()
    errors = {}
    for node in checked_nodes(n):
        exact = exact_voltage(n, node, solution.t)
        errors[node] = float(np.max(np.abs(solution[f"capacitors[{node - 1}].v"] - exact)))
    return {
        "n": n,
        "equations": translation.report.equations,
        "translate_s": translated - begin,
        "simulate_s": simulated - translated,
        "total_s": simulated - begin,
        "peak_mb": peak,
        "last_node_error_V": errors[n],
        "error_V": max(errors.values()),
    }


def measure(sizes: list[int]) -> dict[str, Any]:
    """Measure each size in a fresh process with an empty cache."""
    ladder = []
    for n in sizes:
        with tempfile.TemporaryDirectory() as cache:
            command = ["-m", "benchmarks.scale", "--one", str(n)]
            ladder.append(fresh_json(command, {"ARTHUR_CACHE_DIR": cache}))
    return {"ladder": ladder, "load_average": load_average()}


def sizes_of(text: str) -> list[int]:
    """Return the sizes in "10,100,1000"."""
    try:
        sizes = [int(word) for word in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is no list such as 10,100,1000") from None
    if min(sizes) < 1:
        raise argparse.ArgumentTypeError("a ladder has at least one section")
    return sizes


def main() -> None:
    """Measure and print."""
    command_line = parser("An RC ladder of N sections: translation, simulation, memory.")
    command_line.add_argument("--sizes", type=sizes_of, default=list(SIZES), help="for example 10,100,1000")
    command_line.add_argument("--one", type=int, metavar="N", help="one size, in this process, as JSON")
    arguments = command_line.parse_args()
    if arguments.one:
        print(json.dumps(measure_one(arguments.one)))
        return
    figures = measure(arguments.sizes)
    if arguments.json:
        print(json.dumps(figures))
        return
    rows = [
        [str(row["n"]), str(row["equations"])]
        + [f"{row[key]:.2f}" for key in ("translate_s", "simulate_s", "total_s")]
        + [f"{row['peak_mb']:.0f}", f"{row['error_V']:.1e}", REQUIRED.get(row["n"], "")]
        for row in figures["ladder"]
    ]
    heads = ["sections", "equations", "translate, s", "simulate, s", "both, s", "peak, MB", "error, V"]
    heads.append("required")
    show("RC ladder, 1 s at rtol 1e-6, empty cache, a process each", heads, rows)


if __name__ == "__main__":
    main()
