"""From a compiled model to a `Solution` of it."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from arthur_acausal.codegen.compiled import CompiledDAE
from arthur_acausal.codegen.portable import reference
from arthur_acausal.codegen.recovery import Source
from arthur_acausal.codegen.refine import Rows, refine
from arthur_acausal.errors import UsageError
from arthur_acausal.result.chain import Piece, PiecewiseValues, Variant, joined, simulate_pieces
from arthur_acausal.result.interpolate import FloatArray
from arthur_acausal.result.run import Run
from arthur_acausal.result.solution import Solution
from arthur_acausal.result.variable import Kind, Variable
from arthur_acausal.solve.failure import SolverFailure, SolverInterrupted
from arthur_acausal.solve.inputs import Input
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.table import Table
from arthur_acausal.solve.trajectory import Trajectory


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a simulation; ``solution`` holds what was computed up to there."""

    def __init__(self, solution: Solution) -> None:
        super().__init__(f"interrupted at {solution.t[-1]:g} s")
        self.solution = solution


class ComputedValues:
    """Values out of a trajectory, by what the translation recorded of every variable; see `Values`."""

    def __init__(self, dae: CompiledDAE, trajectory: Trajectory) -> None:
        self._dae = dae
        self._recovery = dae.recovery
        self._trajectory = trajectory
        self._refined: tuple[FloatArray, FloatArray] | None = None
        self._states = {path: k for k, path in enumerate(dae.y_paths) if dae.differential[k]}
        self.t: FloatArray = trajectory.t
        self.modes: FloatArray = trajectory.m
        self.variables = describe(dae)

    def observe(self, paths: Sequence[str]) -> FloatArray:
        """Values (nt, len(paths)) in SI."""
        x = self._trajectory
        y, yp = self._consistent() if self._recovery.needs_refinement(paths) else (x.y, x.yp)
        return self._recovery.observe(paths, x.t, y, yp, x.p, x.u, x.z, x.m)

    def ends(self, paths: Sequence[str]) -> FloatArray:
        """Values (2, len(paths)) at the first and the last time."""
        x = self._trajectory
        rows = Rows(x.t, x.y, x.yp, x.p, x.u, x.z, x.m).part(np.array([0, -1]))
        y, yp = refine(self._dae, rows) if self._recovery.needs_refinement(paths) else (rows.y, rows.yp)
        return self._recovery.observe(paths, rows.t, y, yp, rows.p, rows.u, rows.z, rows.m)

    @property
    def pieces(self) -> list[Piece]:
        """The trajectory and its system."""
        return [Piece(self._dae, self._trajectory)]

    def _consistent(self) -> tuple[FloatArray, FloatArray]:
        """Return y and y', algebraic unknowns and derivatives solved anew from the states; once."""
        if self._refined is None:
            x = self._trajectory
            self._refined = refine(self._dae, Rows(x.t, x.y, x.yp, x.p, x.u, x.z, x.m))
        return self._refined

    def slope(self, state: str) -> FloatArray | None:
        """dx/dt (nt,) of a state as the integrator has it."""
        return self._trajectory.yp[:, self._states[state]] if state in self._states else None


def describe(dae: CompiledDAE) -> dict[str, Variable]:
    """Unit, kind and description of every variable of a model, by path."""
    recovery = dae.recovery
    rows = zip(
        recovery.paths,
        recovery.sources,
        recovery.units,
        recovery.displays,
        recovery.descriptions,
        strict=True,
    )
    found = {}
    for path, source, unit, display, description in rows:
        kind, state = kind_of(dae, path, source)
        sign = float(source.sign) if state else 1.0
        refined = kind == "eliminated" and bool(recovery.interpolated[source.index])
        found[path] = Variable(path, unit, kind, description, display or "", state, sign, refined)
    return found


