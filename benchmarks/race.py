"""One simulated second of the powertrain: ours against the same equations by hand in CasADi's own IDAS.

Same process, turn by turn, so that a busy machine slows both alike. rtol, the vector of absolute tolerances,
the output grid and the inputs are the same; both are held against one run at a tight tolerance. Building the
integrators is no part of the times. IDAS evaluates the equations in CasADi's virtual machine, as `integrator`
does by default, and again compiled by the C compiler (`jit`), which is given besides.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import casadi
import numpy as np

from arthur_acausal import Solution, Translation
from benchmarks.measure import Times, repeat
from benchmarks.powertrain_byhand import Array, Flat

# symbolicqr took four times as long, at every tolerance; ma27 and mumps need more than CasADi's wheel.
SOLVERS = ("csparse", "qr", "lapacklu", "lapackqr")
ATOL_OVER_RTOL = 0.01  # of a variable's nominal value: our default
REFERENCE_RTOL = 1e-10


@dataclass(frozen=True, slots=True)
class Error:
    """Deviation from the reference over each variable's range: the worst of all, and the root mean square."""

    worst: float
    path: str
    rms: float


def with_nominals_of(translation: Translation, flat: Flat) -> Flat:
    """Return the equations with our model's nominal values, so that the absolute tolerances are the same."""
    dae = translation.dae
    nominal = dict(zip(dae.y_paths, dae.attributes(dae.parameter_vector()).nominal, strict=True))
    return replace(
        flat,
        x_nominal=np.array([nominal[path] for path in flat.paths]),
        z_nominal=np.array([nominal[flat.z_path]]),
    )


class Idas:
    """The hand-flattened equations as a CasADi `idas` integrator on a grid of times [s]."""

    def __init__(
        self, flat: Flat, grid: Array, rtol: float, solver: str = "csparse", jit: bool = False
    ) -> None:
        nominal = np.concatenate([flat.x_nominal, flat.z_nominal])
        options: dict[str, Any] = {
            "reltol": rtol,
            "abstolv": list(ATOL_OVER_RTOL * rtol * nominal),
            "linear_solver": solver,
            "max_num_steps": 10_000_000,
        }
        if jit:
            options |= {"jit": True, "compiler": "shell", "jit_options": {"flags": ["-O2"]}}
        dae = {"t": flat.t, "x": flat.x, "z": flat.z, "ode": flat.ode, "alg": flat.alg}
        self._integrator = casadi.integrator("idas", "idas", dae, grid[0], grid[1:], options)
        self._start = {"x0": flat.x0, "z0": flat.z0}
        self._x0 = flat.x0

    def run(self) -> Array:
        """Return the states at the grid's times, (number of states, number of times)."""
        after = np.asarray(self._integrator(**self._start)["xf"])
        return np.hstack([self._x0[:, None], after])

    @property
    def steps(self) -> int:
        """Steps of the last run."""
        return int(self._integrator.stats()["nsteps"])


def fastest(flat: Flat, grid: Array, rtol: float) -> tuple[str, Idas]:
    """Return the linear solver, and the integrator with it, that is quickest at this tolerance."""
    tried = {}
    for solver in SOLVERS:
        integrator = Idas(flat, grid, rtol, solver)
        tried[solver] = (repeat(integrator.run, 2).best, integrator)
    best = min(tried, key=lambda solver: tried[solver][0])
    return best, tried[best][1]


def states_on(grid: Array, solution: Solution, paths: Sequence[str]) -> Array:
    """Return our variables at the grid's times; of two rows at an event, the one after it."""
    rows = np.searchsorted(solution.t, grid + 1e-12 * grid[-1], side="right") - 1
    return np.stack([solution[path][rows] for path in paths])


def error(states: Array, reference: Array, paths: Sequence[str]) -> Error:
    """Compare trajectories of (number of states, number of times)."""
    span = np.ptp(reference, axis=1)
    relative = np.abs(states - reference) / np.where(span > 0, span, 1.0)[:, None]
    worst = relative.max(axis=1)
    index = int(np.argmax(worst))
    return Error(float(worst[index]), paths[index], float(np.sqrt(np.mean(relative**2))))


def alternate(runs: Sequence[Any], times: int) -> list[Times]:
    """Time each of the functions `times` times, in turns."""
    clocks: list[list[float]] = [[] for _ in runs]
    for _ in range(times):
        for clock, run in zip(clocks, runs, strict=True):
            begin = time.perf_counter()
            run()
            clock.append(time.perf_counter() - begin)
    return [Times(tuple(clock)) for clock in clocks]
