"""A run that its caller takes forward step by step, with inputs that are set in between."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from arthur_acausal.codegen.compiled import CompiledDAE
from arthur_acausal.codegen.threads import one_thread
from arthur_acausal.errors import UsageError, nearest
from arthur_acausal.solve.hybrid import HybridRun
from arthur_acausal.solve.inputs import Input
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.protocol import FloatArray
from arthur_acausal.solve.simulate import check_times, keeping
from arthur_acausal.solve.trajectory import Trajectory


class Stepper:
    """A run in steps of its caller's, from consistent values at ``start_time`` [s] to ``stop_time`` at most.

    Between steps the inputs that ``set`` has given are held. The arguments are those of `simulate`; inputs that vary
    by themselves keep doing so and cannot be set.

    Raises
    ------
    InitializationError, UsageError : as `simulate` does.
    """

    @one_thread(scipy=True)
    def __init__(
        self,
        dae: CompiledDAE,
        *,
        stop_time: float,
        start_time: float = 0.0,
        options: SolverOptions | None = None,
        inputs: Mapping[str, Input] | None = None,
        parameters: Mapping[str, Any] | None = None,
        start: Mapping[str, Any] | None = None,
        begin: Trajectory | None = None,
    ) -> None:
        check_times(start_time, stop_time)
        self._dae = dae
        given = inputs or {}
        self._free = {
            path: k for k, path in enumerate(dae.u_paths) if isinstance(given.get(path, 0.0), int | float)
        }
        grid = np.array([start_time, stop_time], dtype=float)
        self._run = HybridRun(
            dae,
            float(start_time),
            float(stop_time),
            options or SolverOptions(),
            given,
            parameters,
            start,
            None,
            grid,
            begin,
        )
        self._run.initialize()
        self.begin: Trajectory = self._run.trajectory("finished", "")
        """The consistent values at the start, which another run of the same model can be given as ``begin``."""
        with keeping(self._run):
            self._run.depart()

    @property
    def t(self) -> float:
        """The present time [s]."""
        return float(self._run.evaluator.t[0])

    @property
    def ended(self) -> str | None:
        """Why the run has ended: "finished", or what the model said as it ended it; None while it can go on."""
        ended = self._run.ended
        return None if ended is None else ended[1] or ended[0]

    def set(self, inputs: Mapping[str, float]) -> None:
        """Let inputs, by path, have these values from now on.

        Raises UsageError for what is no input or varies by itself, SolverFailure where the model has no solution with
        these values.
        """
        for path in inputs:
            if path not in self._free:
                raise UsageError(
                    f"the run has no input {path!r} that can be set",
                    remedy=nearest(path, list(self._free)) or f"it has {', '.join(self._free) or 'none'}",
                )
        values = {self._free[path]: float(value) for path, value in inputs.items()}
        if not all(np.isfinite(value) for value in values.values()):
            raise UsageError(f"inputs must be finite, not {dict(inputs)}")
        with keeping(self._run):
            self._run.impose(values)

    @one_thread(scipy=True)
    def advance(self, until: float) -> None:
        """Integrate up to a time [s], or to where the model ends the run.

        Raises SolverFailure, which holds the trajectory so far, where the integration cannot go on.
        """
        with keeping(self._run):
            self._run.advance(float(until))

    def observe(self, paths: Sequence[str]) -> FloatArray:
        """Return the present values (n,) of variables by path, in SI."""
        ev = self._run.evaluator
        rows = (ev.t, ev.y[None], ev.yp[None], ev.p, ev.u[None], ev.z[None], ev.m[None])
        values: FloatArray = self._dae.recovery.observe(paths, *rows)[0]
        return values

    def trajectory(self) -> Trajectory:
        """Return what has been computed so far: the ends of the steps and the events."""
        return self._run.trajectory(*(self._run.ended or ("finished", "")))
