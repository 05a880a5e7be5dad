"""One simulation: initialise, integrate from event to event, collect."""

from __future__ import annotations

from collections.abc import Mapping
from time import perf_counter
from typing import Any

import numpy as np

from arthur_acausal.errors import UsageError
from arthur_acausal.solve.callbacks import Monitor, Progress, Roots
from arthur_acausal.solve.failure import SolverFailure, SolverInterrupted
from arthur_acausal.solve.ida import Ida, Stretch
from arthur_acausal.solve.initialize import initialize
from arthur_acausal.solve.inputs import Input, Inputs
from arthur_acausal.solve.modes import Modes
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.protocol import DAE, FloatArray
from arthur_acausal.solve.statistics import Statistics
from arthur_acausal.solve.trajectory import Event, Recorder, Status, Trajectory


def simulate(
    dae: DAE,
    *,
    stop_time: float,
    start_time: float = 0.0,
    options: SolverOptions | None = None,
    inputs: Mapping[str, Input] | None = None,
    parameters: Mapping[str, Any] | None = None,
    start: Mapping[str, float] | None = None,
    progress: Progress | None = None,
) -> Trajectory:
    """Simulate a compiled model from start_time to stop_time, s.

    Parameters
    ----------
    inputs : external inputs by path: constants, functions of time, tables; the rest keep their defaults.
    parameters : parameter values by path.
    start : start values by path that override the model's; a state given here keeps its value.
    progress : called with the present time about ten times a second.

    Raises
    ------
    InitializationError : no consistent values at start_time.
    SolverFailure : the integration stopped early; it holds what was computed.
    SolverInterrupted : Ctrl-C; it holds what was computed.
    UsageError : an argument cannot be used.
    """
    if not (np.isfinite(start_time) and np.isfinite(stop_time) and stop_time > start_time):
        raise UsageError(f"stop_time {stop_time} is not a finite time after start_time {start_time}")
    run = _Run(dae, start_time, stop_time, options or SolverOptions(), inputs or {}, parameters, progress)
    run.initialize(start or {})
    run.integrate()
    return run.trajectory("finished", "")


class _Run:
    """The state of one simulation between its events."""

    def __init__(
        self,
        dae: DAE,
        start_time: float,
        stop_time: float,
        options: SolverOptions,
        inputs: Mapping[str, Input],
        parameters: Mapping[str, Any] | None,
        progress: Progress | None,
    ) -> None:
        self.begun = perf_counter()
        self.dae, self.options = dae, options
        self.start_time, self.stop_time = float(start_time), float(stop_time)
        self.evaluator = dae.evaluator()
        self.p = dae.parameter_vector(parameters)
        self.evaluator.p[:] = self.p
        self.evaluator.t[0] = start_time
        self.attributes = dae.attributes(self.p)
        self.inputs = Inputs(
            dae.u_paths, dae.u_default, inputs, self.evaluator.u, self.start_time, self.stop_time
        )
        self.statistics = Statistics(unknowns=dae.n)
        self.monitor = Monitor(options.max_steps, progress)
        self.modes = Modes(dae, self.evaluator)
        self.roots = Roots(dae, self.evaluator, self.inputs, self.monitor)
        self.recorder = Recorder()
        self.events: list[Event] = []
        self.grid = options.grid(self.start_time, self.stop_time)

    def initialize(self, start: Mapping[str, float]) -> None:
        done = initialize(self.dae, self.evaluator, self.attributes, self.modes, self.options, start)
        self.statistics.initial_iterations = done.iterations
        self.statistics.messages += done.messages
        self.statistics.initialize_s = perf_counter() - self.begun
        self._record_point(self.start_time)

    def integrate(self) -> None:
        options, evaluator = self.options, self.evaluator
        atol = options.absolute_tolerances(list(self.dae.y_paths), self.attributes.nominal)
        engine = Ida(
            self.dae, evaluator, self.inputs, self.roots, self.monitor, atol, options, options.max_step or 0.0
        )
        self.statistics.linear_solver = engine.linear_solver
        t = self.start_time
        while t < self.stop_time:
            end = min(self.stop_time, self.inputs.next_jump(t))
            times = np.concatenate([[t], self.grid[(self.grid > t) & (self.grid < end)], [end]])
            before = perf_counter()
            stretch = engine.run(
                times, evaluator.y.copy(), evaluator.yp.copy(), options.first_step, options.store_steps
            )
            self.statistics.integrate_s += perf_counter() - before
            self._record(stretch)
            if stretch.end == "halted" or stretch.end == "failed":
                self._stop(stretch)
            t = float(stretch.t[-1])

    def _stop(self, stretch: Stretch) -> None:
        if self.monitor.halted == "interrupted":
            raise SolverInterrupted(self.trajectory("interrupted", "interrupted"))
        error = SolverFailure(f"integration failed: {stretch.message}")
        error.trajectory = self.trajectory("failed", str(error))
        raise error

    def _record(self, stretch: Stretch) -> None:
        evaluator = self.evaluator
        u = self.inputs.sample(stretch.t)
        self.recorder.add(stretch.t, stretch.y, stretch.yp, u, evaluator.z.copy(), evaluator.m.copy())

    def _record_point(self, t: float) -> None:
        ev = self.evaluator
        self.recorder.add(
            np.array([t]), ev.y[None].copy(), ev.yp[None].copy(), ev.u.copy(), ev.z.copy(), ev.m.copy()
        )

    def trajectory(self, status: Status, message: str) -> Trajectory:
        before = perf_counter()
        columns: tuple[FloatArray, ...] = self.recorder.columns()
        s, m = self.statistics, self.monitor
        s.steps, s.rejected_steps, s.residual_evaluations = m.steps, m.rejected, m.residuals
        s.jacobian_evaluations, s.root_evaluations, s.non_finite_residuals = (
            m.jacobians,
            m.roots,
            m.non_finite,
        )
        s.output_s += perf_counter() - before
        s.total_s = perf_counter() - self.begun
        return Trajectory(
            *columns,
            p=self.p,
            start_time=self.start_time,
            stop_time=self.stop_time,
            options=self.options,
            events=self.events,
            statistics=s,
            status=status,
            message=message,
        )
