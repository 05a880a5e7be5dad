"""Sampled blocks: functions called at a fixed period, their results held or ramped in between."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

from casadi import SX

from arthur_acausal.declare.quantity import Quantity, Start
from arthur_acausal.declare.scope import Declared, Scope, current_scope
from arthur_acausal.declare.vector import scalars
from arthur_acausal.errors import DeclarationError

Expression: TypeAlias = "SX | float"


@dataclass(frozen=True, slots=True)
class Sampled:
    """A function that is called at a fixed period; ``outputs`` are discrete variables that take its results.

    With a first-order hold ``outputs`` are the slopes of ramps, ``begins`` their beginnings, ``since`` [s] is the time
    when they began, all discrete variables of the block's own; ``equations`` give the ramps.
    """

    function: Callable[..., Any]
    period: SX
    offset: SX
    inputs: tuple[SX, ...]
    outputs: tuple[SX, ...]
    begins: tuple[SX, ...] = ()
    since: SX | None = None
    trigger: SX | None = None
    equations: tuple[SX, ...] = ()


def sampled(
    function: Callable[..., Any],
    *,
    period: Expression,
    offset: Expression = 0.0,
    inputs: Sequence[Expression] = (),
    outputs: Sequence[SX] = (),
    hold: Literal["zero", "first"] = "zero",
    trigger: Expression | None = None,
) -> Sampled:
    """Call ``function(t, inputs)`` at t = offset, offset + period, ... and hold its results in ``outputs``.

    Parameters
    ----------
    function : takes the time [s] and an array of the inputs just before it, in SI; returns one number an output.
        A CasADi function of (t, inputs) will do. A class with a state of its own gives ``fresh()``, which returns
        a new one for each run.
    period, offset : of parameters [s]; the period is positive.
    inputs : expressions; a vector counts as so many.
    outputs : with hold="zero" discrete variables, which nothing else changes; with hold="first" continuous
        variables, which this determines: each starts at its start value.
    hold : "first": a result is reached at the end of the period that it is computed at the beginning of, on a straight
        line from where the output is. The output is continuous and one period late.
    trigger : of discrete variables: where an earlier block has changed its value at the same moment, the function is
        called, too, whatever its own period says, which goes on as if it had not been.

    Functions that are due at the same moment are called one after the other, each with what the earlier ones have
    set: those of a component in the order of its statements, before those of its parts in the order of declaration.
    """
    scope = current_scope("sampled()")
    if hold not in ("zero", "first"):
        raise DeclarationError(f"hold is {hold!r}", remedy='choose "zero" or "first"')
    outputs = scalars(outputs)
    wanted = "discrete" if hold == "zero" else "variable"
    for output in outputs:
        atom = scope.atom(output)
        if atom is None or atom.kind != wanted:
            what = "a discrete variable" if hold == "zero" else "a continuous variable where hold is first"
            remedy = "discrete(...)" if hold == "zero" else "variable(...) or real_output(...)"
            raise DeclarationError(
                f"an output of sampled() is {what}, not {output}", remedy=f"declare it with {remedy}"
            )
    taken = (SX(period), SX(offset), scalars(inputs))
    called = None if trigger is None else SX(trigger)
    if hold == "zero":
        return Sampled(function, *taken, outputs, trigger=called)
    return _ramped(scope, function, taken, outputs, called)


def _ramped(
    scope: Scope,
    function: Callable[..., Any],
    taken: tuple[SX, SX, tuple[SX, ...]],
    outputs: tuple[SX, ...],
    trigger: SX | None,
) -> Sampled:
    """Return a block with a first-order hold, with discrete variables for the ramps: u.begin, u.rate and u.since."""
    t, since = scope.symbol("time", 0), SX(0.0)
    begins, rates, equations = [], [], []
    for k, output in enumerate(outputs):
        atom = scope.atom(output)
        assert atom is not None
        declared = scope.variable[atom.number]
        unit, first = declared.quantity.unit, declared.start.value if declared.start is not None else None
        if not k:
            since = _hidden(scope, declared, "since", "s", 0.0)
        begins.append(_hidden(scope, declared, "begin", unit, 0.0 if first is None else first))
        rates.append(_hidden(scope, declared, "rate", f"{unit}/s", 0.0))
        equations.append(output == begins[k] + rates[k] * (t - since))
    held = since if outputs else None
    return Sampled(function, *taken, tuple(rates), tuple(begins), held, trigger, tuple(equations))


def _hidden(scope: Scope, owner: Declared, name: str, unit: str, start: Any) -> SX:
    """Return a discrete variable that the block itself declares, beside the output that it is for."""
    quantity = Quantity("discrete", unit, start=0.0, fixed=True, name=name)
    path = f"{owner.path}.{name}"
    scope.discrete.append(Declared(path, quantity, start=Start(start, True), where=owner.where))
    return scope.symbol("discrete", len(scope.discrete) - 1)
