"""Homogeneity: both sides of every equation have one dimension, checked once a component class."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from fractions import Fraction

import casadi as ca
from casadi import SX

from arthur_acausal.declare.scope import Atom, Declared, Scope
from arthur_acausal.errors import UnitError
from arthur_acausal.flatten.block import Assignment, Block, Call, Expression, make_expression, shortened
from arthur_acausal.units import Dimension, divide, format_dimension, multiply, parse_unit, power

ANY = None  # the dimension of zero and of infinity, which fit everywhere
_ONE: Dimension = parse_unit("1").dimension
_SECOND: Dimension = parse_unit("s").dimension

_SAME = {ca.OP_ADD, ca.OP_SUB, ca.OP_FMIN, ca.OP_FMAX, ca.OP_FMOD, ca.OP_REMAINDER, ca.OP_HYPOT}
_COMPARE = {ca.OP_LT, ca.OP_LE, ca.OP_EQ, ca.OP_NE}
_KEEP = {ca.OP_NEG, ca.OP_FABS, ca.OP_TWICE, ca.OP_FLOOR, ca.OP_CEIL, ca.OP_ASSIGN}
_LOGIC = {ca.OP_AND, ca.OP_OR, ca.OP_NOT}


Memo = dict[int, Dimension | None]


class _MismatchError(Exception):
    """Two dimensions that should be one; what should be done."""

    def __init__(
        self, message: str, remedy: str = "give constants with a dimension as parameters with a unit"
    ):
        super().__init__(message)
        self.remedy = remedy


def check_block(block: Block, scope: Scope, path: str) -> None:
    """Raise UnitError unless the block's equations, relations and assignments are homogeneous."""
    for equation in block.equations + block.initial:
        with _located(lambda: f"{equation.lhs} == {equation.rhs}", path, equation.label, equation.where):  # noqa: B023
            memo = _memo(equation.residual, scope)
            sides = _dimension(equation.lhs, memo), _dimension(equation.rhs, memo)
            _same(*sides, "the left side", "the right side")
    for relation in block.relations:
        with _located(lambda: relation.text, path, "", relation.where):  # noqa: B023
            _dimension(relation.g.value, _memo(relation.g, scope))
    for call in block.calls:
        _check_call(call, scope, path)
    for clause in block.clauses:
        for assignment in clause.assignments:
            _check_assignment(assignment, scope, path, clause.label)


def _check_assignment(assignment: Assignment, scope: Scope, path: str, label: str) -> None:
    target, value = assignment.target, assignment.value
    if target is None:
        return
    with _located(lambda: f"{scope.name(target)} becomes {value.value}", path, label, assignment.where):
        given = _dimension(value.value, _memo(value, scope))
        _same(_of(target, scope), given, scope.name(target), "its new value")


def _check_call(call: Call, scope: Scope, path: str) -> None:
    for k, expression in enumerate(call.inputs):
        what = f"input {k} of {call.function.name}"
        with _located(lambda: f"{what}, {expression.value}", path, call.label, call.where):  # noqa: B023
            given = _dimension(expression.value, _memo(expression, scope))
            wanted = parse_unit(call.units[k]).dimension if call.units else ANY
            _same(wanted, given, "the function's unit", "what it is given")


def check_values(scope: Scope) -> None:
    """Raise UnitError unless every value that is an expression of parameters has the dimension of its quantity."""
    known: set[tuple[int, str]] = set()
    for declared in scope.parameter + scope.variable + scope.discrete:
        value = declared.value if declared.start is None else declared.start.value
        if not isinstance(value, SX) or value.is_constant():
            continue
        key = (value.element_hash(), declared.quantity.unit)
        if key not in known:
            known.add(key)
            _check_value(value, declared, scope)


def _check_value(value: SX, declared: Declared, scope: Scope) -> None:
    with _located(lambda: f"the value {value}", declared.path, "", declared.where):
        found = _dimension(value, _memo(make_expression(value, declared.where, scope), scope))
        _same(parse_unit(declared.quantity.unit).dimension, found, declared.quantity.name, "the value")


@contextmanager
def _located(what: Callable[[], str], path: str, label: str, where: str) -> Iterator[None]:
    """Raise a mismatch as a UnitError; ``what`` tells what is being checked."""
    try:
        yield
    except _MismatchError as mismatch:
        message = f"{shortened(what())}: {mismatch}"
        raise UnitError(message, path=path, equation=label, where=where, remedy=mismatch.remedy) from None


def _same(a: Dimension | None, b: Dimension | None, name_a: str, name_b: str) -> None:
    if a is not ANY and b is not ANY and a != b:
        texts = format_dimension(_sure(a)), format_dimension(_sure(b))
        raise _MismatchError(f"{name_a} is {texts[0]}, but {name_b} is {texts[1]}")


