"""What IDA calls: residual, Jacobian and roots, written for little overhead.

Each call costs some microseconds of Python, so arguments are copied into the evaluator's arrays and nothing is
allocated. A residual with a value that is no finite number becomes all infinite: IDA then cuts its step and goes on,
where an exception would end the run and a NaN would stall it. A run is stopped the same way (Ctrl-C, too many steps),
so that nothing of what IDA has computed is lost.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from time import perf_counter

import numpy as np

from arthur_acausal.solve.inputs import Inputs
from arthur_acausal.solve.newton import Index
from arthur_acausal.solve.protocol import DAE, BoolArray, Evaluator, FloatArray, IntArray

ResidualCallback = Callable[[float, FloatArray, FloatArray, FloatArray], None]
JacobianCallback = Callable[[float, FloatArray, FloatArray, FloatArray, float, FloatArray], None]
RootCallback = Callable[[float, FloatArray, FloatArray, FloatArray], None]
Progress = Callable[[float], None]

PROGRESS_INTERVAL = 0.1  # s of wall time between reports
WATCHED = 20  # Jacobians from one look at the tolerances to the next
STALLED = 4e15  # leading coefficient of BDF times t, about |t| / h: from here on a step is lost in rounding
BLAS_UP_TO = 1000  # elements
TINY = 1e-300  # stands for a relation that is exactly zero: far below any other value, far above underflow


@dataclass(frozen=True, slots=True)
class Offence:
    """A trial state at which the residual rows `rows` were not finite, because of `calls` or `equations`."""

    t: float
    y: FloatArray
    yp: FloatArray
    rows: IntArray
    calls: Sequence[str] = ()
    equations: Sequence[str] = ()

    @property
    def labels(self) -> Sequence[str]:
        """What to name."""
        return self.calls or self.equations


@dataclass(slots=True)
class Monitor:
    """Counts what IDA does, and can make it stop.

    Attributes
    ----------
    t, h : time that the last step tried to reach and length of the last new step, s.
    halted : why the run is to stop: "", "max_steps", "stalled" (t + h == t), "interrupted", or "tolerances", if it is
        to go on with others.
    watch : called now and then; True asks for a stop because of tolerances.
    offence : the first trial state of the latest series of non-finite residuals.
    jacobian_offence : time and index (into the pattern) of the latest non-finite entry of the Jacobian.
    """

    max_steps: int
    progress: Progress | None = None
    watch: Callable[[], bool] | None = None
    steps: int = 0
    rejected: int = 0
    residuals: int = 0
    jacobians: int = 0
    roots: int = 0
    non_finite: int = 0
    t: float = -math.inf
    h: float = 0.0
    halted: str = ""
    offence: Offence | None = None
    jacobian_offence: tuple[float, int] | None = None
    last_bad: int = -2
    next_report: float = field(default_factory=lambda: perf_counter() + PROGRESS_INTERVAL)

    def restart(self) -> None:
        """Integration is about to start (again)."""
        self.t = -math.inf
        self.halted = ""

    def attempt(self, t: float) -> None:
        """IDA tries a step to t: a new one if t is later than before, a shorter one after a rejection if not."""
        if t > self.t:
            self.steps += 1
            if self.t > -math.inf:
                self.h = t - self.t
            if self.steps > self.max_steps:
                self.halted = "max_steps"
        else:
            self.rejected += 1
        self.t = t
        if self.progress is not None and perf_counter() > self.next_report:
            self.progress(t)
            self.next_report = perf_counter() + PROGRESS_INTERVAL

    def refuse(self, evaluator: Evaluator, residual: FloatArray) -> bool:
        """Keep the first trial state of a series of bad ones; False if the residual is finite after all."""
        bad = ~np.isfinite(residual)
        if not bad.any():  # only the sum overflowed
            return False
        # After a bad residual IDA's next iterate is no number either: that says nothing about the model.
        if self.residuals != self.last_bad + 1 and np.isfinite(evaluator.y).all():
            rows = np.flatnonzero(bad).astype(np.int32)
            calls = evaluator.external.without_value() if evaluator.external is not None else ()
            equations = () if calls else evaluator.blamed(rows.tolist())
            t, y, yp = float(evaluator.t[0]), evaluator.y.copy(), evaluator.yp.copy()
            self.offence = Offence(t, y, yp, rows, calls, equations)
        self.last_bad = self.residuals
        self.non_finite += 1
        return True


def residual_callback(evaluator: Evaluator, inputs: Inputs, monitor: Monitor) -> ResidualCallback:
    """The residual as IDA wants it."""
    n = evaluator.y.size
    ev_t, ev_y, ev_yp, kernel = evaluator.t, evaluator.y, evaluator.yp, evaluator.residual
    refresh = inputs.refresh if inputs.varying else None
    inf, isfinite = math.inf, math.isfinite
    value = kernel()  # always the same array
    # One number that is finite if all are: the sum of squares is quickest, but for long vectors BLAS asks its
    # threads, which may have to wait for a core.
    summary = value.dot if n < BLAS_UP_TO else np.add.reduce

    def residual(t: float, y: FloatArray, yp: FloatArray, out: FloatArray) -> None:
        try:
            if t != monitor.t:
                monitor.attempt(t)
            if not monitor.halted:
                monitor.residuals += 1
                ev_t[0] = t
                ev_y[:] = y
                ev_yp[:] = yp
                if refresh is not None:
                    refresh(t)
                kernel()
                if isfinite(summary(value)) or not monitor.refuse(evaluator, value):
                    out[:] = value
                    return
        except KeyboardInterrupt:
            monitor.halted = "interrupted"
        out.fill(inf)

    def nothing(t: float, y: FloatArray, yp: FloatArray, out: FloatArray) -> None:
        if t != monitor.t:
            monitor.attempt(t)
        out[:] = inf if monitor.halted else yp

    return residual if n else nothing  # without unknowns IDA integrates y' = 0 and looks for events


def jacobian_callback(
    dae: DAE, evaluator: Evaluator, inputs: Inputs, monitor: Monitor, dense: bool
) -> JacobianCallback:
    """dF/dy + cj dF/dy' as IDA wants it; dense: an (n, n) array, sparse: the pattern's values."""
    write, ev_cj, kernel = _writer(evaluator, inputs), evaluator.cj, evaluator.jacobian
    isfinite = math.isfinite
    place = dense_places(dae)

    def jacobian(
        t: float, y: FloatArray, yp: FloatArray, res: FloatArray, cj: float, out: FloatArray
    ) -> None:
        if monitor.halted:
            return
        monitor.jacobians += 1
        if cj * abs(t) > STALLED:
            monitor.halted = "stalled"
        try:
            write(t, y, yp)
            if monitor.watch is not None and monitor.jacobians % WATCHED == 0 and monitor.watch():
                monitor.halted = "tolerances"
            ev_cj[0] = cj
            value = kernel()
        except KeyboardInterrupt:
            monitor.halted = "interrupted"
            return
        if not isfinite(np.add.reduce(value)) and (bad := np.flatnonzero(~np.isfinite(value))).size:
            monitor.jacobian_offence = (t, int(bad[0]))
        if dense:
            out.reshape(-1)[place] = value  # the other entries were zero at the start and stay so
        else:
            out[:] = value

    def nothing(t: float, y: FloatArray, yp: FloatArray, res: FloatArray, cj: float, out: FloatArray) -> None:
        out[...] = cj

    return jacobian if dae.n else nothing


def _writer(evaluator: Evaluator, inputs: Inputs) -> Callable[[float, FloatArray, FloatArray], None]:
    """What writes the arguments into the evaluator's arrays."""
    ev_t, ev_y, ev_yp = evaluator.t, evaluator.y, evaluator.yp
    n, refresh = ev_y.size, inputs.refresh if inputs.varying else None

    def write(t: float, y: FloatArray, yp: FloatArray) -> None:
        ev_t[0] = t
        if n:
            ev_y[:] = y
            ev_yp[:] = yp
        if refresh is not None:
            refresh(t)

    return write


