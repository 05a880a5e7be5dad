"""Translation, simulation and memory of an RC ladder of N sections, built by `connect`.

    python -m benchmarks.scale [--json] [--sizes 10,100,1000,10000] [--full]

1 kOhm and 1 uF a section, a 1 V step, 1 s, rtol 1e-6; an empty cache; each size in a process of its own.
Imports are excluded. The last node, and six more along the ladder, are checked against the closed form.
``--full`` adds 100,000 sections (1.2 million equations; 2 minutes, 5 GB).

rumoca, a Modelica compiler in Rust, gets the ladders of up to 100 sections as we export them (1,000 were seen to take
it 71 s), and the rig of `rig_race`.
"""

from __future__ import annotations

import argparse
import json
import math
import tempfile
import time
from typing import Any

from benchmarks import rig_race
from benchmarks.measure import fresh_json, load_average, parser, peak_mb, show
from benchmarks.rumoca_run import in_rumoca, missing

SIZES = (10, 100, 1000, 10000)
STOP_TIME = 1.0  # [s]
RTOL = 1e-6
REQUIRED = {1000: "1.5 s, 300 MB", 10000: "15 s, 2000 MB"}  # translation and simulation together
FULL = 100_000
RUMOCA_UP_TO = 100


def checked_nodes(n: int) -> list[int]:
    """Return the nodes held against the closed form: seven, evenly spread in the logarithm."""
    return sorted({round(n ** (k / 6)) for k in range(7)})


def measure_one(n: int) -> dict[str, Any]:
    """Translate and simulate the ladder of n sections here; return the figures of this process."""
    import casadi  # noqa: F401  imported before the clock starts
    import scipy.sparse  # noqa: F401
    import sksundae.ida  # noqa: F401

    from arthur_acausal import translate
    from benchmarks.ladder import Ladder

    begin = time.perf_counter()
    translation = translate(Ladder(n=n))
    translated = time.perf_counter()
    solution = translation.simulate(STOP_TIME, tolerance=RTOL)
    simulated = time.perf_counter()
    peak = peak_mb()
    voltages = {node: solution[path_of(node)] for node in checked_nodes(n)}
    return {
        "n": n,
        "equations": translation.report.equations,
        "translate_s": translated - begin,
        "simulate_s": simulated - translated,
        "total_s": simulated - begin,
        "peak_mb": peak,
        **errors(n, solution.t, voltages),
    }


def path_of(node: int) -> str:
    """Return the path of a node's voltage."""
    return f"capacitors[{node - 1}].v"


def errors(n: int, t: Any, voltages: dict[int, Any]) -> dict[str, float]:
    """Return the error [V] of the last node, and the largest one."""
    import numpy as np

    from benchmarks.ladder import exact_voltage

    t = np.asarray(t)
    found = {k: float(np.max(np.abs(v - exact_voltage(n, k, t)))) for k, v in voltages.items()}
    return {"last_node_error_V": found[n], "error_V": max(found.values())}


def rumoca_one(n: int) -> dict[str, Any]:
    """Export the ladder of n sections and let rumoca translate and simulate it in a process of its own."""
    from arthur_acausal import translate
    from benchmarks.ladder import Ladder

    translation = translate(Ladder(n=n), compile="never")
    nodes = checked_nodes(n)
    found = in_rumoca(
        translation.to_modelica(stop_time=STOP_TIME), STOP_TIME, RTOL, [path_of(node) for node in nodes]
    )
    return {
        "n": n,
        "equations": translation.report.equations,
        "translate_s": found["translate_s"],
        "simulate_s": found["simulate_s"],
        "total_s": found["translate_s"] + found["simulate_s"],
        "peak_mb": found["peak_mb"],
        **errors(n, found["t"], {node: found["values"][path_of(node)] for node in nodes}),
    }


def measure(sizes: list[int]) -> dict[str, Any]:
    """Measure each size in a fresh process with an empty cache; then rumoca, and the rig."""
    ladder = []
    for n in sizes:
        with tempfile.TemporaryDirectory() as cache:
            command = ["-m", "benchmarks.scale", "--one", str(n)]
            ladder.append(fresh_json(command, {"ARTHUR_CACHE_DIR": cache}))
    why = missing()
    return {
        "ladder": ladder,
        "growth_exponent": growth({row["n"]: row["total_s"] for row in ladder}),
        "rumoca": None if why else [rumoca_one(n) for n in sizes if n <= RUMOCA_UP_TO],
        "rumoca_why": why or None,
        "hyd12": rig_race.in_fresh_process(),
        "load_average": load_average(),
    }


def growth(seconds: dict[int, float]) -> float | None:
    """Return the exponent with which the time grows from 1,000 to 10,000 sections."""
    if not {1000, 10000} <= seconds.keys():
        return None
    return math.log10(seconds[10000] / seconds[1000])


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
    command_line.add_argument("--full", action="store_true", help=f"{FULL} sections as well")
    command_line.add_argument("--one", type=int, metavar="N", help="one size, in this process, as JSON")
    arguments = command_line.parse_args()
    if arguments.one:
        print(json.dumps(measure_one(arguments.one)))
        return
    figures = measure(arguments.sizes + ([FULL] if arguments.full else []))
    if arguments.json:
        print(json.dumps(figures))
    else:
        show_all(figures)


def show_all(figures: dict[str, Any]) -> None:
    """Print the figures as tables."""
    rows = [
        [who, str(row["n"]), str(row["equations"])]
        + [f"{row[key]:.2f}" for key in ("translate_s", "simulate_s", "total_s")]
        + [f"{row['peak_mb']:.0f}", f"{row['error_V']:.1e}", limits.get(row["n"], "")]
        for who, ladder, limits in (("ours", figures["ladder"], REQUIRED), ("rumoca", figures["rumoca"], {}))
        for row in ladder or []
    ]
    heads = ["", "sections", "equations", "translate, s", "simulate, s", "both, s", "peak, MB", "error, V"]
    show("RC ladder, 1 s at rtol 1e-6, empty cache, a process each", [*heads, "required"], rows)
    if figures["growth_exponent"] is not None:
        print(f"time grows with the exponent {figures['growth_exponent']:.2f} (required 1.15)")
    if figures["rumoca_why"]:
        print(f"rumoca: {figures['rumoca_why']}")
    rig, shown = figures["hyd12"], []
    for who, prefix, limit in (("ours", "", "1 s, 0.25 s"), ("rumoca", "rumoca_", "")):
        if rig[f"{prefix}translate_s"] is not None:
            times = [f"{rig[prefix + key]:.2f}" for key in ("translate_s", "simulate_s")]
            shown.append([who, *times, limit])
    title = f"Servo-hydraulic rig, {rig['states']} states, {rig['steps']} steps, 1 s at rtol 1e-6"
    show(title, ["", "translate, s", "simulate, s", "required"], shown)
    if rig["difference"] is not None:
        print(f"largest difference between both, over a variable's range: {rig['difference']:.1e}")


if __name__ == "__main__":
    main()