def _memo(expression: Expression, scope: Scope) -> Memo:
    """Return the dimensions of the expression's symbols, by their hash."""
    pairs = zip(expression.symbols, expression.atoms, strict=True)
    return {symbol.element_hash(): _of(atom, scope) for symbol, atom in pairs}


def _of(atom: Atom, scope: Scope) -> Dimension | None:
    if atom.kind == "external":
        unit = scope.external[atom.number].unit
        return parse_unit(unit).dimension if unit else ANY
    quantity = scope.quantity(atom)
    if quantity is None:
        return _SECOND if atom.kind == "time" else _ONE
    dimension = parse_unit(quantity.unit).dimension
    return divide(dimension, _SECOND) if atom.kind == "der" else dimension


def _dimension(expression: SX, memo: Memo) -> Dimension | None:
    """Return the dimension of an expression; children first, without recursion in depth."""
    stack = [expression]
    while stack:
        node = stack[-1]
        key = node.element_hash()
        if key in memo:
            stack.pop()
            continue
        if node.is_constant():
            value = float(node)
            if value != value:
                raise _MismatchError(
                    "it contains a constant that is not a number (NaN)",
                    "use casadi's functions: math.sqrt(x), float(x) and the like have no value for a symbol",
                )
            memo[key] = ANY if value == 0.0 or abs(value) == float("inf") else _ONE
            continue
        parts = [node.dep(i) for i in range(node.n_dep())]
        waiting = [p for p in parts if p.element_hash() not in memo]
        if waiting:
            stack.extend(waiting)
            continue
        memo[key] = _operation(node, parts, [memo[p.element_hash()] for p in parts])
        stack.pop()
    return memo[expression.element_hash()]


def _operation(node: SX, parts: list[SX], dims: list[Dimension | None]) -> Dimension | None:
    op = node.op()
    if op in _SAME or op in _COMPARE:
        agreed = _agree(node, parts, dims)
        return _ONE if op in _COMPARE else agreed
    if op in _KEEP:
        return dims[0]
    if op in _LOGIC or op == ca.OP_SIGN:
        return _ONE
    if op == ca.OP_COPYSIGN:
        return dims[0]
    if op == ca.OP_IF_ELSE_ZERO:
        return dims[1]
    if op == ca.OP_MUL:
        return ANY if ANY in dims else multiply(_sure(dims[0]), _sure(dims[1]))
    if op == ca.OP_DIV:
        return ANY if dims[0] is ANY else divide(_sure(dims[0]), _ONE if dims[1] is ANY else _sure(dims[1]))
    if op in (ca.OP_SQ, ca.OP_SQRT, ca.OP_INV):
        exponent = {ca.OP_SQ: Fraction(2), ca.OP_SQRT: Fraction(1, 2), ca.OP_INV: Fraction(-1)}[op]
        return ANY if dims[0] is ANY else power(_sure(dims[0]), exponent)
    if op in (ca.OP_POW, ca.OP_CONSTPOW):
        return _power(node, parts, dims)
    if op == ca.OP_ATAN2:
        _agree(node, parts, dims)
        return _ONE
    for part, dimension in zip(parts, dims, strict=True):
        if dimension not in (ANY, _ONE):
            raise _MismatchError(
                f"{node} needs a plain number, but {part} is {format_dimension(_sure(dimension))}"
            )
    return _ONE


def _agree(node: SX, parts: list[SX], dims: list[Dimension | None]) -> Dimension | None:
    known = [d for d in dims if d is not ANY]
    if len(known) == 2 and known[0] != known[1]:
        a, b = (format_dimension(_sure(d)) for d in known)
        raise _MismatchError(f"{parts[0]} is {a}, but {parts[1]} is {b}")
    return known[0] if known else ANY


def _power(node: SX, parts: list[SX], dims: list[Dimension | None]) -> Dimension | None:
    if dims[1] not in (ANY, _ONE):
        raise _MismatchError(
            f"the exponent {parts[1]} is {format_dimension(_sure(dims[1]))}, not a plain number"
        )
    if dims[0] in (ANY, _ONE):
        return dims[0]
    if not parts[1].is_constant():
        raise _MismatchError(
            f"{parts[0]} is {format_dimension(_sure(dims[0]))}: its exponent must be a number"
        )
    return power(_sure(dims[0]), Fraction(float(parts[1])).limit_denominator(1000))


def _sure(dimension: Dimension | None) -> Dimension:
    return _ONE if dimension is None else dimension
