"""A run over several sets of states: where one becomes singular, another takes over from its last values."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from arthur_acausal.codegen.compiled import CompiledDAE
from arthur_acausal.codegen.refine import Rows, refine
from arthur_acausal.codegen.switching import LEAVE_AT, RELATION, SWITCH
from arthur_acausal.result.interpolate import FloatArray
from arthur_acausal.result.variable import Variable
from arthur_acausal.solve.failure import SolverFailure
from arthur_acausal.solve.simulate import initial_point, simulate
from arthur_acausal.solve.statistics import Statistics
from arthur_acausal.solve.trajectory import Event, Trajectory

Variant = Callable[[frozenset[int], bool], CompiledDAE]
"""From a set of dummy derivatives to the system compiled for it; True: as one that continues a run."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A part of a run: a trajectory, and the compiled system that it belongs to."""

    dae: CompiledDAE
    trajectory: Trajectory


def simulate_pieces(
    dae: CompiledDAE,
    variant: Variant | None,
    pieces: list[Piece],
    *,
    start_time: float,
    begin: Trajectory | None = None,
    **arguments: Any,
) -> None:
    """Simulate, appending to ``pieces``; a failing run raises, and what was finished before it stays there.

    ``begin``: consistent values to begin with, of ``dae``. ``arguments`` are those of ``simulate``.
    """
    if dae.sets is None or variant is None:
        done = simulate(dae, start_time=start_time, begin=begin, **arguments)
        if _wants_another_set(done):
            failure = SolverFailure(
                f"the chosen set of states becomes singular at t = {done.t[-1]:.9g} s",
                cause="another one is to take over, and the compiled system alone does not hold it",
                remedy="simulate the translated model itself, which can make it",
            )
            failure.trajectory = done
            raise failure
        pieces.append(Piece(dae, done))
        return
    grid = arguments["options"].grid(start_time, arguments["stop_time"])
    start = arguments.pop("start")
    sets = dae.sets
    if begin is None:
        guessed = _entries_of_guess(dae, arguments.get("parameters"), start)
        if sets.margin(guessed, dae.dummies) <= LEAVE_AT:
            dae = variant(sets.choose(guessed), False)
    point = Piece(dae, begin or initial_point(dae, start_time=start_time, start=start, **arguments))
    current, given = dae, start
    entries = _entries(point)
    if begin is not None or sets.margin(entries, dae.dummies) <= LEAVE_AT:
        current = variant(sets.choose(entries), True)
        given = _values_at_end(point, current)
    time = start_time
    while True:
        times = np.concatenate([[time], grid[grid > time]])
        done = simulate(current, start_time=time, start=given, grid=times, **arguments)
        pieces.append(Piece(current, done))
        if not _wants_another_set(done):
            return
        assert current.sets is not None
        chosen = current.sets.choose(_entries(pieces[-1]))
        current = variant(chosen, True)
        given = _values_at_end(pieces[-1], current)
        time = float(done.t[-1])


def _wants_another_set(done: Trajectory) -> bool:
    """Whether a run was ended because its set of states becomes singular."""
    return done.status == "terminated" and done.message == SWITCH


def _entries_of_guess(
    dae: CompiledDAE, parameters: Mapping[str, Any] | None, start: Mapping[str, Any] | None
) -> FloatArray:
    """Return the entries of the sets' Jacobian at the start values, before they are made consistent."""
    p = dae.parameter_vector(parameters, start)
    evaluator = dae.evaluator()
    guess = dae.attributes(p)
    row = (np.zeros(1), guess.start, np.zeros(dae.n), p, evaluator.u, guess.z_start, evaluator.m)
    return np.asarray(dae.functions["state_sets"](*dae.completed(row, "state_sets")), dtype=float).reshape(-1)


def _last(piece: Piece) -> Rows:
    """Return the last row, its algebraic values and derivatives solved anew from the states."""
    x = piece.trajectory
    rows = Rows(x.t[-1:], x.y[-1:], x.yp[-1:], x.p, x.u[-1:], x.z[-1:], x.m[-1:])
    y, yp = refine(piece.dae, rows)
    return replace(rows, y=y, yp=yp)


def _entries(piece: Piece) -> FloatArray:
    arguments = piece.dae.completed(_last(piece).arguments(), "state_sets")
    return np.asarray(piece.dae.functions["state_sets"](*arguments), dtype=float).reshape(-1)


def _values_at_end(piece: Piece, following: CompiledDAE) -> dict[str, float]:
    """Return the start values of the system that takes over: its states, and the discrete variables."""
    row = _last(piece)
    paths = [entry.path for entry in following.starts]
    values = piece.dae.recovery.observe(paths, row.t, row.y, row.yp, row.p, row.u, row.z, row.m)
    return dict(zip(paths, values[0].tolist(), strict=True))


def joined(pieces: Sequence[Piece], start_time: float, stop_time: float) -> Trajectory:
    """Return what there is to tell of the whole run: the last trajectory, with the events and statistics of all."""
    last = pieces[-1].trajectory
    if len(pieces) == 1:
        return replace(last, start_time=start_time, stop_time=stop_time)
    own = {SWITCH, f"{RELATION.label} became false"}
    events: list[Event] = [e for piece in pieces for e in piece.trajectory.events if e.what not in own]
    statistics = Statistics()
    for piece in pieces:
        for item in fields(Statistics):
            value = getattr(piece.trajectory.statistics, item.name)
            before = getattr(statistics, item.name)
            setattr(statistics, item.name, value if isinstance(value, str) else before + value)
    statistics.unknowns = last.statistics.unknowns
    statistics.messages = [
        f"{len(pieces) - 1} changes of the set of states",
        *dict.fromkeys(statistics.messages),
    ]
    return replace(last, events=events, statistics=statistics, start_time=start_time, stop_time=stop_time)


class PiecewiseValues:
    """Values out of several pieces, one after the other; see ``Values``."""

    def __init__(self, parts: Sequence[Any]) -> None:
        self._parts = parts
        self.t: FloatArray = np.concatenate([part.t for part in parts])
        self.modes: FloatArray = np.concatenate([part.modes for part in parts])
        self.variables: Mapping[str, Variable] = parts[0].variables

    def observe(self, paths: Sequence[str]) -> FloatArray:
        """Values (nt, len(paths)) in SI."""
        return np.concatenate([part.observe(paths) for part in self._parts])

    @property
    def pieces(self) -> list[Piece]:
        """The trajectories of all pieces and their systems."""
        return [piece for part in self._parts for piece in part.pieces]

    def slope(self, state: str) -> FloatArray | None:
        """None: what is a state in one piece may be none in the next."""
        return None
