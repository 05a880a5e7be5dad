"""One simulation of a compiled model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np

from arthur_acausal.codegen.threads import one_thread
from arthur_acausal.errors import ArthurError, UsageError
from arthur_acausal.solve.callbacks import Progress
from arthur_acausal.solve.failure import SolverFailure, SolverInterrupted
from arthur_acausal.solve.hybrid import HybridRun
from arthur_acausal.solve.inputs import Input
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.protocol import DAE, FloatArray
from arthur_acausal.solve.trajectory import Trajectory


@one_thread(scipy=True)
def simulate(
    dae: DAE,
    *,
    stop_time: float,
    start_time: float = 0.0,
    options: SolverOptions | None = None,
    inputs: Mapping[str, Input] | None = None,
    parameters: Mapping[str, Any] | None = None,
    start: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
    grid: FloatArray | None = None,
    begin: Trajectory | None = None,
) -> Trajectory:
    """Simulate a compiled model from start_time to stop_time, s.

    Parameters
    ----------
    inputs : external inputs by path: constants, functions of time, tables; the rest keep their defaults.
    parameters : parameter values by path.
    start : start values by path that override the model's.
    progress : called with the present time about ten times a second.
    grid : output times, both ends included; by default as the options say.
    begin : consistent values at start_time, known already, as its last row; then `start` has no say.

    Raises
    ------
    InitializationError : no consistent values at start_time.
    SolverFailure : the integration stopped early; it holds what was computed.
    SolverInterrupted : Ctrl-C; it holds what was computed.
    UsageError : an argument cannot be used.
    """
    check_times(start_time, stop_time)
    chosen, first, last = options or SolverOptions(), float(start_time), float(stop_time)
    run = HybridRun(dae, first, last, chosen, inputs or {}, parameters, start, progress, grid, begin)
    run.initialize()
    with keeping(run):
        return run.integrate()


def initial_point(
    dae: DAE,
    *,
    stop_time: float,
    start_time: float = 0.0,
    options: SolverOptions | None = None,
    inputs: Mapping[str, Input] | None = None,
    parameters: Mapping[str, Any] | None = None,
    start: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> Trajectory:
    """Initialise only: the consistent values at start_time, as a trajectory of one row; arguments as simulate."""
    check_times(start_time, stop_time)
    chosen, begin, end = options or SolverOptions(), float(start_time), float(stop_time)
    run = HybridRun(dae, begin, end, chosen, inputs or {}, parameters, start, progress)
    run.initialize()
    return run.trajectory("finished", "")


def check_times(start_time: float, stop_time: float) -> None:
    if not (np.isfinite(start_time) and np.isfinite(stop_time) and stop_time > start_time):
        raise UsageError(f"stop_time {stop_time} is not a finite time after start_time {start_time}")


@contextmanager
def keeping(run: HybridRun) -> Iterator[None]:
    """Let what ends an integration early hold what was computed: SolverFailure, or SolverInterrupted for Ctrl-C."""
    try:
        yield
    except ArthurError as error:
        failure = error if isinstance(error, SolverFailure) else _as_failure(error)
        failure.trajectory = run.trajectory("failed", str(failure))
        raise failure from None
    except KeyboardInterrupt:
        raise SolverInterrupted(run.trajectory("interrupted", "interrupted")) from None


def _as_failure(error: ArthurError) -> SolverFailure:
    """An error at an event, as the end of the run that it is."""
    return SolverFailure(
        error.message,
        path=error.path,
        equation=error.equation,
        where=error.where,
        cause=error.cause,
        remedy=error.remedy,
    )
