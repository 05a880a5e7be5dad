"""Where the time of the robot's trot goes, by clocks that stop each other: each moment counts for one part only.

What IDA calls in C is not seen from outside of it, nor is its ``factorisation``. So the number of calls counts, times
what one takes by itself: of the generated functions, of MuJoCo in states that the run has met, of SUNDIALS' own dense
factorisation for a matrix of this size and pattern. The rest of IDA's time is the ``solver``'s.
"""

from __future__ import annotations

import ctypes
import itertools
import time
import timeit
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np

from arthur_acausal.codegen.compiled import CompiledDAE
from arthur_acausal.codegen.kernel import Kernel
from arthur_acausal.models.arthur.walking import Walking
from arthur_acausal.mujoco.dynamics import Dynamics, FloatArray
from arthur_acausal.mujoco.function import BodyFunction
from arthur_acausal.mujoco.native import NativeBody
from arthur_acausal.solve import callbacks, ida
from arthur_acausal.solve.native import Native

PARTS: tuple[str, ...] = ("MuJoCo", "residual", "Jacobian", "factorisation", "solver", "controller", "Python")
REPETITIONS = 50
STATES = 100  # in which MuJoCo is timed by itself


class Clocks:
    """The CPU time [s] of each part, without that of parts called from within it."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {part: 0.0 for part in PARTS}
        self.factorisations = 0
        self.native: Native | None = None  # the callbacks in C
        self.states: list[FloatArray] = []
        self.seen = 0  # evaluations of MuJoCo that a clock has measured
        self.start()

    def start(self) -> None:
        """Forget the time that has passed since the last switch."""
        self._part, self._since = "Python", time.process_time()

    def switch(self, part: str) -> str:
        """Let the clock of another part run; return the one that ran."""
        now = time.process_time()
        self.seconds[self._part] += now - self._since
        before, self._part, self._since = self._part, part, now
        return before

    def timed(self, function: Callable[..., Any], part: str | Callable[[Any], str]) -> Callable[..., Any]:
        """Return the function with its time measured; ``part`` may depend on its first argument."""

        def call(*arguments: Any, **named: Any) -> Any:
            before = self.switch(part if isinstance(part, str) else part(arguments[0]))
            try:
                return function(*arguments, **named)
            finally:
                self.switch(before)

        return call

    def shares(self, dae: CompiledDAE) -> dict[str, float]:
        """Return the part of each in all."""
        seconds = dict(self.seconds)
        inside = self._inside() | {"factorisation": self._factorisations() * factorisation_s(dae)}
        for part, hidden in inside.items():
            found = min(hidden, seconds["solver"])
            seconds[part] += found
            seconds["solver"] -= found
        total = sum(seconds.values())
        return {part: value / total for part, value in seconds.items()}

    def _factorisations(self) -> int:
        """IDA factorises after each Jacobian."""
        return self.factorisations if self.native is None else self.native.monitor.jacobians

    def _inside(self) -> dict[str, float]:
        """Return what the callbacks in C have taken [s]."""
        if self.native is None:
            return {}
        evaluator: Any = self.native.evaluator
        monitor = self.native.monitor
        residual, jacobian, roots = (
            getattr(f, "kernel", f) for f in (evaluator.residual, evaluator.jacobian, evaluator.roots)
        )
        (body,) = (step for step in evaluator.residual.steps)
        states, function = itertools.cycle(self.states), body.function
        out, slopes = np.empty(function.n_outputs), np.empty((function.n_outputs, function.n_inputs))

        def renewed() -> None:
            function.restart()
            function.derivative(next(states), slopes)

        evaluations = int(evaluator.external.count) - self.seen
        renewals = function.renewals
        return {
            "MuJoCo": evaluations * mean_s(lambda: function.evaluate(next(states), out))
            + renewals * mean_s(renewed),
            "residual": monitor.residuals * (least_s(residual) + least_s(body.inputs))
            + monitor.roots * least_s(roots),
            "Jacobian": monitor.jacobians * (least_s(jacobian) + least_s(body.inputs)),
        }


def least_s(call: Callable[[], object]) -> float:
    """Return what a call takes at the least [s]."""
    return min(timeit.repeat(call, timer=time.process_time, number=REPETITIONS, repeat=10)) / REPETITIONS


def mean_s(call: Callable[[], object]) -> float:
    """Return what a call takes in the mean [s]."""
    return timeit.timeit(call, timer=time.process_time, number=2 * STATES) / (2 * STATES)


def kernel_part(kernel: Kernel) -> str:
    """Return what a kernel counts as: its Jacobians are told by their names, all else evaluates equations."""
    return "Jacobian" if "jacobian" in kernel.function.name() else "residual"


@contextmanager
def watching(clocks: Clocks) -> Iterator[None]:
    """Measure all that is called within."""

    def python(make: Callable[..., Any], counted: bool = False) -> Callable[..., Any]:
        def made(*arguments: Any) -> Any:
            function = clocks.timed(make(*arguments), "Python")

            # the binding asks for the number of arguments
            def residual(t: Any, y: Any, yp: Any, out: Any) -> None:
                function(t, y, yp, out)

            def jacobian(t: Any, y: Any, yp: Any, res: Any, cj: Any, out: Any) -> None:
                clocks.factorisations += 1
                function(t, y, yp, res, cj, out)

            return jacobian if counted else residual

        return made

    evaluate, of = BodyFunction.evaluate, Native.of

    def evaluated(function: BodyFunction, inputs: FloatArray, outputs: FloatArray) -> None:
        clocks.seen += 1
        if not function.observes and len(clocks.states) < STATES:
            clocks.states.append(inputs.copy())
        evaluate(function, inputs, outputs)

    def made(*arguments: Any) -> Native | None:
        clocks.native = of(*arguments)
        return clocks.native

    with (
        patch.object(BodyFunction, "evaluate", evaluated),
        patch.object(NativeBody, "_call", clocks.timed(NativeBody._call, "MuJoCo")),
        patch.object(Native, "of", made),
        patch.object(Kernel, "__call__", clocks.timed(Kernel.__call__, kernel_part)),
        patch.object(Dynamics, "forward", clocks.timed(Dynamics.forward, "MuJoCo")),
        patch.object(Walking, "__call__", clocks.timed(Walking.__call__, "controller")),
        patch.object(ida.Ida, "run", clocks.timed(ida.Ida.run, "solver")),
        patch.object(ida.Ida, "step_through", clocks.timed(ida.Ida.step_through, "solver")),
        patch.object(ida, "residual_callback", python(callbacks.residual_callback)),
        patch.object(ida, "jacobian_callback", python(callbacks.jacobian_callback, counted=True)),
        patch.object(callbacks.Roots, "callback", python(callbacks.Roots.callback)),
    ):
        clocks.start()
        yield
        clocks.switch("Python")


def factorisation_s(dae: CompiledDAE) -> float:
    """Return what SUNDIALS takes for one dense factorisation of a matrix with the pattern of this system [s]."""
    import sksundae

    package = Path(sksundae.__file__).parent
    name = next((package.parent / "scikit_sundae.libs").glob("libsundials_core-*"), None)
    factorise = ctypes.CDLL(str(name)).SUNDlsMat_denseGETRF
    n = dae.n
    rng = np.random.default_rng(0)
    matrix = np.eye(n) * n
    columns = np.repeat(np.arange(n), np.diff(dae.sparsity.colind))
    matrix[columns, dae.sparsity.row] += rng.standard_normal(columns.size)  # by columns, as SUNDIALS has them
    pivots = np.zeros(n, dtype=np.int64)
    best = np.inf
    for _ in range(REPETITIONS):
        work = matrix.copy()
        starts = (ctypes.c_void_p * n)(*(work.ctypes.data + 8 * n * j for j in range(n)))
        begun = time.perf_counter()
        factorise(starts, ctypes.c_int64(n), ctypes.c_int64(n), ctypes.c_void_p(pivots.ctypes.data))
        best = min(best, time.perf_counter() - begun)
    return float(best)
