"""External functions at run time: each called once where its inputs are new, between the kernels around it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from time import perf_counter
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from arthur_acausal.codegen.kernel import Kernel
from arthur_acausal.errors import SimulationError

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Need:
    """What a function takes of the external ones: which calls, by their place in the order, and what of them."""

    calls: tuple[int, ...]
    derivatives: bool = False

    @classmethod
    def all(cls, calls: Sequence[ExternalCall], *, derivatives: bool = False) -> Need:
        """Return the need of all calls."""
        return cls(tuple(range(len(calls))), derivatives)


@dataclass(frozen=True, slots=True)
class ExternalCall:
    """One call of an external function; a system's calls stand in an order in which each has what it needs.

    ``name``: of the kernel of its inputs, ``inputs`` without compilation; ``path``: of the component that calls;
    ``first``: of its outputs in e; ``slope``: where its derivatives (n_outputs, n_inputs) begin in d, by rows.
    """

    name: str
    label: str
    path: str
    where: str
    function: Any
    inputs: ca.Function = field(repr=False)
    first: int
    slope: int


NOTHING, OUTPUTS, SLOPES, EXACT_SLOPES = range(4)
"""What of a call is known at its inputs: each contains those before it."""


class Step:
    """A call with its own copy of the function, and views of its part of e and d.

    ``key``: the inputs at which ``known[0]`` says what stands there. Callbacks in C read and write both.
    """

    __slots__ = ("call", "exact", "function", "inputs", "key", "known", "outputs", "slopes")

    def __init__(self, call: ExternalCall, kernel: Kernel, e: FloatArray, d: FloatArray) -> None:
        self.call, self.inputs = call, kernel
        self.function = call.function.fresh()
        n, m = self.function.n_outputs, self.function.n_inputs
        self.outputs = e[call.first : call.first + n]
        self.slopes = d[call.slope : call.slope + n * m].reshape(n, m)
        self.exact = getattr(self.function, "exact_derivative", self.function.derivative)
        self.key, self.known = np.zeros(m), np.zeros(1, dtype=np.int64)


class Prepared:
    """A kernel that is preceded by the calls that it needs, ``steps``, and their derivatives where it takes them."""

    __slots__ = ("derivatives", "kernel", "prepare", "steps")

    def __init__(
        self, kernel: Kernel, steps: Sequence[Step], derivatives: bool, prepare: Callable[[], None]
    ) -> None:
        self.kernel, self.steps, self.derivatives, self.prepare = kernel, steps, derivatives, prepare

    def __call__(self) -> FloatArray:
        self.prepare()
        return self.kernel()


class Calls:
    """All external functions of one evaluator.

    ``exact``: whether derivatives are to be exact; ``tally``: evaluations so far and the time in them [s], derivatives
    included. Callbacks in C add to it.
    """

    def __init__(
        self,
        calls: Sequence[ExternalCall],
        functions: Mapping[str, ca.Function],
        arguments: Sequence[FloatArray],
        e: FloatArray,
        d: FloatArray,
    ) -> None:
        self.exact = True
        self.tally = np.zeros(2)
        self._t = arguments[0]
        self._steps = [Step(c, Kernel(functions.get(c.name, c.inputs), arguments), e, d) for c in calls]

    @property
    def count(self) -> int:
        """Evaluations so far."""
        return int(self.tally[0])

    @property
    def seconds(self) -> float:
        """Wall time in them and their derivatives [s]."""
        return float(self.tally[1])

    def _evaluate(self, steps: Sequence[Step]) -> None:
        """Bring the outputs up to date with the arguments."""
        for step in steps:
            inputs = step.inputs()
            if not step.known[0] or inputs.tobytes() != step.key.tobytes():
                step.known[0] = NOTHING
                self._run(step, step.function.evaluate, inputs, step.outputs)
                self.tally[0] += 1.0
                step.key[:] = inputs
                step.known[0] = OUTPUTS

    def _differentiate(self, steps: Sequence[Step]) -> None:
        """Bring outputs and derivatives up to date with the arguments."""
        self._evaluate(steps)
        wanted = EXACT_SLOPES if self.exact else SLOPES
        for step in steps:
            if step.known[0] < wanted:
                step.known[0] = OUTPUTS
                method = step.exact if self.exact else step.function.derivative
                self._run(step, method, step.inputs.result, step.slopes)
                step.known[0] = wanted

    def restart(self) -> None:
        """An event has been handled: stale derivatives may be renewed."""
        for step in self._steps:
            step.known[0] = min(step.known[0], OUTPUTS)
            renew = getattr(step.function, "restart", None)
            if renew is not None:
                renew()

    def without_value(self) -> list[str]:
        """Return the calls whose latest outputs are not all finite numbers, with the reason where it is known."""
        found = []
        for step in self._steps:
            if not np.isfinite(step.outputs).all():
                reason = getattr(step.function, "failure", "")
                found.append(f"{step.call.label}: {reason}" if reason else step.call.label)
        return found

    def preparation(self, need: Need) -> Callable[[], None]:
        """Return what brings all that is needed up to date with the arguments."""
        steps = [self._steps[k] for k in need.calls]
        return partial(self._differentiate if need.derivatives else self._evaluate, steps)

    def before(self, kernel: Kernel, need: Need | None) -> Kernel | Prepared:
        """Return a kernel that is preceded by the calls that it needs."""
        if need is None:
            return kernel
        return Prepared(
            kernel, [self._steps[k] for k in need.calls], need.derivatives, self.preparation(need)
        )

    def _run(self, step: Step, method: Callable[..., None], inputs: FloatArray, out: FloatArray) -> None:
        begun = perf_counter()
        try:
            method(inputs, out)
        except Exception as error:
            raise SimulationError(
                f"{step.call.label} failed at t = {float(self._t[0]):.9g} s: {type(error).__name__}: {error}",
                cause="the external function raised",
                remedy="let it write NaN where it has no value: the integrator then takes a shorter step",
            ) from error
        finally:
            self.tally[1] += perf_counter() - begun


class Completion:
    """What external functions give at many points, by one copy of each.

    ``sizes``: of e and d; ``exact``: whether derivatives are to be exact, or as Newton's method takes them, but none of
    another point, which may be far.
    """

    def __init__(self, calls: Sequence[ExternalCall], sizes: tuple[int, int], *, exact: bool = True) -> None:
        self._list, self._sizes, self._exact = calls, sizes, exact
        self._calls: Calls | None = None
        self._point: list[FloatArray] = []

    def __call__(self, arguments: Sequence[FloatArray], need: Need | None) -> list[FloatArray]:
        """Return the arguments of the kernels, each with a column a time, with those that external functions give.

        ``need``: None for nothing. What is not needed is zero.
        """
        if not self._list:
            return list(arguments)
        columns = [np.asarray(a, dtype=float) for a in arguments]
        columns = [a.reshape(-1, 1) if a.ndim < 2 else a for a in columns]
        count = columns[1].shape[1]
        e, d = (np.zeros((size, count)) for size in self._sizes)
        if need is not None:
            calls = self._at(columns)
            prepare = calls.preparation(need)
            for k in range(count):
                for array, column in zip(self._point, columns, strict=False):
                    array[:] = column[:, k]
                if need.derivatives and not self._exact:
                    calls.restart()
                prepare()
                e[:, k], d[:, k] = self._point[-2:]
        return [*arguments, e, d]

    def _at(self, columns: Sequence[FloatArray]) -> Calls:
        if self._calls is None:
            sizes = [*(a.shape[0] for a in columns), *self._sizes]
            self._point = [np.zeros(size) for size in sizes]
            self._calls = Calls(self._list, {}, self._point, *self._point[-2:])
            self._calls.exact = self._exact
        return self._calls
