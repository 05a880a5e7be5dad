"""The hybrid loop: integrate to the next event, handle it, start anew, until the end."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from time import perf_counter
from typing import Any

import numpy as np

from arthur_acausal.errors import SimulationError
from arthur_acausal.solve.accumulation import Accumulation
from arthur_acausal.solve.callbacks import Monitor, Progress, Roots
from arthur_acausal.solve.diagnosis import listed
from arthur_acausal.solve.events import EventIteration
from arthur_acausal.solve.failure import integration_failure, suspect, too_many_steps
from arthur_acausal.solve.ida import ERROR_TEST_FAILED, Ida, Stretch, load_ida
from arthur_acausal.solve.initialize import adopt, initialize
from arthur_acausal.solve.inputs import Input, Inputs
from arthur_acausal.solve.modes import Modes
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.protocol import DAE, Evaluator, FloatArray
from arthur_acausal.solve.sampled import Samples
from arthur_acausal.solve.schedule import Schedule, affine_relations
from arthur_acausal.solve.statistics import Statistics
from arthur_acausal.solve.tolerance import Tolerances
from arthur_acausal.solve.trajectory import Event, Recorder, Status, Trajectory

# Events closer together than this, relative to time and step, are one. IDA finds a root to within 100 units of
# rounding of the same sum, 2e-14 of it; a bounce at a fiftieth of the speed still counts as leaving at once.
RESOLUTION = 1e-12
# Part of the tolerance that the first step after a start may use. It is of order 1; at 1e-5 the bounces of a ball
# stay within 1e-9 s at rtol 1e-6, and IDA, which doubles its step at first, needs eight steps more than at best.
FIRST_STEP_ERROR = 1e-5
FIRST_STEP_PART = 0.1  # the first step is no longer than this part of the way to the next known event,
FIRST_STEP_LEAST = 1e-14  # and no shorter than this part of the time: it would be lost in rounding
# Where y'' happens to be zero, that is far too long a step, and IDA gives up when it has cut it by so much.
FIRST_STEP_CUT = 0.25**10


class HybridRun:
    """The state of one simulation; its present values are those in the evaluator."""

    def __init__(
        self,
        dae: DAE,
        start_time: float,
        stop_time: float,
        options: SolverOptions,
        inputs: Mapping[str, Input],
        parameters: Mapping[str, Any] | None,
        start: Mapping[str, Any] | None,
        progress: Progress | None,
        grid: FloatArray | None = None,
        begin: Trajectory | None = None,
    ) -> None:
        self._begun = perf_counter()
        load_ida()  # here, so that the time of the other phases does not depend on what was loaded before
        loaded = perf_counter() - self._begun
        self._dae, self._options = dae, options
        self._start, self._stop = start_time, stop_time
        self._grid = options.grid(start_time, stop_time) if grid is None else grid
        self._evaluator = evaluator = dae.evaluator()
        self._p = dae.parameter_vector(parameters, start)
        evaluator.p[:] = self._p
        evaluator.t[0] = start_time
        self._attributes = dae.attributes(self._p)
        self._inputs = Inputs(dae.u_paths, dae.u_default, inputs, evaluator.u, start_time, stop_time)
        self._statistics = Statistics(unknowns=dae.n, load_s=loaded)
        self._monitor = Monitor(options.max_steps, progress)
        self._modes = Modes(dae, evaluator)
        evaluator.z[:] = evaluator.zp[:] = self._attributes.z_start
        scheduled = affine_relations(dae, evaluator, start_time, stop_time)
        self._schedule = Schedule(evaluator, np.flatnonzero(scheduled))
        self._roots = Roots(dae, evaluator, self._inputs, self._monitor, np.flatnonzero(~scheduled))
        self._iteration = EventIteration(dae, evaluator, self._attributes, self._modes, options, scheduled)
        self._samples = Samples(dae, evaluator, start_time)
        self._accumulation = Accumulation(stop_time - start_time, options)
        self._recorder = Recorder()
        self._begin, self._given = begin, start
        self._events: list[Event] = []
        self._ended: tuple[Status, str] | None = None
        self._stepping = self._affected = False
        self._until = stop_time
        self._starts = 0

    def initialize(self) -> None:
        """Find consistent values at the start, or take those that are given."""
        ignored = self._dae.ignored_starts(self._given)
        if ignored:
            self._statistics.messages.append(f"start values that nothing uses: {listed(ignored, '; ')}")
        if self._begin is not None:
            done = adopt(self._begin, self._evaluator, self._modes)
        else:
            done = initialize(self._dae, self._evaluator, self._attributes, self._modes, self._options)
        self._statistics.initial_iterations = done.iterations
        self._statistics.initial_method = done.method
        self._statistics.messages += done.messages
        if done.terminated is not None:
            self._ended = ("terminated", done.terminated)
        self._record_point()
        self._statistics.initialize_s = perf_counter() - self._begun - self._statistics.load_s

    def integrate(self) -> Trajectory:
        """Run to the end."""
        self.depart()
        while self._ended is None:
            self._advance()
        return self.trajectory(*self._ended)

    def depart(self) -> None:
        """Make ready to leave the start."""
        self._prepare()
        if self._evaluator.external is not None:
            self._evaluator.external.exact = False
        if self._ended is None:
            self._event({})  # what is true just after the start but not at it

    def advance(self, until: float) -> None:
        """Integrate up to a time, s, unless the run ends before."""
        self._until = min(until, self._stop)
        while self._ended is None and self._until - self._t > self._resolution:
            self._advance()

    def impose(self, inputs: Mapping[int, float]) -> None:
        """Let inputs that do not vary by themselves jump to other values at the present time."""
        u = self._evaluator.u
        changed = [index for index, value in inputs.items() if u[index] != value]
        for index in changed:
            u[index] = inputs[index]
        if changed and self._ended is None:
            self._event({}, jump=True)

    def _prepare(self) -> None:
        dae, options = self._dae, self._options
        self._tolerances = Tolerances(dae, self._evaluator, self._attributes, options)
        self._monitor.watch = self._tolerances.widen if self._tolerances.adaptive else None
        max_step = options.max_step or 0.0
        if not dae.n and not max_step:  # nothing else would make IDA look for events often enough
            max_step = float(self._grid[1] - self._grid[0])
        self._engine = Ida(
            dae,
            self._evaluator,
            self._inputs,
            self._roots,
            self._monitor,
            self._tolerances.atol,
            options,
            max_step,
        )
        self._statistics.linear_solver = self._engine.linear_solver

    @property
    def _t(self) -> float:
        return float(self._evaluator.t[0])

    @property
    def _resolution(self) -> float:
        step = self._monitor.h or 1e-3 * (self._stop - self._start)
        return RESOLUTION * (abs(self._t) + step)

    def _advance(self) -> None:
        """Integrate over one stretch and handle what ends it."""
        evaluator, t, near = self._evaluator, self._t, self._resolution
        end = min(self._until, self._inputs.next_jump(t + near), self._schedule.next(), self._samples.next())
        first, last = self._grid.searchsorted((t + near, end - near))
        times = np.concatenate([[t], self._grid[first:last], [end]])
        self._roots.restart(t + near)
        before = perf_counter()
        stretch = self._integrate(times)
        self._statistics.integrate_s += perf_counter() - before
        y, yp = evaluator.y, evaluator.yp
        if stretch.t.size:
            t, y, yp = float(stretch.t[-1]), stretch.y[-1], stretch.yp[-1]
            u = self._inputs.sample(stretch.t)
            self._recorder.add(stretch.t, stretch.y, stretch.yp, u, evaluator.z.copy(), evaluator.m.copy())
        self._check(stretch, t, y, yp)
        evaluator.t[0], evaluator.y[:], evaluator.yp[:] = t, y, yp
        self._inputs.refresh(t)
        self._check_relations(stretch)
        self._arrive(stretch)

    def _integrate(self, times: FloatArray) -> Stretch:
        """Over one stretch; anew after an event that has changed the equations, else on from where IDA was.

        A model with events that concern discrete variables only goes output by output, so that IDA can go on.
        """
        stop, store_steps = float(times[-1]), self._options.store_steps
        method = self._engine.step_through if self._stepping else self._engine.run
        if self._stepping and not self._affected and self._engine.can_continue(stop):
            first_step = None
        else:
            self._engine.forget()
            if self._starts and not self._affected:
                self._iteration.make_consistent()
            self._adapt_tolerances()
            first_step = self._first_step(stop - float(times[0]))
            self._starts += 1
        y, yp = self._evaluator.y.copy(), self._evaluator.yp.copy()
        stretch = method(times, y, yp, first_step, store_steps)
        while stretch.flag == ERROR_TEST_FAILED and not stretch.t.size and first_step:
            first_step *= FIRST_STEP_CUT
            if first_step < FIRST_STEP_LEAST * (stop - float(times[0])):
                break
            stretch = method(times, y, yp, first_step, store_steps)
        if not stretch.t.size:  # the evaluator holds what a step has tried
            self._evaluator.y[:], self._evaluator.yp[:] = y, yp
        return stretch

    def _adapt_tolerances(self) -> None:
        """Those of this start; after a halt because of them they are set already."""
        if self._monitor.halted == "tolerances" or (self._tolerances.adaptive and self._tolerances.adapt()):
            self._engine.set_tolerances(self._tolerances.atol)

    def _first_step(self, duration: float) -> float | None:
        """A first step whose error, h^2 |y''| / 2, is a part of what the tolerance allows."""
        second = self._iteration.rates(self._inputs.refresh, duration)
        if self._options.first_step is not None or second is None:
            return self._options.first_step
        weighted = second / (self._options.step_rtol * np.abs(self._evaluator.y) + self._tolerances.atol)
        size = float(np.sqrt(np.mean(weighted**2))) if second.size else 0.0
        longest = FIRST_STEP_PART * (self._monitor.h if self._monitor.halted else duration)  # halted: goes on
        step = min(longest, (2.0 * FIRST_STEP_ERROR / size) ** 0.5) if size > 0.0 else longest
        return max(step, FIRST_STEP_LEAST * abs(self._t))

    def _arrive(self, stretch: Stretch) -> None:
        """Handle what is due at the end of a stretch."""
        t, near = self._t, self._resolution
        flagged = self._schedule.due(t + near)
        jump = self._inputs.next_jump(t - near) <= t + near
        sampled = self._samples.next() <= t + near
        self._statistics.time_events += bool(flagged or jump or sampled)
        if stretch.end == "root":
            found = {int(self._roots.index[k]): bool(d > 0) for k, d in enumerate(stretch.directions) if d}
            flagged |= found
            self._statistics.state_events += 1
            self._accumulation.add(t, self._dae.relations[next(iter(found))].label)
        if jump:
            self._events.append(Event(t, "an input jumps", kind="input"))
        if flagged or jump or sampled:
            self._event(flagged, jump)
        if self._ended is None and self._stop - t <= near:
            self._ended = ("finished", "")
            if t != self._stop:  # an event a rounding error before the end
                self._evaluator.t[0] = self._stop
                self._record_point()

    def _event(self, flagged: Mapping[int, bool], jump: bool = False) -> None:
        """Handle an event at the present time; `flagged` relations are known to change."""
        before = perf_counter()
        t, near = self._t, self._resolution
        self._inputs.begin(t, near)
        due = self._samples.next() <= t + near
        sample = partial(self._samples.act, t + near) if due else None
        outcome = self._iteration.handle(flagged, near, jump, sample)
        self._schedule.update(t, t + near)
        self._affected = outcome.affected
        if self._evaluator.external is not None and outcome.affected:
            self._evaluator.external.restart()
        self._stepping |= (bool(flagged) or due) and not outcome.affected
        if flagged or jump or due or outcome.events:
            self._events += outcome.events
            self._statistics.events += 1
            self._record_point()
        self._statistics.event_iterations += outcome.iterations
        if outcome.terminate is not None:
            self._ended = ("terminated", outcome.terminate)
        self._statistics.events_s += perf_counter() - before

    def _check(self, stretch: Stretch, t: float, y: Any, yp: Any) -> None:
        """Raise what ended the stretch early; t, y, yp are the last good values."""
        if stretch.end not in ("failed", "halted"):
            return
        if self._monitor.halted == "tolerances":
            self._engine.forget()
            self._affected = False  # the values are interpolated: they are made consistent at the start
            return
        if self._monitor.halted == "interrupted":
            raise KeyboardInterrupt
        told = suspect(self._dae, self._evaluator, t, y, yp, self._options.step_rtol, self._tolerances.atol)
        if self._monitor.halted == "max_steps" or stretch.flag == -1:
            raise too_many_steps(self._monitor, self._options, told)
        raise integration_failure(self._dae, self._evaluator, self._monitor, stretch, t, told)

    def _check_relations(self, stretch: Stretch) -> None:
        """No frozen relation may have changed unseen."""
        found = self._roots.disagreement if stretch.end != "root" else None
        if found is None:
            k = self._schedule.unseen(self._t, self._t + self._resolution)
            found = None if k is None else (self._t, k)
        if found is not None:
            relation = self._dae.relations[found[1]]
            raise SimulationError(
                f"the relation {relation.label} changed by t = {found[0]:.9g} s without an event",
                where=relation.where,
                cause="it depends on something that neither the step nor the schedule of time events shows",
                remedy="make it a relation of states and time that is continuous between events",
            )

    def _record_point(self) -> None:
        ev = self._evaluator
        self._recorder.add(
            ev.t.copy(), ev.y[None].copy(), ev.yp[None].copy(), ev.u.copy(), ev.z.copy(), ev.m.copy()
        )

    @property
    def ended(self) -> tuple[Status, str] | None:
        """How the run has ended; None while it can go on."""
        return self._ended

    @property
    def evaluator(self) -> Evaluator:
        """The model's functions at the present values."""
        return self._evaluator

    def trajectory(self, status: Status, message: str) -> Trajectory:
        """What has been computed so far."""
        before = perf_counter()
        t, y, yp, u, z, m = self._recorder.columns()
        s, counts = self._statistics, self._monitor
        s.steps, s.rejected_steps = counts.steps, counts.rejected
        s.residual_evaluations, s.jacobian_evaluations = counts.residuals, counts.jacobians
        s.root_evaluations, s.non_finite_residuals = counts.roots, counts.non_finite
        if self._evaluator.external is not None:
            s.external_calls, s.external_s = self._evaluator.external.count, self._evaluator.external.seconds
        s.restarts = max(self._starts - 1, 0)
        s.output_s = perf_counter() - before
        s.total_s = perf_counter() - self._begun
        if counts.offence is not None and status == "finished":
            s.messages.append(
                f"{counts.non_finite} trial states had no finite residual, and shorter steps went round them; "
                f"one at t = {counts.offence.t:.6g} s: {listed(counts.offence.labels, '; ')}"
            )
        return Trajectory(
            t,
            y,
            yp,
            u,
            z,
            m,
            self._p,
            self._start,
            self._stop,
            self._options,
            self._events,
            s,
            status,
            message,
        )
