"""Forward sensitivities dv/dtheta of outputs v to parameters theta along a run, also across its events.

The sensitivity equations (``augmented``) are integrated over each stretch between events, with the same tolerance as
the run. At an event the instant itself moves with theta. For a relation g that changes along the solution,

    dt*/dtheta = -(g_y s + g_p dp/dtheta) / (dg/dt),
    s+ = d(x+)/dtheta - x'+ dt*/dtheta,    d(x+)/dtheta = R_t dt* + R_y (s- + y'- dt*) + R_p dp/dtheta,

where R is what the event makes of the states: Rozenvasser (1967), Automation and Remote Control 28, 1490-1500;
Galan, Feehery and Barton (1999), Appl. Numer. Math. 31, 17-47, eqs. 20 to 24.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from arthur_acausal.analysis.augmented import Augmentation, Point, Stretch
from arthur_acausal.analysis.event_jump import Jump, Side
from arthur_acausal.codegen.compiled import CompiledDAE
from arthur_acausal.codegen.refine import Rows, refine
from arthur_acausal.errors import UsageError
from arthur_acausal.result.chain import Piece
from arthur_acausal.solve.conditions import choose
from arthur_acausal.solve.inputs import Input
from arthur_acausal.solve.protocol import FloatArray
from arthur_acausal.solve.simulate import simulate
from arthur_acausal.solve.trajectory import Trajectory


@dataclass(frozen=True, slots=True)
class Sensitivities:
    """dv/dtheta in SI: ``values`` (nt, n_outputs, n_parameters) at the times ``t`` (nt,) of the run."""

    t: FloatArray
    outputs: list[str]
    parameters: list[str]
    values: FloatArray

    def __getitem__(self, names: tuple[str, str]) -> FloatArray:
        """Return d output / d parameter (nt,) for (output, parameter)."""
        output, parameter = names
        return self.values[:, self.outputs.index(output), self.parameters.index(parameter)]


def sensitivities(
    dae: CompiledDAE,
    pieces: Sequence[Piece],
    outputs: Sequence[str],
    parameters: Sequence[str],
    *,
    given: Mapping[str, Any] | None = None,
    start: Mapping[str, Any] | None = None,
    inputs: Mapping[str, Input] | None = None,
) -> Sensitivities:
    """Return the sensitivities of a finished run.

    Parameters
    ----------
    dae : the system with functions of CasADi expressions (compile="never").
    pieces : the run that was made with ``given`` parameters, ``start`` values and ``inputs``.

    Raises UsageError for a run whose set of states changed, SimulationError for an event across which the
    sensitivities cannot be carried.
    """
    if len(pieces) != 1:
        what = "has no equations: it was read from a file" if not pieces else "changed its set of states"
        raise UsageError(
            f"the run {what}", remedy="sensitivities need one computed run with one set of states"
        )
    if dae.calls:
        raise UsageError(
            f"no sensitivities through {dae.calls[0].label}",
            where=dae.calls[0].where,
            cause="the sensitivity equations need the derivatives of the external function as expressions",
            remedy="take differences of two runs at a tight tolerance",
        )
    return _Along(dae, pieces[0].trajectory, list(parameters), given or {}, start or {}, inputs or {}).run(
        list(outputs)
    )


class _Along:
    """The integration of sensitivities along one run."""

    def __init__(
        self,
        dae: CompiledDAE,
        trajectory: Trajectory,
        parameters: list[str],
        given: Mapping[str, Any],
        start: Mapping[str, Any],
        inputs: Mapping[str, Input],
    ) -> None:
        self.dae, self.x, self.inputs = dae, trajectory, inputs
        self.parameters, self.k = parameters, len(parameters)
        self.dp, self.d_start = _parameter_slopes(dae, trajectory.p, parameters, given, start)
        x = trajectory
        rows = Rows(x.t, x.y, x.yp, x.p, x.u, x.z, x.m)
        self.y, self.yp = refine(dae, rows)
        nominal = dae.nominal
        n_p = len(dae.parameters.infos)
        size = np.abs(x.p[:n_p])[[dae.parameters.find(path) for path in parameters]]
        size = np.where(size > 0.0, size, 1.0)
        self.nominal = np.concatenate([nominal, *(nominal / s for s in size.tolist())])
        self.augmentation = Augmentation.of(dae, self.k)
        self.s = np.zeros((len(x.t), dae.n, self.k))
        self.sp = np.zeros_like(self.s)
        self.dz = np.zeros((len(x.t), len(dae.z_paths), self.k))

    def run(self, outputs: list[str]) -> Sensitivities:
        """Stretch by stretch, and across the events between them."""
        x = self.x
        last = len(x.t) - 1
        s, dz = self._initial()
        first = 0
        while True:
            same = np.flatnonzero(x.t[first + 1 :] == x.t[first:-1])
            end = first + int(same[0]) if same.size else last
            self._stretch(first, end, s, dz)
            if end >= last:
                break
            jump = Jump(self.dae, self._side(end), self._side(end + 1), self._input_slope(end), x.events)
            s, dz = jump.carry(self.s[end], self.sp[end], dz, self.dp)
            first = end + 1
        return Sensitivities(x.t, outputs, self.parameters, self._outputs(outputs))

    def _side(self, row: int) -> Side:
        x = self.x
        return Side(float(x.t[row]), self.y[row], self.yp[row], x.p, x.u[row], x.z[row], x.m[row])

    def _input_slope(self, row: int) -> FloatArray:
        """Return u' just before an event, by a difference."""
        x = self.x
        if row == 0 or x.t[row] == x.t[row - 1]:
            return np.zeros(x.u.shape[1])
        return np.asarray((x.u[row] - x.u[row - 1]) / (x.t[row] - x.t[row - 1]))

    def _stretch(self, first: int, end: int, s: FloatArray, dz: FloatArray) -> None:
        """Integrate from row ``first`` to row ``end``, from the states' sensitivities s (n, k)."""
        x, n, k = self.x, self.dae.n, self.k
        self.dz[first : end + 1] = dz
        point = Point(x.p, np.ascontiguousarray(x.z[first]), np.ascontiguousarray(x.m[first]))
        start = np.concatenate([self.y[first], s.reshape(-1, order="F")])
        model = Stretch(self.augmentation, point, self.dp, dz, start, self.nominal)
        if end == first:
            self.s[first], self.sp[first] = s, 0.0
            return
        done = simulate(
            model,
            start_time=float(x.t[first]),
            stop_time=float(x.t[end]),
            options=x.options.replace(atol=None, store_steps=False),
            inputs=self.inputs,
            grid=x.t[first : end + 1],
        )
        rows = np.searchsorted(done.t, x.t[first : end + 1])
        shape = (end - first + 1, k, n)
        self.s[first : end + 1] = done.y[rows, n:].reshape(shape).transpose(0, 2, 1)
        self.sp[first : end + 1] = done.yp[rows, n:].reshape(shape).transpose(0, 2, 1)

    def _initial(self) -> tuple[FloatArray, FloatArray]:
        """Return dy/dtheta (n, k) at the start, and that of the discrete variables.

        F and the initial conditions that were used hold for every theta: their derivatives are solved for (s, s').
        """
        dae, x, n = self.dae, self.x, self.dae.n
        e = dae.evaluator()
        e.p[:] = x.p
        e.t[0], e.u[:], e.z[:], e.m[:] = x.t[0], x.u[0], x.z[0], x.m[0]
        attributes = dae.attributes(x.p)
        e.y[:] = attributes.start
        chosen = choose(dae, e, attributes)
        point = self._side(0).arguments()
        full = np.vstack([self.dp, self.d_start])
        n_y = dae.n
        states = np.flatnonzero(dae.differential)
        blocks, rights = [], []
        simple = [k for k in range(dae.n_init) if k not in chosen.surplus]
        functions = {"residual": range(n)} | ({"initial": simple} if simple else {})
        for name, rows in functions.items():
            f = dae.functions[name]
            by = [np.array(b, dtype=float)[list(rows)] for b in _slopes(f, point)]
            blocks.append(np.hstack([by[1], by[2][:, states]]))
            rights.append(-by[3] @ full)
        assumed = chosen.assumed
        unit = np.zeros((assumed.size, n_y + states.size))
        unit[np.arange(assumed.size), assumed] = 1.0
        blocks.append(unit)
        rights.append(self._start_slopes(assumed.tolist()))
        matrix = np.vstack(blocks)
        columns = np.concatenate([dae.nominal, dae.nominal[states]])
        scaled = matrix * columns
        rows_of = np.maximum(np.abs(scaled).max(axis=1, initial=0.0), np.finfo(float).tiny)
        right = np.vstack(rights) / rows_of[:, None]
        found = np.linalg.lstsq(scaled / rows_of[:, None], right, rcond=1e-13)[0] * columns[:, None]
        discrete = [entry.place - len(self.dp) for entry in dae.starts if entry.sign == 0]
        return found[:n], self.d_start[discrete]

    def _start_slopes(self, states: list[int]) -> FloatArray:
        """Return the derivatives of the start values of states that have no initial condition."""
        result = np.zeros((len(states), self.k))
        for entry in self.dae.starts:
            if entry.sign and entry.index in states and not np.isnan(self.x.p[entry.place]):
                slope = entry.sign * self.d_start[entry.place - len(self.dp)]
                result[states.index(entry.index)] = slope
        return result

    def _outputs(self, outputs: list[str]) -> FloatArray:
        """Return dv/dtheta: of y and z directly, of eliminated variables by the chain rule."""
        dae, x, k = self.dae, self.x, self.k
        recovery = dae.recovery
        sources = [recovery.sources[recovery.find(path)] for path in outputs]
        observed = self._observed() if any(s.kind == "observed" for s in sources) else np.zeros(0)
        result = np.zeros((len(x.t), len(outputs), k))
        for i, source in enumerate(sources):
            match source.kind:
                case "y":
                    result[:, i] = source.sign * self.s[:, source.index]
                case "yp":
                    result[:, i] = source.sign * self.sp[:, source.index]
                case "z":
                    result[:, i] = source.sign * self.dz[:, source.index]
                case "p":
                    result[:, i] = source.sign * self.dp[source.index]
                case "observed":
                    result[:, i] = source.sign * observed[:, source.index]
        return result

    def _observed(self) -> FloatArray:
        """Return the derivatives (nt, n_observed, k) of all eliminated variables."""
        f, n_p = self.dae.recovery.observed, len(self.dp)
        own = [ca.SX.sym(f"a{i}", f.size1_in(i)) for i in range(f.n_in())]
        s, sp, dz = (ca.SX.sym(name, f.size1_in(i)) for name, i in (("s", 1), ("sp", 2), ("dz", 5)))
        dp = ca.SX.sym("dp", n_p)
        along = ca.vertcat(own[1], own[2], own[3][:n_p], own[5])
        slope = ca.jtimes(f(*own), along, ca.vertcat(s, sp, dp, dz))
        function = ca.Function("slope", [*own, s, sp, dp, dz], [slope])
        count = len(self.x.t)
        mapped = function.map(count)
        x = self.x
        point = Rows(x.t, self.y, self.yp, x.p, x.u, x.z, x.m).arguments()
        columns = []
        for j in range(self.k):
            same = np.repeat(self.dp[:, j].reshape(-1, 1), count, axis=1)
            values = mapped(*point, self.s[:, :, j].T, self.sp[:, :, j].T, same, self.dz[:, :, j].T)
            columns.append(np.asarray(values, dtype=float).T)
        return np.stack(columns, axis=2)


