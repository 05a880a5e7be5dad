"""What equations are made of beside ``==``: der, pre, time, initial, homotopy, if_else, connect, when, ..."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

import casadi as ca
from casadi import SX

from arthur_acausal.declare.model import Connector, Model
from arthur_acausal.declare.readable import readable
from arthur_acausal.declare.scope import Relation, Scope, current_scope
from arthur_acausal.declare.vector import mapped
from arthur_acausal.errors import DeclarationError

Expression: TypeAlias = "SX | float"


@dataclass(frozen=True, slots=True)
class Connection:
    """Two connectors, or two signals, that meet."""

    a: Any
    b: Any


@dataclass(frozen=True, slots=True)
class Reinit:
    """At an event the state ``target`` jumps to ``value``; a vector of states to a vector, or all to one value."""

    target: SX
    value: SX


@dataclass(frozen=True, slots=True)
class Terminate:
    """At an event the run ends, successfully, with a message."""

    message: str


@dataclass(frozen=True, slots=True)
class When:
    """Statements that are carried out at the moment when ``condition`` becomes true.

    ``branches``: (condition, statements) of the ``when`` and of each ``elsewhen`` behind it.
    """

    branches: tuple[tuple[SX, tuple[Any, ...]], ...]

    def elsewhen(self, condition: SX, *statements: Any) -> When:
        """Add statements for ``condition``, unless one of the branches before becomes true at the same moment."""
        return When((*self.branches, *when(condition, *statements).branches))


def time() -> SX:
    """Return the symbol of time [s]."""
    return current_scope("time()").symbol("time", 0)


def initial() -> SX:
    """Return a condition that holds while the initial values are sought, and never afterwards."""
    return current_scope("initial()").symbol("initial", 0)


def homotopy(actual: Expression, simplified: Expression) -> SX:
    """Return ``actual``; where the initial values are not found at once, they are first sought with ``simplified``.

    From there ``homotopy * actual + (1 - homotopy) * simplified`` leads to ``actual`` in steps. Simplified laws are
    best linear, or constant. Once the run has begun there is ``actual`` only.
    """
    part = current_scope("homotopy()").symbol("homotopy", 0)
    return part * actual + (1 - part) * simplified


def der(x: SX) -> SX:
    """Return the time derivative of a variable, or of an expression by the chain rule."""
    scope = current_scope("der()")
    atom = scope.atom(x)
    if atom is not None and atom.kind == "variable":
        return scope.symbol("der", atom.number)
    if not isinstance(x, SX):
        raise DeclarationError(f"der() takes a variable or an expression of variables, not {x!r}")
    if x.numel() != 1:
        return mapped(x, der)
    result = SX(0.0)
    for symbol in ca.symvar(x):
        found = scope.atom(symbol)
        if found is None or found.kind in (
            "parameter",
            "discrete",
            "pre",
            "mode",
            "initial",
            "homotopy",
            "external",
        ):
            continue
        if found.kind == "der":
            raise DeclarationError(
                f"second derivative of {scope.name(found)[4:-1]}",
                remedy="declare a variable for the first derivative: v == der(s), then der(v)",
            )
        rate = SX(1.0) if found.kind == "time" else scope.symbol("der", found.number)
        result = result + ca.jacobian(x, symbol) * rate
    return result


def pre(x: SX) -> SX:
    """Return the value just before the event: of a discrete variable, or (inside ``when``) of a continuous one."""
    scope = current_scope("pre()")
    if isinstance(x, SX) and x.numel() != 1:
        return mapped(x, pre)
    atom = scope.atom(x)
    if atom is None or atom.kind not in ("discrete", "variable"):
        raise DeclarationError("pre() takes a variable", remedy="apply it to each variable of the expression")
    return scope.symbol("pre" if atom.kind == "discrete" else "left", atom.number)


def if_else(condition: Expression | bool, then: Expression, otherwise: Expression) -> SX:
    """Return ``then`` where ``condition`` holds, else ``otherwise``; each relation of the condition makes an event."""
    scope = current_scope("if_else()")
    if isinstance(condition, bool):
        return SX(then if condition else otherwise)
    if not scope.makes_events:
        return smooth_if_else(condition, then, otherwise)
    return smooth_if_else(event_condition(scope, SX(condition)), then, otherwise)


def smooth_if_else(condition: Expression, then: Expression, otherwise: Expression) -> SX:
    """Return ``then`` where ``condition`` holds, else ``otherwise``, without an event.

    For laws that are continuous where the condition changes: the integrator's error control meets the kink.
    """
    return ca.if_else(condition, then, otherwise)


def event_condition(scope: Scope, condition: SX) -> SX:
    """Return ``condition`` with every relation in it replaced by the symbol of its frozen mode."""
    if condition.numel() != 1:
        return mapped(condition, lambda element: event_condition(scope, element))
    if condition.is_constant() or condition.is_symbolic():
        return condition
    op = condition.op()
    if op in (ca.OP_LT, ca.OP_LE):
        left, right = condition.dep(0), condition.dep(1)
        relation = Relation(right - left, op == ca.OP_LE, "", readable(condition))
        scope.relations.append(relation)
        return scope.symbol("mode", len(scope.relations) - 1)
    if op == ca.OP_NOT:
        return ca.logic_not(event_condition(scope, condition.dep(0)))
    if op in (ca.OP_AND, ca.OP_OR):
        parts = event_condition(scope, condition.dep(0)), event_condition(scope, condition.dep(1))
        return ca.logic_and(*parts) if op == ca.OP_AND else ca.logic_or(*parts)
    raise DeclarationError(
        f"{condition} is no condition",
        remedy="a condition is made of <, <=, >, >= and casadi's logic_and, logic_or, logic_not",
    )


def connect(a: Any, b: Any) -> Connection:
    """Connect two connectors (potentials equal, flows sum to zero), or an output signal to an input signal."""
    for side in (a, b):
        if not isinstance(side, Connector | SX):
            raise DeclarationError(
                f"connect() takes connectors or signals, not {side!r}", remedy=_connectable(side)
            )
    return Connection(a, b)


def _connectable(side: Any) -> str:
    """Return a hint at what of ``side`` can be connected."""
    if side is None:
        return "a part that may be absent is connected under a condition: `if self.part is not None:`"
    if not isinstance(side, Model):
        return "connect connectors (self.a.port), or an output with an input"
    kinds = {"input", "output"}
    names = [n for n, part in side._declarations.parts.items() if isinstance(part, Connector)]
    names += [n for n, q in side._declarations.quantities.items() if q.kind in kinds]
    return (
        f"its connectors and signals are {', '.join(names)}" if names else "it has no connectors or signals"
    )


def when(condition: SX, *statements: Any) -> When:
    """At the moment when ``condition`` becomes true: ``reinit`` states, set discrete variables (``d == value``)."""
    scope = current_scope("when()")
    if not statements:
        raise DeclarationError(
            "when() without statements", remedy="write what happens: when(condition, reinit(...), d == value)"
        )
    if SX(condition).numel() != 1:
        raise DeclarationError(
            f"the condition of when() is a column of {SX(condition).numel()}",
            remedy="combine its elements by casadi.logic_or or logic_and, or write one when() for each",
        )
    return When(((event_condition(scope, SX(condition)), statements),))


def edge(x: SX) -> SX:
    """Return whether a discrete (0 or 1) variable has just become true; for conditions of ``when``."""
    return ca.logic_and(x, ca.logic_not(pre(x)))


def reinit(target: SX, value: Expression) -> Reinit:
    """Inside ``when``: let the state ``target`` jump to ``value``."""
    return Reinit(target, SX(value))


def terminate(message: str) -> Terminate:
    """Inside ``when``: end the run with a message."""
    return Terminate(message)