def dense_places(dae: DAE) -> Index:
    """Where the pattern's values stand in an (n, n) array, by rows."""
    columns = np.repeat(np.arange(dae.n), np.diff(dae.sparsity.colind))
    return np.asarray(dae.sparsity.row, dtype=np.intp) * dae.n + columns


class Roots:
    """The relations that make state events, signed so that a value is positive exactly if the relation holds.

    IDA then finds every change of a truth value, and never meets an exact zero, for which it has special rules.
    Within `window` after a restart the value of a relation has the sign of its mode: an event that was just handled
    leaves its relation a rounding error to the wrong side.
    """

    def __init__(
        self, dae: DAE, evaluator: Evaluator, inputs: Inputs, monitor: Monitor, index: Index
    ) -> None:
        self._evaluator, self._inputs, self._monitor = evaluator, inputs, monitor
        relations = dae.relations
        self.index = index
        self.sign_of_zero = np.array([TINY if relations[k].inclusive else -TINY for k in index.tolist()])
        self.modes: BoolArray = np.zeros(index.size, dtype=bool)
        self.disagreement: tuple[float, int] | None = None
        self._window_end = -math.inf
        self._expected = self.modes.tobytes()

    def restart(self, window_end: float) -> None:
        """Take the modes as they are now and trust them up to `window_end`."""
        self.modes[:] = self._evaluator.m[self.index] > 0.5
        self.disagreement = None
        self._window_end = window_end
        self._expected = self.modes.tobytes()

    def callback(self) -> RootCallback:
        """The function that IDA calls, also once at each output time."""
        monitor, index, zero = self._monitor, self.index, self.sign_of_zero
        write, kernel = _writer(self._evaluator, self._inputs), self._evaluator.roots
        everything = index.size == self._evaluator.m.size

        def roots(t: float, y: FloatArray, yp: FloatArray, out: FloatArray) -> None:
            try:
                if not monitor.halted:
                    monitor.roots += 1
                    write(t, y, yp)
                    g = kernel()
                    np.add(g if everything else g[index], zero, out)
                    if (out > 0.0).tobytes() != self._expected:
                        self.differs(t, out)
                    return
            except KeyboardInterrupt:
                monitor.halted = "interrupted"
            out[:] = np.where(self.modes, TINY, -TINY)

        return roots

    def differs(self, t: float, out: FloatArray) -> None:
        """Correct a value in the window; keep the first difference after it, which must lead to an event."""
        differs = (out > 0.0) != self.modes
        if t <= self._window_end:
            out[differs] = np.where(self.modes, TINY, -TINY)[differs]
        elif self.disagreement is None:
            self.disagreement = (t, int(self.index[np.flatnonzero(differs)[0]]))
