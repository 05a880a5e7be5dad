"""How sensitivities go across one event; see ``sensitivity``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np

from arthur_acausal.codegen.compiled import CompiledDAE
from arthur_acausal.errors import SimulationError
from arthur_acausal.solve.protocol import FloatArray
from arthur_acausal.solve.trajectory import Event

AGREES = 1e-6  # of the value: what the clauses say once must be what the event has made


@dataclass(frozen=True, slots=True)
class Side:
    """All values just before or just after an event."""

    t: float
    y: FloatArray
    yp: FloatArray
    p: FloatArray
    u: FloatArray
    z: FloatArray
    m: FloatArray

    def arguments(self) -> list[FloatArray]:
        """Return the arguments of the kernels."""
        return [np.array([self.t]), self.y, self.yp, self.p, self.u, self.z, self.m]


class Jump:
    """One event between two rows of a run; ``du``: u' before it; ``events``: those of the run."""

    def __init__(
        self, dae: CompiledDAE, before: Side, after: Side, du: FloatArray, events: Sequence[Event]
    ) -> None:
        self.dae, self.before, self.after, self.du = dae, before, after, du
        self.m = _within(dae, after, events)
        self.states = np.flatnonzero(dae.differential)
        self.other = np.flatnonzero(~dae.differential)

    def carry(
        self, s: FloatArray, sp: FloatArray, dz: FloatArray, dp: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return (dy/dtheta, dz/dtheta) after the event from those before it, (n, k) and (n_z, k) each."""
        rates = self._rates()
        moved = self._moved(s, dz, dp, rates[0])
        change = self._change(s, sp, dz, dp, moved, rates)
        acting = self._acting()
        values, slopes = self._values(change)
        self._check(acting, values)
        d_y, d_z = change[1].copy(), change[5].copy()
        for k in acting:
            target = self.dae.assignments[k]
            if target.kind == "state":
                d_y[target.index] = slopes[k]
            elif target.kind == "discrete":
                d_z[target.index] = slopes[k]
        result = d_y - np.outer(self.after.yp, moved)
        return result, d_z

    def _rates(self) -> tuple[FloatArray, FloatArray]:
        """Return (dy/dt, dy'/dt) before the event: of states as they are, of the rest from dF/dt = 0."""
        f, point = self.dae.functions["residual"], self.before.arguments()
        by = _slopes(f, point)
        rate = np.where(self.dae.differential, self.before.yp, 0.0)
        known = by[0][:, 0] + by[1] @ rate + by[4] @ self.du
        matrix = np.hstack([by[2][:, self.states], by[1][:, self.other]])
        found = np.linalg.lstsq(matrix, -known, rcond=None)[0] if matrix.size else np.zeros(0)
        second = np.zeros_like(rate)
        second[self.states] = found[: self.states.size]
        rate[self.other] = found[self.states.size :]
        return rate, second

    def _moved(self, s: FloatArray, dz: FloatArray, dp: FloatArray, rate: FloatArray) -> FloatArray:
        """Return dt*/dtheta (k,): zero where nothing but a jump of an input or a sample makes the event."""
        before, n_p = self.before, len(dp)
        changed = np.flatnonzero(before.m != self.m)
        if not changed.size:
            return np.zeros(dp.shape[1])
        f, point = self.dae.functions["roots"], [*before.arguments(), before.z]
        by = [b[changed] for b in _slopes(f, point)]
        value = np.array(f(*point), dtype=float).reshape(-1)[changed]
        along = by[0][:, 0] + by[1] @ rate + by[4] @ self.du
        slope = by[1] @ s + by[3][:, :n_p] @ dp + (by[5] + by[7]) @ dz
        with np.errstate(divide="ignore", invalid="ignore"):
            away = np.abs(value / along)
        first = int(np.argmin(np.where(np.isfinite(away), away, np.inf)))
        if not np.isfinite(away[first]):
            relation = self.dae.relations[changed[first]]
            raise SimulationError(
                f"sensitivities end at t = {before.t:g} s: {relation.label} changes without passing through zero",
                where=relation.where,
                cause="how its instant depends on parameters is not determined",
            )
        return np.asarray(-slope[first] / along[first])

    def _change(
        self,
        s: FloatArray,
        sp: FloatArray,
        dz: FloatArray,
        dp: FloatArray,
        moved: FloatArray,
        rates: tuple[FloatArray, FloatArray],
    ) -> list[FloatArray]:
        """Return the total derivatives of the kernels' arguments at the moving instant."""
        full = np.zeros((len(self.before.p), dp.shape[1]))
        full[: len(dp)] = dp
        n_m = np.zeros((len(self.before.m), dp.shape[1]))
        return [
            moved.reshape(1, -1),
            s + np.outer(rates[0], moved),
            sp + np.outer(rates[1], moved),
            full,
            np.outer(self.du, moved),
            dz,
            n_m,
        ]

    def _acting(self) -> list[int]:
        """Return the assignments of the clauses whose conditions became true, and of discrete equations."""
        dae, before = self.dae, self.before
        f = dae.functions["conditions"]
        at = before.arguments()
        held = np.array(f(*at, before.z), dtype=float).reshape(-1) > 0.5
        now = np.array(f(*at[:6], self.m, before.z), dtype=float).reshape(-1) > 0.5
        rises = now & ~held
        acts = rises.copy()
        for k, clause in enumerate(dae.whens):
            if clause.earlier and acts[k - clause.earlier : k].any():
                acts[k] = False
        return [k for k, a in enumerate(dae.assignments) if a.when < 0 or acts[a.when]]

    def _values(self, change: list[FloatArray]) -> tuple[FloatArray, FloatArray]:
        """Return what all assignments give at the event, and its derivatives (n_assignments, k)."""
        before = self.before
        f = self.dae.functions["when_values"]
        point = [*before.arguments()[:6], self.m, before.z]
        values = np.array(f(*point), dtype=float).reshape(-1)
        by = _slopes(f, point)
        slopes = sum(
            (b @ d for b, d in zip(by, [*change, change[5]], strict=True)), np.zeros_like(by[0] @ change[0])
        )
        return values, np.asarray(slopes)

    def _check(self, acting: list[int], values: FloatArray) -> None:
        """Raise SimulationError where one pass over the clauses does not give what the event has made."""
        dae, before, after = self.dae, self.before, self.after
        y, z = before.y.copy(), before.z.copy()
        for k in acting:
            target = dae.assignments[k]
            if target.kind == "state":
                y[target.index] = values[k]
            elif target.kind == "discrete":
                z[target.index] = values[k]
        nominal = dae.nominal[self.states]
        state_error = np.abs(y - after.y)[self.states] / np.maximum(nominal, np.abs(after.y[self.states]))
        z_error = np.abs(z - after.z) / np.maximum(1.0, np.abs(after.z))
        if max(state_error.max(initial=0.0), z_error.max(initial=0.0)) > AGREES:
            raise SimulationError(
                f"sensitivities end at t = {before.t:g} s",
                cause="the event there goes in several steps, or a sampled function acts, whose derivative is unknown",
                remedy="stop the run before it, or take differences of two runs",
            )


def _within(dae: CompiledDAE, after: Side, events: Sequence[Event]) -> FloatArray:
    """Return the relations' modes within the event: a bounce makes true for an instant what is false again after it."""
    m = after.m.copy()
    told = {event.what for event in events if event.time == after.t and event.kind in ("state", "time")}
    for k, relation in enumerate(dae.relations):
        for value, word in enumerate(("false", "true")):
            if f"{relation.label} became {word}" in told:
                m[k] = value
    return m


def _slopes(f: ca.Function, point: list[FloatArray]) -> list[FloatArray]:
    """Return the Jacobians of a function's output by each of its arguments."""
    found = f.jacobian()(*point, f(*point))
    return [np.array(block, dtype=float) for block in found]
