"""Consistent values at the start of a run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from arthur_acausal.errors import InitializationError
from arthur_acausal.solve.conditions import Conditions, choose
from arthur_acausal.solve.conflict import check_surplus
from arthur_acausal.solve.consistent import ConsistentSystem
from arthur_acausal.solve.continuation import Point, homotopy, pseudo_transient, resting
from arthur_acausal.solve.diagnosis import listed
from arthur_acausal.solve.initial_failure import NEARER, failure, undetermined
from arthur_acausal.solve.modes import Modes
from arthur_acausal.solve.newton import Solved
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.protocol import DAE, Attributes, Evaluator
from arthur_acausal.solve.trajectory import Trajectory

UNSETTLED = "the relations do not settle"


@dataclass(frozen=True, slots=True)
class Initialized:
    """What the initialisation did; the values themselves are in the evaluator.

    ``terminated``: the message of a terminate() that acts at the start.
    """

    iterations: int
    method: str
    messages: list[str]
    terminated: str | None = None


def initialize(
    dae: DAE,
    evaluator: Evaluator,
    attributes: Attributes,
    modes: Modes,
    options: SolverOptions,
) -> Initialized:
    """Find y, y', z and the relations' modes that fulfil all equations and initial conditions at evaluator.t.

    Raises InitializationError, naming equations and unknowns.
    """
    if dae.starting is None:
        return _Start(dae, evaluator, attributes, modes, options).run()
    starting = dae.starting.evaluator()
    starting.t[:], starting.u[:] = evaluator.t, evaluator.u
    starting.p[: evaluator.p.size] = evaluator.p
    done = _Start(dae.starting, starting, attributes, Modes(dae.starting, starting), options).run()
    Point.of(starting).restore(evaluator)
    _enter(dae, evaluator, attributes, modes, options)
    return done


def adopt(point: Trajectory, evaluator: Evaluator, modes: Modes) -> Initialized:
    """Take consistent values that are known already: the last row of a trajectory of the same model."""
    evaluator.y[:], evaluator.yp[:] = point.y[-1], point.yp[-1]
    evaluator.z[:], evaluator.m[:] = point.z[-1], point.m[-1]
    modes.settle()
    statistics = point.statistics
    return Initialized(statistics.initial_iterations, statistics.initial_method, list(statistics.messages))


def _enter(
    dae: DAE, evaluator: Evaluator, attributes: Attributes, modes: Modes, options: SolverOptions
) -> None:
    """Go over from the equations of the start to those of the run: the states stay."""
    algebraic = np.flatnonzero(~dae.differential)
    system = ConsistentSystem(dae, evaluator, attributes, algebraic, algebraic[:0])
    solved = _settled(system, modes, options)
    if solved.reason:
        raise failure(dae, evaluator, system, solved)
    modes.settle()


class _Start:
    """The search for initial values; it works in place on the evaluator."""

    def __init__(
        self, dae: DAE, evaluator: Evaluator, attributes: Attributes, modes: Modes, options: SolverOptions
    ) -> None:
        self._dae, self._evaluator, self._attributes = dae, evaluator, attributes
        self._modes, self._options = modes, options

    def run(self) -> Initialized:
        """Choose the conditions, solve, and check those that were left out."""
        dae, evaluator, attributes, modes = self._dae, self._evaluator, self._attributes, self._modes
        evaluator.y[:], evaluator.yp[:] = attributes.start, 0.0
        evaluator.z[:] = evaluator.zp[:] = attributes.z_start
        modes.update()
        conditions = choose(dae, evaluator, attributes)
        if conditions.undetermined:
            raise undetermined(dae, conditions)
        free = np.setdiff1d(np.arange(dae.n), conditions.pinned)
        system = ConsistentSystem(dae, evaluator, attributes, free, conditions.rows)
        method, iterations = self._solve(system)
        check_surplus(dae, evaluator, attributes, conditions)
        messages = _notices(dae, attributes, evaluator, conditions)
        if method != "Newton":
            messages.append(f"initial values found by {method}: Newton's method failed from the start values")
        terminated = self._act()
        modes.settle()
        return Initialized(iterations, method, messages, terminated)

    def _solve(self, system: ConsistentSystem) -> tuple[str, int]:
        """Newton's method; where it fails, the ways around. Return which one led there, and its iterations."""
        evaluator, modes, options = self._evaluator, self._modes, self._options
        begin = Point.of(evaluator)

        def attempt() -> Solved:
            return _settled(system, modes, options)

        solved = attempt()
        iterations = solved.iterations
        if not solved.reason:
            return "Newton", iterations
        error = (
            self._unsettled() if solved.reason == UNSETTLED else failure(self._dae, evaluator, system, solved)
        )
        tried = []
        for method in self._methods(system):
            begin.restore(evaluator)
            if method == "homotopy":
                solved = homotopy(evaluator, attempt)
            else:
                rest = resting(self._dae, evaluator, system)
                solved = pseudo_transient(evaluator, system, rest, modes, options, attempt)
            iterations += solved.iterations
            if not solved.reason:
                return method, iterations
            tried.append(f"{method}: {solved.reason}")
        if tried:
            error.cause = "; ".join([*([error.cause] if error.cause else []), *tried])
        raise error

    def _methods(self, system: ConsistentSystem) -> list[str]:
        """The ways around that this model offers."""
        rests = resting(self._dae, self._evaluator, system)[0].size > 0
        return ["pseudo-transient"] * rests + ["homotopy"] * self._dae.blends

    def _unsettled(self) -> InitializationError:
        most = self._options.max_event_iterations
        return InitializationError(
            f"the relations do not settle in {most} iterations: {self._modes.last_changed()}", remedy=NEARER
        )

    def _act(self) -> str | None:
        """Reinitialise what `when` clauses that name initial() say; return the message of their terminate()."""
        message = None
        for k, action in self._modes.initial_actions():
            if action.kind == "state":
                self._evaluator.y[action.index] = self._evaluator.when_values()[k]
            elif action.kind == "terminate":
                message = action.message
        return message


def _settled(system: ConsistentSystem, modes: Modes, options: SolverOptions) -> Solved:
    """Solve until relations and discrete variables agree with the values."""
    iterations = 0
    for _ in range(options.max_event_iterations):
        solved = system.solve(options.newton_tolerance, options.newton_iterations)
        iterations += solved.iterations
        if solved.reason or not (modes.assign_discrete() | modes.update()):
            return Solved(solved.w, solved.reason, iterations, solved.correction, solved.factors)
    return Solved(system.unknowns(), UNSETTLED, iterations, np.inf)


def _notices(dae: DAE, attributes: Attributes, evaluator: Evaluator, conditions: Conditions) -> list[str]:
    """What was assumed."""
    messages = []
    if conditions.assumed.size:
        chosen = conditions.assumed.tolist()
        names = [f"{dae.y_paths[j]} = {evaluator.y[j]:g}{attributes.origin[j]}" for j in chosen]
        messages.append(f"no initial condition, start value taken: {listed(names)}")
    if conditions.surplus:
        labels = [dae.init_labels[k] for k in conditions.surplus]
        messages.append(f"initial conditions that say nothing new: {listed(labels)}")
    low, high = attributes.min, attributes.max
    outside = np.flatnonzero((evaluator.y < low) | (evaluator.y > high))
    if outside.size:
        names = [f"{dae.y_paths[j]} = {evaluator.y[j]:g}" for j in outside.tolist()]
        messages.append(f"initial values outside min and max: {listed(names)}")
    return messages
