"""How long the pump's predictive laws compute beside their sample period: ``python -m benchmarks.prediction [--json]``.

The robot trots; each call of the law is timed within that run: forecast, matrices (made anew where the supply's
capacitance is a new one to two digits) and DAQP. ``cpu`` is the time of the thread, which other processes do not
lengthen; ``wall`` is what a clock shows on this machine at this load.
"""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import SolverOptions, translate
from arthur_acausal.models.arthur.power_unit import PumpLaw
from arthur_acausal.models.arthur.predictive_control import Predictive
from arthur_acausal.models.arthur.quadruped import Quadruped
from arthur_acausal.models.arthur.quadruped_options import QuadrupedOptions
from benchmarks.measure import load_average, parser, show

FloatArray = NDArray[np.float64]

LAWS: tuple[PumpLaw, ...] = ("predictive", "predictive pressure")
MS = 1e3


@contextmanager
def timed() -> Iterator[list[tuple[float, float]]]:
    """Collect CPU and wall time [s] of each call of a predictive law."""
    taken: list[tuple[float, float]] = []
    call = Predictive.__call__

    def measured(self: Predictive, t: float, inputs: FloatArray) -> FloatArray:
        cpu, wall = time.thread_time(), time.perf_counter()
        voltage = call(self, t, inputs)
        taken.append((time.thread_time() - cpu, time.perf_counter() - wall))
        return voltage

    Predictive.__call__ = measured  # type: ignore[method-assign]
    try:
        yield taken
    finally:
        Predictive.__call__ = call  # type: ignore[method-assign]


def measure(law: PumpLaw, duration: float) -> dict[str, float]:
    """Return median and 99th percentile of a law's times [ms], and its period [ms]."""
    model = translate(Quadruped(gait="trot", v_x=0.5, seed=1, options=QuadrupedOptions(pump=law)))
    with timed() as taken:
        solution = model.simulate(duration, options=SolverOptions(rtol=1e-3, output_interval=0.01))
    times = MS * np.array(taken)
    found = {"calls": float(len(times)), "period_ms": MS * solution.initial("unit.control.period")}
    for k, kind in enumerate(("cpu", "wall")):
        found[f"{kind}_median_ms"] = float(np.median(times[:, k]))
        found[f"{kind}_p99_ms"] = float(np.percentile(times[:, k], 99))
    return found


def main() -> None:
    """Measure and print."""
    command_line = parser(__doc__ or "")
    command_line.add_argument("--time", type=float, default=3.0, help="simulated time [s]")
    options = command_line.parse_args()
    results: dict[str, Any] = {law: measure(law, options.time) for law in LAWS}
    if options.json:
        print(json.dumps(results | {"load_average": load_average()}))
        return
    heads = [
        "law",
        "period ms",
        *(f"{kind} {what} ms" for kind in ("cpu", "wall") for what in ("median", "p99")),
    ]
    rows = [[law, *(f"{r[key]:.2f}" for key in r if key != "calls")] for law, r in results.items()]
    show("Solve time of the pump's predictive laws", heads, rows)


if __name__ == "__main__":
    main()