def kind_of(dae: CompiledDAE, path: str, source: Source) -> tuple[Kind, str]:
    """What a variable is, and the state that it equals up to sign."""
    match source.kind:
        case "y":
            kept = dae.y_paths[source.index]
            state = kept if dae.differential[source.index] else ""
            own: Kind = "state" if state else "algebraic"
            return (own if kept == path else "alias"), state
        case "u":
            return ("input" if dae.u_paths[source.index] == path else "alias"), ""
        case "z":
            return "discrete", ""
        case "p":
            return "parameter", ""
        case "zero":
            return "constant", ""
        case "observed":
            return "eliminated", ""
        case _:
            return "algebraic", ""


def run(
    dae: CompiledDAE,
    model: object,
    *,
    stop_time: float,
    start_time: float,
    options: SolverOptions,
    parameters: Mapping[str, Any] | None,
    inputs: Mapping[str, Input] | None,
    start: Mapping[str, Any] | None,
    progress: Callable[[float], None] | None,
    variant: Variant | None = None,
    begin: Trajectory | None = None,
) -> Solution:
    """Simulate and return the solution.

    ``variant`` compiles the model for another set of states, where one may become singular. ``begin``: consistent
    values to begin with.
    Raises SimulationError or Interrupted, whose ``solution`` holds what was computed, where the run stops
    early.
    """
    given = {"parameters": parameters or {}, "inputs": inputs or {}, "start": start or {}}

    pieces: list[Piece] = []

    def wrap() -> Solution:
        parts = [ComputedValues(piece.dae, piece.trajectory) for piece in pieces]
        values = parts[0] if len(parts) == 1 else PiecewiseValues(parts)
        whole = joined(pieces, start_time, stop_time)
        return Solution(values, describe_run(pieces[-1].dae, model, whole, **given))

    try:
        simulate_pieces(
            dae,
            variant,
            pieces,
            stop_time=stop_time,
            start_time=start_time,
            options=options,
            inputs=inputs,
            parameters=parameters,
            start=start,
            progress=progress,
            begin=begin,
        )
    except SolverFailure as error:
        if error.trajectory is not None:
            pieces.append(Piece(dae, error.trajectory))
            error.solution = wrap()
        raise
    except SolverInterrupted as error:
        pieces.append(Piece(dae, error.trajectory))
        raise Interrupted(wrap()) from None
    return wrap()


def describe_run(
    dae: CompiledDAE,
    model: object,
    trajectory: Trajectory,
    parameters: Mapping[str, Any],
    inputs: Mapping[str, Input],
    start: Mapping[str, Any],
) -> Run:
    """All that is to be kept with a solution about how it came about."""
    table = dae.parameters
    terms, beside = getattr(model, "audit_terms", None), getattr(model, "beside", None)
    return Run(
        model=dae.name,
        description=(inspect.getdoc(model) or "").partition("\n")[0],
        start_time=trajectory.start_time,
        stop_time=trajectory.stop_time,
        status=trajectory.status,
        message=trajectory.message,
        parameters={path: float(trajectory.p[table.find(path)]) for path in parameters},
        inputs={path: describe_input(value) for path, value in inputs.items()},
        start={
            path: value if isinstance(value, int | float) else str(value) for path, value in start.items()
        },
        options=trajectory.options,
        statistics=trajectory.statistics,
        events=tuple(trajectory.events),
        audit=terms() if terms is not None else {},
        externals=[*described(dae)],
        beside=beside() if beside is not None else {},
    )


def described(dae: CompiledDAE) -> Iterator[dict[str, Any]]:
    """Yield the external functions that say how they are made, in terms of JSON."""
    for call in dae.calls:
        if hasattr(call.function, "describe"):
            with suppress(UsageError):  # of a class that other processes do not find
                name, data = reference(call.function)
                yield {"path": call.path, "function": name, "data": data}


def describe_input(value: Input) -> float | str:
    """An input as metadata: its value, or where its values came from."""
    if isinstance(value, Table):
        return value.source
    if callable(value):
        return getattr(value, "__qualname__", type(value).__name__)
    return float(value)
