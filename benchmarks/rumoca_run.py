"""A Modelica model in rumoca, a compiler in Rust: times, memory, and some variables over time.

    python -m benchmarks.rumoca_run FILE.mo --stop-time 1 --rtol 1e-6 --repeat 1 --paths PATH ...

One JSON object. Run in a process of its own, so that the peak memory is rumoca's.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import importlib.util
import json
import tempfile
import time
from pathlib import Path
from typing import Any

from benchmarks.measure import fresh_json, peak_mb, repeat

ATOL_OVER_RTOL = 0.01  # our default for a nominal value of 1; rumoca has one tolerance for all variables
POINTS = 500


def missing() -> str:
    """Return why rumoca cannot run, or ""."""
    if importlib.util.find_spec("rumoca") is None:
        return "the package rumoca is not installed (it is in the extra 'test')"
    return ""


def in_rumoca(text: str, stop_time: float, rtol: float, paths: list[str], times: int = 1) -> dict[str, Any]:
    """Return the figures of a model's text, in a fresh process: {translate_s, simulate_s, peak_mb, t, values}."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "model.mo"
        file.write_text(text, encoding="utf-8")
        options = ["--stop-time", str(stop_time), "--rtol", str(rtol), "--repeat", str(times)]
        return fresh_json(["-m", "benchmarks.rumoca_run", str(file), *options, "--paths", *paths])


def measure(text: str, stop_time: float, rtol: float, paths: list[str], times: int) -> dict[str, Any]:
    """Translate and simulate here; the least time of ``times`` simulations."""
    import numpy as np
    import rumoca

    from arthur_acausal.exchange.names import identifier

    begin = time.perf_counter()
    model = rumoca.Session().loads(text, model=text.split(maxsplit=2)[1])
    translated = time.perf_counter() - begin
    config = rumoca.SimConfig(rtol=rtol, atol=ATOL_OVER_RTOL * rtol)
    results: list[Any] = []
    taken = repeat(
        lambda: results.append(model.simulate(t=(0.0, stop_time), dt=stop_time / POINTS, config=config)),
        times,
    )
    return {
        "version": importlib.metadata.version("rumoca"),
        "translate_s": translated,
        "simulate_s": taken.best,
        "peak_mb": peak_mb(),
        "t": np.asarray(results[-1].time).tolist(),
        "values": {path: np.asarray(results[-1][identifier(path)]).tolist() for path in paths},
    }


def main() -> None:
    """Measure and print."""
    command_line = argparse.ArgumentParser(description="A Modelica model in rumoca.")
    command_line.add_argument("file", type=Path)
    command_line.add_argument("--stop-time", type=float, required=True, help="s")
    command_line.add_argument("--rtol", type=float, required=True)
    command_line.add_argument("--repeat", type=int, default=1)
    command_line.add_argument("--paths", nargs="*", default=[])
    given = command_line.parse_args()
    text = given.file.read_text(encoding="utf-8")
    print(json.dumps(measure(text, given.stop_time, given.rtol, given.paths, given.repeat)))


if __name__ == "__main__":
    main()
