"""Running ``equations()``: the statements of one component, each with its label and source line."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import casadi as ca
import numpy as np
from casadi import SX
from numpy.typing import NDArray

from arthur_acausal.declare.external import External, ExternalFunction
from arthur_acausal.declare.model import Component
from arthur_acausal.declare.sampled import Sampled
from arthur_acausal.declare.scope import Atom, Scope, using
from arthur_acausal.declare.statement import Connection, Reinit, Terminate, When
from arthur_acausal.errors import DeclarationError
from arthur_acausal.flatten.statements import bad, each_of, statements

BoolArray = NDArray[np.bool_]

SHOWN = 100  # characters of an equation that a message shows


@dataclass(frozen=True, slots=True, eq=False)
class Expression:
    """An expression over the symbols of a scope; ``atoms`` are what its symbols stand for, in their order.

    ``through``: of an equation of an external function, the positions of the symbols that it depends on by way of
    the function; all of the function's inputs are among the symbols.
    """

    value: SX
    symbols: list[SX]
    atoms: list[Atom]
    through: frozenset[int] | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Equation:
    """``lhs == rhs``; ``residual`` is lhs - rhs. ``name`` is the label in quotes, or the beginning of the equation."""

    lhs: SX
    rhs: SX
    residual: Expression
    label: str
    where: str
    name: str

    @property
    def symbols(self) -> list[SX]:
        """The symbols of both sides."""
        return self.residual.symbols

    @property
    def atoms(self) -> list[Atom]:
        """What the symbols stand for."""
        return self.residual.atoms


@dataclass(frozen=True, slots=True, eq=False)
class Assignment:
    """At an event ``target`` (a variable or a discrete) takes ``value``; or the run ends with ``message``."""

    target: Atom | None
    value: Expression
    message: str
    where: str


@dataclass(frozen=True, slots=True, eq=False)
class Clause:
    """The assignments of one ``when``; ``condition`` None: they hold at every event (a discrete equation)."""

    condition: Expression | None
    assignments: tuple[Assignment, ...]
    label: str
    where: str
    earlier: int = 0  # branches of the same when before this one, which go first


@dataclass(frozen=True, slots=True, eq=False)
class Sampling:
    """A function that is called periodically; ``outputs`` are discrete variables.

    Where these are the slopes of ramps: the beginnings, and the one that holds the time when they began, follow.
    """

    function: Callable[..., Any]
    period: Expression
    offset: Expression
    inputs: tuple[Expression, ...]
    outputs: tuple[Atom, ...]
    begins: tuple[Atom, ...]
    since: Atom | None
    trigger: Expression | None
    label: str
    where: str


@dataclass(frozen=True, slots=True, eq=False)
class Call:
    """A call of an external function; ``first`` is the number of its first output, ``units`` are of its inputs."""

    function: ExternalFunction
    inputs: tuple[Expression, ...]
    units: tuple[str, ...]
    sparsity: BoolArray
    first: int
    label: str
    where: str


@dataclass(frozen=True, slots=True, eq=False)
class Comparison:
    """A relation that makes events: true where ``g`` > 0, or >= 0 if ``inclusive``."""

    g: Expression
    inclusive: bool
    where: str
    text: str


@dataclass(slots=True)
class Block:
    """All statements of one component."""

    equations: list[Equation] = field(default_factory=list)
    initial: list[Equation] = field(default_factory=list)
    connections: list[tuple[Connection, str]] = field(default_factory=list)
    clauses: list[Clause] = field(default_factory=list)
    relations: list[Comparison] = field(default_factory=list)
    samplings: list[Sampling] = field(default_factory=list)
    calls: list[Call] = field(default_factory=list)


def run_block(component: Component, scope: Scope) -> Block:
    """Run ``equations()`` and ``initial_equations()`` of a bound component."""
    block = Block()
    first = len(scope.relations)
    with using(scope):
        for statement, label, where in statements(component, scope, "equations"):
            _sort(statement, label, where, component, scope, block)
        for statement, label, where in statements(component, scope, "initial_equations"):
            if not _is_equation(statement):
                raise bad(component, where, f"initial_equations() yields equations only, not {statement!r}")
            block.initial.append(make_equation(statement, label, where, scope))
    block.relations = [
        Comparison(
            _of_now(make_expression(r.g, r.where, scope), r.where, scope), r.inclusive, r.where, r.text
        )
        for r in scope.relations[first:]
    ]
    return block


def _is_equation(statement: Any) -> bool:
    return (
        isinstance(statement, SX)
        and statement.numel() == 1
        and not statement.is_leaf()
        and statement.op() == ca.OP_EQ
    )


def _sort(statement: Any, label: str, where: str, component: Component, scope: Scope, block: Block) -> None:
    if isinstance(statement, Connection):
        block.connections.append((statement, where))
    elif isinstance(statement, When):
        for earlier, (condition, statements) in enumerate(statement.branches):
            assignments = tuple(
                _assignment(each, where, component, scope) for s in statements for each in each_of(s, where)
            )
            tested = make_expression(condition, where, scope)
            block.clauses.append(Clause(tested, assignments, label, where, earlier))
    elif isinstance(statement, Sampled):
        block.samplings.append(_sampling(statement, label, where, scope))
        block.equations.extend(make_equation(e, label, where, scope) for e in statement.equations)
    elif isinstance(statement, External):
        _add_call(statement, label, where, scope, block)
    elif _is_equation(statement):
        target = scope.atom(statement.dep(0))
        if target is not None and target.kind == "discrete":
            block.clauses.append(
                Clause(None, (_assignment(statement, where, component, scope),), label, where)
            )
        else:
            block.equations.append(make_equation(statement, label, where, scope))
    elif isinstance(statement, bool) or (isinstance(statement, SX) and statement.is_constant()):
        truth = "true" if bool(statement) else "false"
        raise bad(
            component,
            where,
            f"an equation that is always {truth}: both sides are the same expression, or numbers",
            "remove it, or write what was meant",
        )
    else:
        raise bad(
            component,
            where,
            f"{statement!r} is no equation",
            "yield lhs == rhs, a pair (label, lhs == rhs), connect(...), when(...) or external(...)",
        )


def _sampling(statement: Sampled, label: str, where: str, scope: Scope) -> Sampling:
    period, offset, *inputs = (
        make_expression(x, where, scope) for x in (statement.period, statement.offset, *statement.inputs)
    )
    outputs, begins = (
        tuple(atom for x in symbols if (atom := scope.atom(x)) is not None)
        for symbols in (statement.outputs, statement.begins)
    )
    since = scope.atom(statement.since) if statement.since is not None else None
    trigger = make_expression(statement.trigger, where, scope) if statement.trigger is not None else None
    if trigger is not None and any(a.kind not in ("discrete", "parameter") for a in trigger.atoms):
        raise DeclarationError(
            f"the trigger {trigger.value} is not of discrete variables alone",
            path=scope.prefix.rstrip("."),
            where=where,
            remedy="let a discrete variable change where the function is to be called",
        )
    return Sampling(
        statement.function, period, offset, tuple(inputs), outputs, begins, since, trigger, label, where
    )


def _add_call(statement: External, label: str, where: str, scope: Scope, block: Block) -> None:
    """Add the call, and an equation for each of its outputs."""
    inputs = tuple(make_expression(x, where, scope) for x in statement.inputs)
    first = scope.atom(statement.symbols[0]).number if statement.symbols else 0  # type: ignore[union-attr]
    block.calls.append(
        Call(statement.function, inputs, statement.units, statement.sparsity, first, label, where)
    )
    for k, (output, symbol) in enumerate(zip(statement.outputs, statement.symbols, strict=True)):
        equation = make_equation(output == symbol, f"{label}[{k}]" if label else "", where, scope)
        residual = _through(equation.residual, inputs, statement.sparsity[k])
        block.equations.append(replace(equation, residual=residual))


def _through(own: Expression, inputs: tuple[Expression, ...], present: BoolArray) -> Expression:
    """Return the expression with the symbols of all inputs; it depends on those of the inputs ``present``."""
    position = {symbol.element_hash(): i for i, symbol in enumerate(own.symbols)}
    symbols, atoms = list(own.symbols), list(own.atoms)
    through = set()
    for expression, there in zip(inputs, present.tolist(), strict=True):
        for symbol, atom in zip(expression.symbols, expression.atoms, strict=True):
            place = position.setdefault(symbol.element_hash(), len(symbols))
            if place == len(symbols):
                symbols.append(symbol)
                atoms.append(atom)
            if there:
                through.add(place)
    return Expression(own.value, symbols, atoms, frozenset(through))


def _assignment(statement: Any, where: str, component: Component, scope: Scope) -> Assignment:
    if isinstance(statement, Terminate):
        return Assignment(None, make_expression(SX(0.0), where, scope), statement.message, where)
    if isinstance(statement, Reinit):
        target = scope.atom(statement.target)
        if target is None or target.kind != "variable":
            raise bad(component, where, "reinit() takes a variable as its target")
        return Assignment(target, make_expression(statement.value, where, scope), "", where)
    if _is_equation(statement):
        target = scope.atom(statement.dep(0))
        if target is not None and target.kind == "discrete":
            return Assignment(target, make_expression(statement.dep(1), where, scope), "", where)
    raise bad(
        component,
        where,
        "inside when() stand reinit(state, value), terminate(message), and discrete == value",
        "declare what changes at events only as discrete(...)",
    )


def make_equation(statement: SX, label: str, where: str, scope: Scope) -> Equation:
    """Return the equation behind a ``lhs == rhs``, its symbols looked up in ``scope``."""
    lhs, rhs = statement.dep(0), statement.dep(1)
    name = f'"{label}"' if label else shortened(f"{lhs} == {rhs}")
    residual = _of_now(make_expression(lhs - rhs, where, scope), where, scope)
    return Equation(lhs, rhs, residual, label, where, name)


def _of_now(expression: Expression, where: str, scope: Scope) -> Expression:
    """Return the expression. Raises DeclarationError where it has a continuous variable's value before an event."""
    for atom in expression.atoms:
        if atom.kind == "left":
            raise DeclarationError(
                f"{scope.name(atom)} of a continuous variable in an equation or a relation",
                path=scope.prefix.rstrip("."),
                where=where,
                cause="it is known at events only: it stands for the value just before",
                remedy="use the variable itself, or keep its value in a discrete one, set by when",
            )
    return expression


def shortened(text: str) -> str:
    """Return the beginning of a text for a message."""
    return text if len(text) <= SHOWN else text[: SHOWN - 3] + "..."


def make_expression(value: SX, where: str, scope: Scope) -> Expression:
    """Return the expression with its symbols looked up in ``scope``."""
    symbols = ca.symvar(value)
    atoms = []
    for symbol in symbols:
        atom = scope.atom(symbol)
        if atom is None:
            raise DeclarationError(
                f"{symbol} belongs to no component of this model",
                path=scope.prefix.rstrip("."),
                where=where,
                remedy="use the quantities of this component and of its parts only",
            )
        atoms.append(atom)
    return Expression(value, symbols, atoms)
