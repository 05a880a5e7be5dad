"""Homogeneity: both sides of every equation have one dimension, checked once a component class."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca
from casadi import SX

from arthur_acausal.declare.scope import Scope
from arthur_acausal.errors import UnitError
from arthur_acausal.flatten.block import Equation
from arthur_acausal.units import Dimension, divide, format_dimension, multiply, parse_unit, power

ANY = None  # the dimension of zero and of infinity, which fit everywhere
_ONE: Dimension = parse_unit("1").dimension
_SECOND: Dimension = parse_unit("s").dimension

_SAME = {ca.OP_ADD, ca.OP_SUB, ca.OP_FMIN, ca.OP_FMAX, ca.OP_FMOD, ca.OP_REMAINDER, ca.OP_HYPOT}
_COMPARE = {ca.OP_LT, ca.OP_LE, ca.OP_EQ, ca.OP_NE}
_KEEP = {ca.OP_NEG, ca.OP_FABS, ca.OP_TWICE, ca.OP_FLOOR, ca.OP_CEIL, ca.OP_ASSIGN}
_LOGIC = {ca.OP_AND, ca.OP_OR, ca.OP_NOT}


class _MismatchError(Exception):
    """Two dimensions that should be one."""


def check_homogeneous(equation: Equation, scope: Scope, path: str) -> None:
    """Raise UnitError unless both sides of the equation have the same dimension."""
    memo: dict[int, Dimension | None] = {}
    for symbol, atom in zip(equation.symbols, equation.atoms, strict=True):
        quantity = scope.quantity(atom)
        dimension = _ONE if quantity is None else parse_unit(quantity.unit).dimension
        if atom.kind == "der":
            dimension = divide(dimension, _SECOND)
        if atom.kind == "time":
            dimension = _SECOND
        memo[symbol.element_hash()] = dimension
    where = equation.where
    try:
        left, right = _dimension(equation.lhs, memo), _dimension(equation.rhs, memo)
    except _MismatchError as mismatch:
        raise UnitError(
            f"inside {_short(equation)}: {mismatch}", path=path, equation=equation.label, where=where
        ) from None
    if left is not ANY and right is not ANY and left != right:
        raise UnitError(
            f"{_short(equation)}: the left side is {format_dimension(left)}, the right side {format_dimension(right)}",
            path=path,
            equation=equation.label,
            where=where,
            remedy="give constants with a dimension as parameters with a unit",
        )


def _short(equation: Equation) -> str:
    text = f"{equation.lhs} == {equation.rhs}"
    return text if len(text) < 120 else text[:117] + "..."


def _dimension(expression: SX, memo: dict[int, Dimension | None]) -> Dimension | None:
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
        return _ONE if op in _COMPARE else _agree(node, parts, dims)
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
