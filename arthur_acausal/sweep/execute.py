"""One run, the same on whatever worker: nothing of an earlier run is left in it."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from time import perf_counter, process_time
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.errors import ArthurError
from arthur_acausal.sweep.job import Job, Signal, StateSet, Values

if TYPE_CHECKING:
    from arthur_acausal.codegen.compiled import CompiledDAE
    from arthur_acausal.result.solution import Solution
    from arthur_acausal.solve.options import SolverOptions

GOOD = ("ok", "terminated")  # of a run's status
KEPT_SYSTEMS = 8  # that a worker has loaded at a time
COUNTS = ("steps", "rejected_steps", "residual_evaluations", "jacobian_evaluations", "events")


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a run.

    ``status``: "ok", "terminated" (the model ended it), "failed", "timeout" or "crashed"; ``error``: the message;
    ``notes``: what the solver tells besides, such as start values that nothing uses; ``trajectory`` (times,
    variables), NaN where it did not get to; seconds of wall and of CPU. ``wants``: the set of states for which the run
    needs a system that its job does not have; there is nothing else then.
    """

    status: str
    error: str = ""
    end_time: float = math.nan
    reductions: Mapping[str, float] = field(default_factory=dict)
    statistics: Mapping[str, int] = field(default_factory=dict)
    trajectory: NDArray[np.float64] | None = None
    notes: str = ""
    wall_s: float = 0.0
    cpu_s: float = 0.0
    engine: str = "ida"
    platform: str = ""
    wants: StateSet | None = None


class _Described:
    """Stands for a model that is not here: what `describe_run` asks of it."""

    def __init__(self, description: str, terms: Mapping[str, Any]) -> None:
        self.__doc__, self._terms = description, terms

    def audit_terms(self) -> Mapping[str, Any]:
        return self._terms


class _WantedError(Exception):
    """A run needs the system for a set of states that is not here."""

    def __init__(self, states: StateSet) -> None:
        super().__init__("another set of states")
        self.states = states


class _TimeUp(KeyboardInterrupt):
    """Ends a run as Ctrl-C does: what was computed is kept."""


def execute(job: Job, values: Values, timeout: float | None = None) -> Outcome:
    """Simulate once and reduce. Never raises for what a run may do wrong: that is an outcome, too.

    ``timeout``: s of wall time, looked at about ten times a second.
    """
    system_of(job)  # so that no run's time is that of loading
    wall, cpu = perf_counter(), process_time()

    def watch(_: float) -> None:
        if timeout is not None and perf_counter() - wall > timeout:
            raise _TimeUp

    try:
        solution, status, error = _simulate(job, values, watch)
        if status == "timeout":
            error = f"stopped after {timeout:g} s of wall time"
        outcome = reduced(job, solution, status, error)
    except _WantedError as wanted:
        return Outcome("unfinished", wants=wanted.states)
    except ArthurError as failed:
        outcome = Outcome("failed", str(failed))
    except Exception as failed:  # of the user's own functions
        outcome = Outcome("failed", f"{type(failed).__name__}: {failed}")
    return _timed(outcome, perf_counter() - wall, process_time() - cpu)


def _timed(outcome: Outcome, wall_s: float, cpu_s: float) -> Outcome:
    from arthur_acausal.codegen.cache import make_key

    return replace(outcome, wall_s=wall_s, cpu_s=cpu_s, platform=make_key()[:12])


def _simulate(job: Job, values: Values, watch: Callable[[float], None]) -> tuple[Solution | None, str, str]:
    from arthur_acausal.errors import SimulationError
    from arthur_acausal.result.simulated import Interrupted, run

    loaded = system_of(job)
    inputs = {path: _signal(value) for path, value in {**job.inputs, **values.inputs}.items()}
    try:
        solution = run(
            loaded.dae,
            described(job),
            start_time=job.start_time,
            stop_time=job.stop_time,
            options=options_of(job),
            parameters={**job.parameters, **values.parameters},
            inputs=inputs,
            start={**job.start, **values.start},
            progress=watch,
            variant=loaded.variant,
        )
    except SimulationError as error:
        return error.solution, "failed", str(error)
    except Interrupted as stopped:
        return stopped.solution, "timeout", ""
    if solution.run.status == "terminated":
        return solution, "terminated", solution.run.message
    return solution, "ok", ""


def options_of(job: Job) -> SolverOptions:
    """Return the solver's options."""
    from arthur_acausal.solve.options import SolverOptions

    return SolverOptions(rtol=job.tolerance, output_interval=job.resolution)


def described(job: Job) -> object:
    """Return what stands for the model, which is not here."""
    return _Described(job.description, job.audit)


def _signal(value: float | Signal) -> Any:
    from arthur_acausal.solve.table import Table

    if isinstance(value, Signal):
        return Table(np.array(value.times), np.array(value.values), source=value.source)
    return value


@dataclass(frozen=True, slots=True)
class _Loaded:
    """A job's compiled systems."""

    dae: CompiledDAE
    others: Mapping[StateSet, CompiledDAE]

    def variant(self, dummies: frozenset[int], continuation: bool) -> CompiledDAE:
        """Return the system for another set of states."""
        if (dummies, continuation) not in self.others:
            raise _WantedError((dummies, continuation))
        return self.others[dummies, continuation]


_LOADED: dict[str, _Loaded] = {}


def system_of(job: Job) -> _Loaded:
    """Return the job's compiled systems; each process loads them once."""
    import arthur_acausal.result.simulated  # noqa: F401  # loaded here, not in the first run
    from arthur_acausal.codegen.portable import from_bytes
    from arthur_acausal.solve.ida import load_ida

    if job.digest not in _LOADED:
        for folder in job.folders:
            if folder not in sys.path:
                sys.path.append(folder)
        while len(_LOADED) >= KEPT_SYSTEMS:
            del _LOADED[next(iter(_LOADED))]
        others = {states: from_bytes(data, trusted=job.trusted) for states, data in job.others.items()}
        _LOADED[job.digest] = _Loaded(from_bytes(job.system, trusted=job.trusted), others)
        load_ida()
    return _LOADED[job.digest]


def reduced(job: Job, solution: Solution | None, status: str, error: str) -> Outcome:
    """Return what is kept of a solution."""
    if solution is None or not solution.t.size:
        return Outcome(status, error)
    columns: dict[str, float] = {}
    trajectory = None
    if status in GOOD:
        for reduction in job.reductions:
            columns |= reduction.of(solution)
    if job.variables:
        trajectory = on_grid(job.grid, solution, job.variables)
    counts = {name: int(getattr(solution.statistics, name)) for name in COUNTS}
    notes = "; ".join(solution.statistics.messages)
    return Outcome(status, error, float(solution.t[-1]), columns, counts, trajectory, notes)


def on_grid(grid: NDArray[np.float64], solution: Solution, paths: tuple[str, ...]) -> NDArray[np.float64]:
    """Return the values (times, variables) on a grid, NaN behind the solution's end; at an event those after it."""
    reached = grid <= solution.t[-1] * (1.0 + 1e-12)
    values = np.full((grid.size, len(paths)), np.nan)
    inside = np.clip(grid[reached], solution.t[0], solution.t[-1])
    for column, path in enumerate(paths):
        values[reached, column] = solution.at(inside, path)
    return values
