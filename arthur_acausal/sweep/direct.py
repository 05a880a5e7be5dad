"""Several runs of one job at once by the engine of `arthur_acausal.solve.straight`, where they fit it.

Parameters, start values and final values of all of them are computed together; between them there is only C. Each run
is independent of which others it is computed with, to the last bit. One that fails there, or that has inputs or start
values of its own, is made by the default engine.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress
from time import perf_counter, process_time
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.codegen.cache import make_key
from arthur_acausal.sweep.execute import (
    COUNTS,
    KEPT_SYSTEMS,
    Outcome,
    described,
    execute,
    options_of,
    reduced,
    system_of,
)
from arthur_acausal.sweep.job import Job, Signal, Values

if TYPE_CHECKING:
    from arthur_acausal.codegen.compiled import CompiledDAE
    from arthur_acausal.result.solution import Solution
    from arthur_acausal.solve.straight import Runs, Straight

FloatArray = NDArray[np.float64]
ENGINE = "straight"
_DIRECT: dict[str, Direct | None] = {}


def execute_many(job: Job, values: Sequence[Values], timeout: float | None = None) -> list[Outcome]:
    """Simulate several runs of a job; see `execute`."""
    direct = _direct_of(job) if job.batch > 1 else None
    found: Sequence[Outcome | None] = [None] * len(values)
    if direct is not None:
        with suppress(Exception):  # of the user's own functions: made one by one, it is told of which run
            found = direct.run(values)
    return [done or execute(job, one, timeout) for done, one in zip(found, values, strict=True)]


def _direct_of(job: Job) -> Direct | None:
    """Return what makes the runs of a job, None where the engine does not fit; made once for each of the last jobs."""
    if job.digest not in _DIRECT:
        while len(_DIRECT) >= KEPT_SYSTEMS:
            del _DIRECT[next(iter(_DIRECT))]
        _DIRECT[job.digest] = Direct.of(job, system_of(job).dae)
    return _DIRECT[job.digest]


class Direct:
    """The runs of one job; see `of`."""

    def __init__(
        self, job: Job, dae: CompiledDAE, engine: Straight, u: FloatArray, conditions: Sequence[int]
    ) -> None:
        from arthur_acausal.solve.diagnosis import listed

        self._job, self._dae, self._engine, self._u = job, dae, engine, u
        self._conditions = list(conditions)  # of each row of the initial conditions, the state that it says
        table = dae.parameters
        self._base = np.array([info.default for info in table.infos], dtype=float)
        self._given = np.zeros(len(self._base))
        for path, value in job.parameters.items():
            self._base[table.find(path)], self._given[table.find(path)] = value, 1.0
        low, high = ([getattr(info, side) for info in table.infos] for side in ("min", "max"))
        self._low = np.array([-math.inf if value is None else value for value in low])
        self._high = np.array([math.inf if value is None else value for value in high])
        self._times = options_of(job).grid(job.start_time, job.stop_time)[1:]
        ignored = dae.ignored_starts(job.start)
        self._notes = f"start values that nothing uses: {listed(ignored, '; ')}" if ignored else ""
        self._columns = self._simple()
        self._platform = make_key()[:12]

    @classmethod
    def of(cls, job: Job, dae: CompiledDAE) -> Direct | None:
        """Return what makes the runs of a job, None where something does not fit the engine."""
        from arthur_acausal.solve.straight import Straight

        conditions = _conditions(dae)
        if conditions is None or any(isinstance(value, Signal) for value in job.inputs.values()):
            return None
        inputs: dict[str, Any] = dict(job.inputs)
        u = np.array(
            [
                inputs.get(path, default)
                for path, default in zip(dae.u_paths, dae.u_default.tolist(), strict=True)
            ]
        )
        engine = Straight.of(dae, u, options_of(job))
        return None if engine is None else cls(job, dae, engine, u, conditions)

    def run(self, values: Sequence[Values]) -> list[Outcome | None]:
        """Return what comes of each run, None where another engine has to make it."""
        wall, cpu = perf_counter(), process_time()
        p, able = self._vectors(values)
        places = np.flatnonzero(able)
        found: list[Outcome | None] = [None] * len(values)
        if not places.size:
            return found
        p = p[places]
        y = self._start(p)
        inside = np.all((y >= self._dae.minimum) & (y <= self._dae.maximum), axis=1)  # else there is a note
        runs = self._engine.run(p, self._job.start_time, self._times, y)
        made = self._outcomes(p, runs, values, places.tolist())
        each: dict[str, Any] = {
            "wall_s": (perf_counter() - wall) / places.size,
            "cpu_s": (process_time() - cpu) / places.size,
            "engine": ENGINE,
            "platform": self._platform,
        }
        for k, outcome in enumerate(made):
            if inside[k] and not runs.failed[k]:
                found[int(places[k])] = Outcome(**outcome, **each)
        return found

    def _vectors(self, values: Sequence[Values]) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Return the vectors p (N, np) of the runs, and which of them can be made here."""
        dae, table = self._dae, self._dae.parameters
        p, given = np.tile(self._base, (len(values), 1)), np.tile(self._given, (len(values), 1))
        able = np.array([not (one.inputs or one.start) for one in values])
        for k, one in enumerate(values):
            for path, value in one.parameters.items():
                place = table.find(path)
                p[k, place], given[k, place] = value, 1.0
        if table.evaluate is not None:
            p = np.asarray(table.evaluate.map(len(p))(p.T, given.T), dtype=float).T
        able &= np.all((p >= self._low) & (p <= self._high), axis=1)
        starts = np.asarray(dae.functions["starts"].map(len(p))(p.T), dtype=float).reshape(-1, len(p)).T
        for path, value in self._job.start.items():
            number, sign = dae.start_aliases[path]
            starts[:, number] = sign * value
        p = np.hstack([p, starts])
        pivots = np.asarray(dae.functions["pivots"].map(len(p))(p.T), dtype=float).reshape(-1, len(p)).T
        return p, able & np.all((pivots != 0.0) & np.isfinite(pivots), axis=1)

    def _start(self, p: FloatArray) -> FloatArray:
        """Return the states (N, n) at the start."""
        dae, count = self._dae, len(p)
        y = np.zeros((count, dae.n))
        for entry in dae.starts:
            if entry.index >= 0:
                value = p[:, entry.place]
                y[:, entry.index] = np.where(np.isnan(value), y[:, entry.index], entry.sign * value)
        y = np.clip(y, dae.minimum, dae.maximum)
        arguments = self._arguments(p, y)
        slope = np.zeros((dae.n_init, count))
        entries = dae.functions["initial_jacobian"].map(count)(*arguments)
        slope[np.asarray(dae.init_sparsity.row)] = np.array(entries.nonzeros()).reshape(count, -1).T
        value = np.asarray(dae.functions["initial"].map(count)(*arguments), dtype=float).reshape(-1, count)
        y[:, self._conditions] -= (value / slope).T
        return y

    def _arguments(self, p: FloatArray, y: FloatArray) -> list[FloatArray]:
        count = len(p)
        t = np.full((1, count), self._job.start_time)
        return [
            t,
            y.T,
            np.zeros((self._dae.n, count)),
            p.T,
            np.tile(self._u, (count, 1)).T,
            *[np.zeros((0, count))] * 2,
        ]

    def _simple(self) -> list[tuple[str, bool, str, int, int]] | None:
        """Return (name, at the end, kind, index, sign) of each reduction where all are values at an end; else None."""
        job, recovery = self._job, self._dae.recovery
        if job.variables or any(r.kind not in ("final", "initial") for r in job.reductions):
            return None
        sources = [recovery.sources[recovery.find(r.path)] for r in job.reductions]
        if any(source.kind not in ("y", "u", "p", "zero") for source in sources):
            return None
        return [
            (r.name, r.kind == "final", s.kind, s.index, s.sign)
            for r, s in zip(job.reductions, sources, strict=True)
        ]

    def _outcomes(
        self, p: FloatArray, runs: Runs, values: Sequence[Values], places: Sequence[int]
    ) -> list[dict[str, Any]]:
        """Return the fields of each run's outcome."""
        counts = [dict(zip(COUNTS, [*row, 0], strict=True)) for row in runs.counts.astype(int).tolist()]
        if self._columns is None:
            found = []
            for k, place in enumerate(places):
                solution = self._solution(p[k], runs, k, values[place])
                outcome = reduced(self._job, solution, "ok", "")
                found.append(
                    {
                        name: getattr(outcome, name)
                        for name in ("status", "end_time", "reductions", "trajectory")
                    }
                )
        else:
            block: dict[str, list[float]] = {}
            for name, end, kind, index, sign in self._columns:
                y = runs.y[:, -1] if end else runs.y0
                tables = {"y": y, "p": p, "u": np.tile(self._u, (len(p), 1))}
                block[name] = (sign * tables[kind][:, index]).tolist() if kind != "zero" else [0.0] * len(p)
            rows = zip(*block.values(), strict=True)
            found = [
                {
                    "status": "ok",
                    "end_time": float(self._times[-1]),
                    "reductions": dict(zip(block, row, strict=True)),
                }
                for row in (rows if block else [()] * len(p))
            ]
        return [
            {**one, "statistics": count, "notes": self._notes}
            for one, count in zip(found, counts, strict=True)
        ]

    def _solution(self, p: FloatArray, runs: Runs, k: int, values: Values) -> Solution:
        from arthur_acausal.result.simulated import ComputedValues, describe_run
        from arthur_acausal.result.solution import Solution
        from arthur_acausal.solve.trajectory import Trajectory

        job, dae = self._job, self._dae
        t = np.concatenate([[job.start_time], self._times])
        trajectory = Trajectory(
            t,
            np.vstack([runs.y0[k], runs.y[k]]),
            np.vstack([runs.yp0[k], runs.yp[k]]),
            np.tile(self._u, (t.size, 1)),
            np.zeros((t.size, 0)),
            np.zeros((t.size, 0)),
            p,
            job.start_time,
            job.stop_time,
            options_of(job),
        )
        parameters = {**job.parameters, **values.parameters}
        about = describe_run(dae, described(job), trajectory, parameters, dict(job.inputs), job.start)  # type: ignore[arg-type]
        return Solution(ComputedValues(dae, trajectory), about)


def _conditions(dae: CompiledDAE) -> list[int] | None:
    """Return which state each initial condition says, where each says one, linearly, and there is one for each."""
    colind, row = np.asarray(dae.init_sparsity.colind), np.asarray(dae.init_sparsity.row)
    column = np.repeat(np.arange(colind.size - 1), np.diff(colind))
    if (
        dae.n_init != dae.n
        or sorted(row.tolist()) != list(range(dae.n))
        or sorted(column.tolist()) != list(range(dae.n))
    ):
        return None
    nonlinear = dae.functions["initial_jacobian"].jac_sparsity(0, 1).nnz() > 0
    if nonlinear or not dae.differential.all():
        return None
    said = np.zeros(dae.n, dtype=int)
    said[row] = column
    return said.tolist()
