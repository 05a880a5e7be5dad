"""The engine: SUNDIALS IDA through scikit-sundae, one stretch between two events at a time.

`IDA.solve` of the binding runs a whole stretch in compiled code and interpolates to the output times itself; step by
step, each output would cost 20 microseconds of Python more. Hindmarsh et al. (2005), ACM TOMS 31, 363-396.
"""

from __future__ import annotations

import itertools
import math
import os
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from arthur_acausal.solve.callbacks import Monitor, Roots, jacobian_callback, residual_callback
from arthur_acausal.solve.capture import captured, text_of
from arthur_acausal.solve.inputs import Inputs
from arthur_acausal.solve.native import Native
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.protocol import DAE, Evaluator, FloatArray

DENSE_UP_TO = 200  # unknowns; above, the sparse solver is faster
ROOT_RETURN, ERROR_TEST_FAILED = 2, -3

End = Literal["reached", "root", "failed", "halted"]


@dataclass(frozen=True, slots=True)
class Stretch:
    """What one call of the engine computed.

    Attributes
    ----------
    t, y, yp : (k,), (k, n), (k, n): the requested times after the start that were reached, and at the end the time
        of a root or the last time that a failing integration reached.
    end : "reached" the last time, "root" found, "failed", or "halted" by the monitor.
    directions : of a root: for each of the engine's relations +1 became true, -1 became false, 0 unchanged.
    flag, message : what IDA returned and printed.
    """

    t: FloatArray
    y: FloatArray
    yp: FloatArray
    end: End
    directions: Any
    flag: int
    message: str


