"""What happens at one instant: relations change, `when` clauses act, all equations become consistent again.

The iteration follows Modelica: relations and discrete variables are updated until they agree, with the values of the
pass before as previous ones. A relation takes the truth value that it has just after the instant, so that an event
that is handled leaves no relation on the wrong side by a rounding error, and events closer together than the
resolution are one. Modelica Language Specification 3.6, appendix B.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from arthur_acausal.errors import SimulationError
from arthur_acausal.solve.consistent import ConsistentSystem
from arthur_acausal.solve.diagnosis import listed
from arthur_acausal.solve.initial_failure import failure
from arthur_acausal.solve.law import NEARBY, Law, same
from arthur_acausal.solve.modes import Modes
from arthur_acausal.solve.newton import Index, Solve
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.protocol import DAE, Attributes, BoolArray, Evaluator, FloatArray
from arthur_acausal.solve.trajectory import Event

AFTER = "check what reinit sets, and that the equations have a solution after the event"
DIFFERENCE = 1e-7  # forward difference, relative to the time in which a state moves by its own magnitude
TRUST = 10.0  # a relation that IDA found to change has changed while g is within so many tolerances of zero
TRUSTED_PASSES = (
    10  # modes that go round because one of them is held so: from then on the present values decide
)
TINY = 1e-300


@dataclass(slots=True)
class Outcome:
    """What an event did.

    Attributes
    ----------
    events : one for each relation that changed, `when` clause that acted, and termination.
    iterations : Newton iterations.
    affected : whether the continuous equations or their states have changed: integration must start anew.
    terminate : the message of a terminate() that was reached.
    """

    events: list[Event] = field(default_factory=list)
    iterations: int = 0
    affected: bool = False
    terminate: str | None = None


class EventIteration:
    """Handles the events of one model; it works in place on the evaluator."""

    def __init__(
        self,
        dae: DAE,
        evaluator: Evaluator,
        attributes: Attributes,
        modes: Modes,
        options: SolverOptions,
        scheduled: BoolArray,
    ) -> None:
        self._dae, self._evaluator, self._modes, self._options = dae, evaluator, modes, options
        algebraic = np.flatnonzero(~dae.differential)
        self._has_algebraic = bool(algebraic.size)
        self._system = ConsistentSystem(dae, evaluator, attributes, algebraic, algebraic[:0])
        self._scheduled = scheduled
        self._factors: Solve | None = None
        self._scale, self._scaled = np.zeros(len(dae.relations)), False
        self._law = Law(dae, evaluator, self._system.nominal, options.rtol)
        self._modes_before = np.zeros(0, dtype=bool)
        self._sampled = False

    def handle(
        self,
        flagged: Mapping[int, bool],
        resolution: float,
        inputs_jump: bool = False,
        sample: Callable[[], None] | None = None,
    ) -> Outcome:
        """Handle the event at the evaluator's t, y, y'. `flagged` are relations known to change, and to what.

        `resolution` is the time, s, within which events are one. `sample` sets discrete variables from the values
        just before the event.
        """
        evaluator, outcome = self._evaluator, Outcome(affected=inputs_jump)
        self._modes_before = before = evaluator.m > 0.5
        self._sampled = sample is not None
        self._law.keep()
        if sample is not None:
            sample()
        pending, reset = inputs_jump or not same(evaluator.z, evaluator.zp), False
        moving: Index = np.zeros(0, dtype=np.intp)
        trusted = dict(flagged)
        for number in range(self._options.max_event_iterations):
            doubtful = reset or number > TRUSTED_PASSES
            modes = self._right_limit(
                trusted, resolution, np.inf if number == 0 else 0.0 if doubtful else TRUST
            )
            moving = (modes != (evaluator.m > 0.5)).nonzero()[0]
            evaluator.m[:] = modes
            rising = self._rising()
            risen = np.count_nonzero(rising) > 0
            pending |= moving.size > 0
            quiet = number > 0 and not moving.size and not risen
            if quiet and not pending:
                break
            if pending and self._has_algebraic and risen:
                self._follow(outcome, inputs_jump)  # what the `when` clauses read must hold in the new modes
            g = evaluator.roots().copy() if trusted and risen else None
            acted, was_reset = self._act(rising, outcome)
            if acted and g is not None:  # a threshold that was moved says what holds, however near it is
                now = evaluator.roots()
                trusted = {k: value for k, value in trusted.items() if now[k] == g[k]}
            reset |= was_reset
            if acted or pending:
                self._follow(outcome, was_reset or inputs_jump)
            pending = not same(evaluator.z, evaluator.zp)
            evaluator.zp[:] = evaluator.z
            if quiet and not pending:  # the next pass would see what this one has seen
                break
        else:
            raise self._unsettled(moving)
        self._relation_events(before, flagged, outcome)
        return outcome

    def _follow(self, outcome: Outcome, changed: bool) -> None:
        """Solve for consistent values, unless F is what it was: then the event concerns discrete variables only.

        Where a sample only bends the course of F, as a first-order hold does, the values are consistent as they are:
        the integration goes on, and its error test sees the bend.
        """
        bends = self._sampled and same(self._evaluator.m > 0.5, self._modes_before)
        if changed or self._law.changed(bends):
            self._solve(outcome)
            outcome.affected = True
        self._law.keep()

    def make_consistent(self) -> None:
        """Solve for algebraic variables and derivatives where no event has: after interpolation they are only near."""
        self._solve(Outcome())

    def rates(self, refresh: Callable[[float], None], duration: float) -> FloatArray | None:
        """Second derivatives of the states at the present consistent values, (n,); zero for algebraic variables.

        The algebraic variables' derivatives go into y': IDA extrapolates with them. None if they are not finite.
        `duration` is the time, s, over which the model moves at most by its own magnitude.
        """
        evaluator, system = self._evaluator, self._system
        if not system.size:
            return np.zeros(0)
        factors, self._factors = self._factors or self._factorised(), None
        if factors is None:
            return None
        t = float(evaluator.t[0])
        speed = np.abs(evaluator.yp[system.states]) / np.maximum(
            np.abs(evaluator.y[system.states]), system.nominal[system.states]
        )
        ahead = DIFFERENCE * min(duration, 1.0 / max(float(speed.max(initial=0.0)), TINY))
        now = evaluator.residual().copy()
        evaluator.t[0] = t + ahead
        refresh(t + ahead)
        rates = system.rates(factors, ahead, now)
        evaluator.t[0] = t
        refresh(t)
        if not np.isfinite(rates).all():
            return None
        evaluator.yp[system.free] = rates[: system.free.size]
        second = np.zeros(self._dae.n)
        second[system.states] = rates[system.free.size :]
        return second

    def _right_limit(self, flagged: Mapping[int, bool], resolution: float, trust: float) -> BoolArray:
        """Truth values just after the instant.

        Flagged relations have the value they are known to take as long as their g is no larger than `trust` times
        the tolerance on their scale: algebraic variables move by about that much when they are solved for anew.
        """
        evaluator = self._evaluator
        if not evaluator.m.size:
            return np.zeros(0, dtype=bool)
        if flagged or not self._scaled:  # of time alone: g is zero at the event, but was not at the start
            self._rescale()
        t, y = float(evaluator.t[0]), evaluator.y.copy()
        evaluator.t[0] = t + resolution
        np.add(y, resolution * evaluator.yp, out=evaluator.y)
        g = evaluator.roots()
        evaluator.t[0], evaluator.y[:] = t, y
        truth = self._modes.truth(g)
        for k, value in flagged.items():
            if trust == np.inf or abs(g[k]) <= trust * self._options.rtol * self._scale[k]:
                truth[k] = value
        return truth

    def _rescale(self) -> None:
        """Magnitudes of the relations' g, from here and from values as far away as the unknowns are large."""
        evaluator, y = self._evaluator, self._evaluator.y.copy()
        g = evaluator.roots().copy()
        evaluator.y[:] += self._law.away / NEARBY * np.maximum(np.abs(y), self._system.nominal)
        elsewhere = np.nan_to_num(evaluator.roots(), nan=0.0, posinf=0.0, neginf=0.0)
        self._scale = np.maximum(self._scale, np.maximum(np.abs(g), np.abs(elsewhere - g)))
        evaluator.y[:] = y
        self._scaled = True

    def _rising(self) -> BoolArray:
        """Conditions that have become true since the last pass."""
        if not self._modes.conditions.size:
            return self._modes.conditions
        now = self._evaluator.conditions() > 0.5
        rising = now > self._modes.conditions
        self._modes.conditions = now
        for k in rising.nonzero()[0].tolist():
            earlier = self._dae.whens[k].earlier
            rising[k] = not (earlier and rising[k - earlier : k].any())
        return rising

    def _act(self, rising: BoolArray, outcome: Outcome) -> tuple[bool, bool]:
        """Do what the risen `when` clauses and the always active equations say: whether anything, a state, changed."""
        dae, evaluator = self._dae, self._evaluator
        active = [(k, a) for k, a in enumerate(dae.assignments) if a.when < 0 or rising[a.when]]
        if not active:
            return False, False
        before = evaluator.z.copy()
        values = evaluator.when_values().copy()
        for _ in range(len(active)):  # a value may depend on a discrete variable assigned in the same pass
            last = evaluator.z.copy()
            for k, a in active:
                if a.kind == "discrete":
                    evaluator.z[a.index] = values[k]
            if np.array_equal(last, evaluator.z):
                break
            values = evaluator.when_values().copy()
        reset = False
        for k, a in active:
            if a.kind == "state":
                reset |= bool(evaluator.y[a.index] != values[k])
                evaluator.y[a.index] = values[k]
            elif a.kind == "terminate":
                outcome.terminate = a.message
        for number in np.flatnonzero(rising).tolist():
            when = dae.whens[number]
            outcome.events.append(Event(float(evaluator.t[0]), when.label, when.path, "when", when.where))
        return reset or not np.array_equal(before, evaluator.z), reset

    def _solve(self, outcome: Outcome) -> None:
        """Make the algebraic variables and the derivatives consistent with the states, modes and discrete values."""
        if not self._system.size:
            return
        solved = self._system.solve(self._options.newton_tolerance, self._options.newton_iterations)
        self._factors = solved.factors
        outcome.iterations += solved.iterations
        if solved.reason:
            raise failure(self._dae, self._evaluator, self._system, solved, AFTER)

    def _factorised(self) -> Solve | None:
        """Factors at the present values, which stay as they are; None if they are singular."""
        evaluator = self._evaluator
        y, yp = evaluator.y.copy(), evaluator.yp.copy()
        solved = self._system.solve(self._options.newton_tolerance, self._options.newton_iterations)
        evaluator.y[:], evaluator.yp[:] = y, yp
        return None if solved.reason else solved.factors

    def _relation_events(self, before: BoolArray, flagged: Mapping[int, bool], outcome: Outcome) -> None:
        """One entry for each relation that was known to change or has changed."""
        after = self._evaluator.m > 0.5
        if not flagged and same(before, after):
            return
        t = float(self._evaluator.t[0])
        changes = {int(k): bool(after[k]) for k in np.flatnonzero(before != after)} | dict(flagged)
        entries = []
        for k, value in sorted(changes.items()):
            relation = self._dae.relations[k]
            what = f"{relation.label} became {'true' if value else 'false'}"
            kind = "time" if self._scheduled[k] else "state"
            entries.append(Event(t, what, relation.path, kind, relation.where))
        outcome.events[:0] = entries

    def _unsettled(self, moving: Index) -> SimulationError:
        """What to tell when the passes come to no end."""
        names = listed([self._dae.relations[int(k)].label for k in moving], "; ")
        return SimulationError(
            f"chattering at t = {self._evaluator.t[0]:.9g} s: {names or 'a discrete variable'} changes back as soon "
            "as it has changed",
            cause="on both sides of the relation the model moves back towards it, so that neither side holds",
            remedy="add a state for sliding or sticking, a hysteresis, or use a smooth law",
        )