def _slopes(f: ca.Function, point: list[FloatArray]) -> Sequence[Any]:
    """Return the Jacobians of a function's output by each of its arguments."""
    value = f(*point)
    found = f.jacobian()(*point, value)
    return found if isinstance(found, Sequence) else [found]


def _parameter_slopes(
    dae: CompiledDAE,
    p: FloatArray,
    parameters: list[str],
    given: Mapping[str, Any],
    start: Mapping[str, Any],
) -> tuple[FloatArray, FloatArray]:
    """Return dp/dtheta (n_p, k) with what depends on other parameters, and that of the start values behind them."""
    if not parameters:
        raise UsageError("no parameters are given", remedy="name at least one")
    table = dae.parameters
    n_p = len(table.infos)
    chosen = [table.find(path) for path in parameters]
    direct = np.zeros((n_p, len(chosen)))
    direct[chosen, np.arange(len(chosen))] = 1.0
    slope = direct
    if table.evaluate is not None:
        flags = np.zeros(n_p)
        flags[[table.find(path) for path in given] + chosen] = 1.0
        slope = np.array(_slopes(table.evaluate, [p[:n_p], flags])[0], dtype=float) @ direct
    starts = dae.functions["starts"]
    d_start = np.array(_slopes(starts, [p[:n_p]])[0], dtype=float) @ slope
    for path in start:
        d_start[dae.start_aliases[path][0]] = 0.0
    return slope, np.nan_to_num(d_start)
