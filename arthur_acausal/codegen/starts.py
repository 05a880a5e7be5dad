"""Start values and other attributes of the unknowns, merged over the variables that share one."""

from __future__ import annotations

import math

import numpy as np
from casadi import SX
from numpy.typing import NDArray

from arthur_acausal.codegen.assemble import StartSlot
from arthur_acausal.declare.scope import Declared
from arthur_acausal.errors import InitializationError
from arthur_acausal.transform.structured import StructuredDAE

FloatArray = NDArray[np.float64]


def collect_starts(dae: StructuredDAE) -> list[StartSlot]:
    """Return the start values that count: for each unknown all fixed ones, else the outermost that was given.

    Unknowns of the integrator without one get a place for it, which a run may fill.

    Raises InitializationError where a fixed start stands against something known.
    """
    candidates: dict[int, list[tuple[int, int, Declared]]] = {}
    for i, declared in enumerate(dae.flat.variables):
        if declared.start is None or declared.start.value is None:
            continue
        ref = dae.nodes.of_variable(i)
        if ref.kind == "node":
            candidates.setdefault(ref.number, []).append((declared.depth, ref.sign, declared))
        elif declared.start.fixed:
            _check_known(declared, ref.kind)
    slots: list[StartSlot] = []
    for node, found in candidates.items():
        fixed = [c for c in found if c[2].start is not None and c[2].start.fixed]
        chosen = fixed or [min(found, key=lambda c: c[0])]
        for _, sign, declared in chosen:
            assert declared.start is not None
            value: float | SX = declared.start.value  # type: ignore[assignment]
            slots.append(StartSlot(node, sign, value, bool(fixed), declared.path, declared.where))
    empty = [n for n in dae.causal.states + dae.causal.torn if n not in candidates]
    return slots + [StartSlot(n, 1, math.nan, False, dae.nodes.name(n)) for n in empty]


def ignored_starts(dae: StructuredDAE, y_nodes: list[int]) -> list[str]:
    """Return notes of the start values that were given for a place where nothing uses them, and of why."""
    kept = set(y_nodes)
    taken: dict[int, list[Declared]] = {}
    for i, declared in enumerate(dae.flat.variables):
        if declared.start is not None and declared.guessed and not declared.start.fixed:
            ref = dae.nodes.of_variable(i)
            if ref.kind == "node":
                taken.setdefault(ref.number, []).append(declared)
    notes = []
    for node, found in taken.items():
        best = min(found, key=lambda d: d.depth)
        if node not in kept:
            notes += [f"{d.path} ({d.where}): it is computed from other unknowns" for d in found]
        else:
            notes += [
                f"{d.path} ({d.where}): that of {best.path}, which equals it, counts"
                for d in found
                if d is not best and str(d.start) != str(best.start)
            ]
    return notes


def _check_known(declared: Declared, kind: str) -> None:
    assert declared.start is not None
    value = declared.start.value
    if kind == "zero" and isinstance(value, int | float) and value == 0.0:
        return
    known = "always zero" if kind == "zero" else "an external input"
    raise InitializationError(
        f"a fixed start value, but the variable is {known}", path=declared.path, remedy="remove fixed=True"
    )


def attribute_arrays(dae: StructuredDAE, y_nodes: list[int]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return nominal (the outermost given, else the largest declared, else 1), min and max of y."""
    place = {node: k for k, node in enumerate(y_nodes)}
    nominal = np.ones(len(y_nodes))
    best = [(math.inf, 0.0)] * len(y_nodes)
    low, high = np.full(len(y_nodes), -np.inf), np.full(len(y_nodes), np.inf)
    for i, declared in enumerate(dae.flat.variables):
        ref = dae.nodes.of_variable(i)
        if ref.kind != "node" or ref.number not in place:
            continue
        k, quantity = place[ref.number], declared.quantity
        given = declared.start.nominal if declared.start is not None else None
        value = given if given is not None else quantity.nominal
        if value is not None:
            rank = (declared.depth if given is not None else math.inf, -value)
            if rank < best[k]:
                best[k], nominal[k] = rank, value
        lower = -math.inf if quantity.min is None else quantity.min
        upper = math.inf if quantity.max is None else quantity.max
        if ref.sign < 0:
            lower, upper = -upper, -lower
        low[k], high[k] = max(low[k], lower), min(high[k], upper)
    return nominal, low, high
