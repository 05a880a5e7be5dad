"""Steady states: F(t, y, y', ...) = 0 with y' = 0, from an initial point.

Some states have no value of rest: the angle of a turning shaft, or a position on which nothing depends. Where dF/dy
has null vectors N, the equations do not change along N; there y stays where it is, and y' = N r may differ from zero:

    F(t, y, N r) = 0,   N^T (y - y_0) = 0,   for y and the rates r.

A conserved quantity, a charge in a closed loop, say, gives a null vector as well; its r comes out zero, and the start
decides its value. Newton's method goes first. Where it fails, implicit Euler with growing steps leads towards the rest
(pseudo-transient continuation, Kelley and Keyes (1998), SIAM J. Numer. Anal. 35, 508-523).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from arthur_acausal.analysis.rest import Euler, Rest, dense, null_vectors, rates
from arthur_acausal.codegen.compiled import CompiledDAE
from arthur_acausal.errors import InitializationError
from arthur_acausal.solve.diagnosis import listed
from arthur_acausal.solve.inputs import Input, Inputs
from arthur_acausal.solve.modes import Modes
from arthur_acausal.solve.newton import newton
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.protocol import FloatArray
from arthur_acausal.solve.simulate import initial_point
from arthur_acausal.solve.statistics import Statistics
from arthur_acausal.solve.trajectory import Trajectory

PART = 1e-6  # a state takes part in a free direction from this part of the largest on
TURNING = 1e-7  # a rate [nominal/s] from which on a free state is said to drift; below, it takes months
LASTING = 1e3  # s: for so long at most
STEPS = 80  # of the pseudo-transient
FIRST, GROWTH, SHRINK = 1e-4, 4.0, 0.1  # s; factors of the step after a success and a failure
LONG = 1e2  # s: from this step on Newton's method for the rest is tried again
NEWTON = 30  # iterations
LOOSE = 1e4  # scale of the rates: where something must give, it is they rather than the values at the start


@dataclass(frozen=True, slots=True)
class SteadyState:
    """A point of rest at time ``t`` [s].

    ``free``: states that the equations leave free, at their start values; ``drifts``: those among them that move on
    steadily, with their rates [unit/s]. ``point``: the values of all, as a trajectory of one row.
    """

    t: float
    values: Mapping[str, float]
    free: list[str]
    drifts: Mapping[str, float]
    method: str
    iterations: int
    point: Trajectory

    def __getitem__(self, path: str) -> float:
        return self.values[path]

    def begin(self) -> Trajectory:
        """The point as the beginning of a run, with what is to be told of it."""
        held = [f"{path} = {self.values[path]:g}" for path in self.free if path not in self.drifts]
        moving = [f"{path} (by {rate:g} a second)" for path, rate in self.drifts.items()]
        messages = [f"at rest, but the equations leave free: {listed(held)}"] if held else []
        messages += [f"at rest, but these move on steadily: {listed(moving)}"] if moving else []
        statistics = Statistics(
            initial_iterations=self.iterations, initial_method=f"rest by {self.method}", messages=messages
        )
        return replace(self.point, statistics=statistics)


def steady_state(
    dae: CompiledDAE,
    *,
    time: float = 0.0,
    parameters: Mapping[str, Any] | None = None,
    inputs: Mapping[str, Input] | None = None,
    start: Mapping[str, Any] | None = None,
    options: SolverOptions | None = None,
) -> SteadyState:
    """Return the state of rest that is reached from the initial point at ``time`` [s], inputs held as they are then.

    Discrete variables stay as they are at the initial point; relations follow the values.
    Raises InitializationError, naming equations, where none is found.
    """
    chosen = options or SolverOptions()
    begin = initial_point(
        dae,
        stop_time=time + 1.0,
        start_time=time,
        options=chosen,
        inputs=inputs,
        parameters=parameters,
        start=start,
    )
    return _Search(dae, begin, chosen, inputs or {}).run()


class _Search:
    """One search; the present values are those in the evaluator."""

    def __init__(
        self, dae: CompiledDAE, begin: Trajectory, options: SolverOptions, inputs: Mapping[str, Input]
    ) -> None:
        self.dae, self.begin, self.options = dae, begin, options
        self.evaluator = e = dae.evaluator()
        e.p[:] = begin.p
        e.t[:] = begin.t[-1]
        e.y[:], e.yp[:], e.z[:], e.m[:] = begin.y[-1], begin.yp[-1], begin.z[-1], begin.m[-1]
        e.zp[:] = e.z
        Inputs(dae.u_paths, dae.u_default, inputs, e.u, begin.t[-1], begin.t[-1] + 1.0).refresh(begin.t[-1])
        self.modes = Modes(dae, e)
        self.attributes = dae.attributes(begin.p)
        self.scale = np.maximum(np.abs(self.attributes.nominal), np.abs(begin.y[-1]))
        self.iterations = 0
        self.null: FloatArray = np.zeros((dae.n, 0))

    def run(self) -> SteadyState:
        """Newton's method; where it fails, the pseudo-transient."""
        if not self.dae.n or self._rest():
            return self._found("Newton")
        e = self.evaluator
        e.y[:], e.m[:] = self.begin.y[-1], self.begin.m[-1]
        if self._transient():
            return self._found("pseudo-transient")
        raise self._failure()

    def _rest(self) -> bool:
        """Newton's method from where the evaluator stands, with relations that follow."""
        e, n = self.evaluator, self.dae.n
        for _ in range(self.options.max_event_iterations):
            self.null = self._free_directions()
            k = self.null.shape[1]
            system = Rest(e, self.dae, self.null, e.y.copy(), self.scale)
            w = np.concatenate([e.y, np.zeros(k)])
            scale = np.concatenate([self.attributes.nominal, np.full(k, LOOSE)])
            low = np.concatenate([self.attributes.min, np.full(k, -np.inf)])
            solved = newton(system, w, scale, low, self._high(k), self.options.newton_tolerance, NEWTON)
            self.iterations += solved.iterations
            remains = system.residual(solved.w)
            if solved.reason and not (solved.reason == "singular" and self._holds(remains[:n])):
                return False
            if not self._lasting(system, solved.w):
                return False
            if not self.modes.update():
                if solved.reason:
                    self.null = np.hstack([self.null, self._undetermined(system)])
                return True
        return False

    def _lasting(self, system: Rest, w: FloatArray) -> bool:
        """Whether what drifts can go on: F is still zero when all of it has moved by its own size."""
        n, e = self.dae.n, self.evaluator
        drift = np.where(self.dae.differential, self.null @ w[n:], 0.0)
        speed = np.abs(drift) / self.scale
        turning = speed > TURNING
        if not turning.any():
            return True
        e.y[:] = w[:n] + drift * min(1.0 / float(speed[turning].min()), LASTING)
        holds = self._holds(e.residual())
        system.residual(w)
        return holds

    def _undetermined(self, system: Rest) -> FloatArray:
        """Null vectors of the bordered system: what Newton's method has left as it was, a speed without friction."""
        n, k = self.dae.n, system.null.shape[1]
        scale = np.concatenate([self.scale, np.ones(k)])
        right = null_vectors(system.matrix() * scale)[:n]
        found: FloatArray = right * self.scale[:, None]
        return found

    def _high(self, k: int) -> FloatArray:
        return np.concatenate([self.attributes.max, np.full(k, np.inf)])

    def _holds(self, residual: FloatArray) -> bool:
        """Whether F is zero to within what changes of the unknowns by the tolerance make of it."""
        matrix = np.abs(dense(self.dae, self.evaluator.jacobian_y())) * self.scale
        matrix += np.abs(rates(self.dae, self.evaluator)) * self.scale
        size = matrix.max(axis=1, initial=0.0)
        if not np.isfinite(size).all():
            return False
        return bool(np.all(np.abs(residual) <= 1e2 * self.options.newton_tolerance * size))

    def _free_directions(self) -> FloatArray:
        """Orthonormal null vectors (in scaled unknowns) of dF/dy, as columns in the unknowns' own units."""
        matrix = dense(self.dae, self.evaluator.jacobian_y()) * self.scale
        found: FloatArray = null_vectors(matrix) * self.scale[:, None]
        return found

    def _transient(self) -> bool:
        """Implicit Euler with growing steps, and Newton's method for the rest when they are long."""
        e, h = self.evaluator, FIRST
        for _ in range(STEPS):
            before = e.y.copy()
            system = Euler(e, self.dae, before, h)
            nominal, low, high = self.attributes.nominal, self.attributes.min, self.attributes.max
            solved = newton(system, before, nominal, low, high, self.options.newton_tolerance, 10)
            self.iterations += solved.iterations
            if solved.reason:
                e.y[:], h = before, h * SHRINK
                continue
            e.y[:] = solved.w
            self.modes.update()
            h *= GROWTH
            kept = e.y.copy(), e.m.copy()
            if h >= LONG and self._rest():
                return True
            e.y[:], e.m[:] = kept
        return self._rest()

    def _found(self, method: str) -> SteadyState:
        e, dae = self.evaluator, self.dae
        y, yp, u, z, m = (np.array(x).reshape(1, -1) for x in (e.y, e.yp, e.u, e.z, e.m))
        row = replace(self.begin, t=np.array(e.t), y=y, yp=yp, u=u, z=z, m=m, status="finished")
        paths = dae.recovery.paths
        values = dae.recovery.observe(paths, row.t, row.y, row.yp, row.p, row.u, row.z, row.m)[0]
        states = np.flatnonzero(dae.differential).tolist()
        part = np.abs(self.null / self.scale[:, None]).max(axis=1, initial=0.0)
        free = [dae.y_paths[j] for j in states if part[j] > PART]
        drifts = {
            dae.y_paths[j]: float(e.yp[j])
            for j in states
            if abs(e.yp[j]) > TURNING * self.attributes.nominal[j]
        }
        table = dict(zip(paths, values.tolist(), strict=True))
        return SteadyState(float(e.t[0]), table, free, drifts, method, self.iterations, row)

    def _failure(self) -> InitializationError:
        e, dae = self.evaluator, self.dae
        e.yp[:] = 0.0
        matrix = np.abs(dense(dae, e.jacobian_y())) * self.scale + np.abs(rates(dae, e)) * self.scale
        scaled = np.abs(e.residual()) / np.maximum(matrix.max(axis=1, initial=0.0), np.finfo(float).tiny)
        worst = np.argsort(-np.nan_to_num(scaled, nan=np.inf), kind="stable")[:3].tolist()
        return InitializationError(
            f"no steady state was found in {self.iterations} Newton iterations; not at rest: "
            f"{listed([dae.row_labels[i] for i in worst], '; ')}",
            cause="the model may have none: something accelerates or fills for ever, or oscillates",
            remedy="start nearer to it, or simulate until it is reached",
        )