class Ida:
    """IDA with everything set but the initial values; `run` starts it anew from consistent ones.

    The binding fixes the first step when IDA's memory is set up, so one IDA object is kept for each power of four
    that is asked for: setting up costs 0.3 ms, starting a kept one anew a tenth of it.
    """

    def __init__(
        self,
        dae: DAE,
        evaluator: Evaluator,
        inputs: Inputs,
        roots: Roots,
        monitor: Monitor,
        atol: FloatArray,
        options: SolverOptions,
        max_step: float,
    ) -> None:
        self.linear_solver = _linear_solver(dae.n, options)
        self._n = dae.n
        self._roots, self._monitor = roots, monitor
        dense = self.linear_solver == "dense"
        self._native = Native.of(dae, evaluator, inputs, roots, monitor, dense)
        if self._native is not None:
            self._residual, jacobian = self._native.residual, self._native.jacobian
            self._eventsfn: Any = self._native.roots
        else:
            self._residual = residual_callback(evaluator, inputs, monitor)
            jacobian = jacobian_callback(dae, evaluator, inputs, monitor, dense)
            self._eventsfn = roots.callback() if roots.index.size else None
        self._settings: dict[str, Any] = {
            "rtol": options.step_rtol,
            "atol": atol if dae.n else 1.0,
            "linsolver": self.linear_solver,
            "algebraic_idx": np.flatnonzero(~dae.differential).tolist() or None,
            "max_order": options.max_order,
            "max_num_steps": options.max_steps,
            "max_step": max_step,
            "jacfn": jacobian,
        }
        if self.linear_solver == "sparse":
            self._settings |= {"sparsity": _pattern(dae), "nthreads": 1}
        if self._eventsfn is not None:
            self._settings |= {"eventsfn": self._eventsfn, "num_events": int(roots.index.size)}
        self._engines: dict[float, Any] = {}
        self._stepping: Any = None
        self._reached = -math.inf

    def run(
        self,
        times: FloatArray,
        y: FloatArray,
        yp: FloatArray,
        first_step: float | None,
        onestep: bool = False,
    ) -> Stretch:
        """Start from (times[0], y, yp) and integrate over the later times; `onestep`: return IDA's own steps."""
        self._monitor.restart()
        self._stepping = None
        start = times[0]
        inserted = len(times) == 2 and not onestep
        if inserted:  # the binding takes two times as an order to return its own steps
            times = np.array([start, 0.5 * (start + times[1]), times[1]])
        elif onestep:
            times = times[[0, -1]]
        if not self._n:
            y = yp = np.zeros(1)
        engine = self._engine(first_step, start, y, yp)
        with self._integrating() as printed:
            result = engine.solve(times, y, yp)
        first = 2 if inserted and len(result.t) > 2 else 1
        if len(result.t) > first and result.t[-1] <= start:  # failed in the first step
            first = len(result.t)
        return self._stretch(result, result.t[first:], result.y[first:], result.yp[first:], text_of(printed))

    def step_through(
        self,
        times: FloatArray,
        y: FloatArray,
        yp: FloatArray,
        first_step: float | None,
        onestep: bool = False,
    ) -> Stretch:
        """Like `run`, output by output, so that IDA can be asked to go on after a root without a new start.

        If `can_continue`, the integration goes on from where it was, and y, yp and first_step are not used.
        """
        if not self.can_continue(times[-1]):
            self._monitor.restart()
            if not self._n:
                y = yp = np.zeros(1)
            self._stepping = self._engine(first_step, times[0], y, yp)
            self._stepping.init_step(times[0], y, yp)
        with self._integrating() as printed:
            results = list(self._steps(times, onestep))
        self._reached = self._monitor.t
        if results[-1].status < 0:
            self._stepping = None
        rows = [r for r in results if r.status >= 0 or r.t > times[0]]
        if not rows:
            nothing = np.zeros(0)
            return self._stretch(results[-1], nothing, nothing, nothing, text_of(printed))
        t, y, yp = (np.array([getattr(r, name) for r in rows]) for name in ("t", "y", "yp"))
        return self._stretch(results[-1], t, y, yp, text_of(printed))

    def _steps(self, times: FloatArray, onestep: bool) -> Iterator[Any]:
        """Results at the output times, or of all steps, up to the last time, a root or a failure."""
        method, stop = ("onestep" if onestep else "normal"), float(times[-1])
        for t in itertools.repeat(stop) if onestep else times[1:].tolist():
            result = self._stepping.step(t, method, stop)
            yield result
            if result.status < 0 or result.status == ROOT_RETURN or result.t >= stop:
                return

    @contextmanager
    def _integrating(self) -> Iterator[Any]:
        """While IDA is at work: what it prints is caught, and functions in C count for the monitor."""
        with captured() as printed, np.errstate(over="ignore", invalid="ignore"):
            if self._native is not None:
                self._native.begin()
            try:
                yield printed
            finally:
                if self._native is not None:
                    self._native.end()

    def set_tolerances(self, atol: FloatArray) -> None:
        """Integrate with other absolute tolerances from the next start on."""
        self._settings["atol"] = atol
        self._engines.clear()

    def forget(self) -> None:
        """The next `step_through` is to start anew."""
        self._stepping = None

    def can_continue(self, stop: float) -> bool:
        """Whether `step_through` can go on to `stop`: IDA has not stepped over it yet."""
        return self._stepping is not None and stop >= self._reached

    def _stretch(self, result: Any, t: FloatArray, y: FloatArray, yp: FloatArray, printed: str) -> Stretch:
        flag = int(result.status)
        end: End = "failed" if flag < 0 else "root" if flag == ROOT_RETURN else "reached"
        if self._monitor.halted:
            end = "halted"
        directions = None
        if self._eventsfn is not None:
            if end == "root":
                directions = result.i_events[-1]
            for found in (self._eventsfn._i, self._eventsfn._t, self._eventsfn._y, self._eventsfn._yp):
                found.clear()  # the binding would keep and copy the events of all starts
            self._eventsfn._i_cnt[:] = 0
        y, yp = (a.reshape(len(t), -1 if len(t) else self._n)[:, : self._n] for a in (y, yp))
        return Stretch(t, y, yp, end, directions, flag, printed or str(result.message))

    def _engine(self, first_step: float | None, t: float, y: FloatArray, yp: FloatArray) -> Any:
        key = 0.0 if first_step is None else 4.0 ** math.floor(math.log(first_step, 4.0))
        if key not in self._engines:
            with warnings.catch_warnings():
                # "sparsity ignored in favor of jacfn": it gives the pattern of jacfn's values here
                warnings.simplefilter("ignore")
                engine = self._engines[key] = load_ida()(self._residual, first_step=key, **self._settings)
            if self._native is not None:
                engine.init_step(t, y, yp)  # sets its memory up
                self._native.attach(engine)
        return self._engines[key]


def load_ida() -> Any:
    """Import the binding, with its OpenMP library limited to one thread.

    SuperLU_MT opens a parallel region for each factorisation even with one thread of its own. The region's idle
    threads spin for their turn, and where another process has the core, a factorisation then takes 8 ms in place of
    0.1 ms. The library reads its setting once, when it is loaded.
    """
    if "sksundae.ida" not in sys.modules and "OMP_NUM_THREADS" not in os.environ:
        import scipy.linalg
        import scipy.optimize
        import scipy.sparse  # noqa: F401 - these read the same setting: they come first, with the user's

        os.environ["OMP_NUM_THREADS"] = "1"
        try:
            from sksundae.ida import IDA
        finally:
            del os.environ["OMP_NUM_THREADS"]
        return IDA
    from sksundae.ida import IDA

    return IDA


def _linear_solver(n: int, options: SolverOptions) -> str:
    if options.linear_solver != "auto" and n:
        return options.linear_solver
    return "dense" if n <= DENSE_UP_TO else "sparse"


def _pattern(dae: DAE) -> Any:
    from scipy.sparse import csc_matrix

    colind, row = np.asarray(dae.sparsity.colind, np.int32), np.asarray(dae.sparsity.row, np.int32)
    return csc_matrix((np.ones(row.size), row, colind), shape=(dae.n, dae.n))
