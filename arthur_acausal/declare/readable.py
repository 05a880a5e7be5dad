"""Relations as people read them: without CasADi's ``@1``, doubled parentheses and sums for choices."""

from __future__ import annotations

import casadi as ca
from casadi import SX

SIDE = 48  # characters of one side of a relation
DEEPEST = 6  # operations within each other

_INFIX = {
    ca.OP_ADD: "+",
    ca.OP_SUB: "-",
    ca.OP_MUL: "*",
    ca.OP_DIV: "/",
    ca.OP_POW: "**",
    ca.OP_LT: "<",
    ca.OP_LE: "<=",
    ca.OP_EQ: "==",
    ca.OP_NE: "!=",
    ca.OP_AND: "and",
    ca.OP_OR: "or",
}
_FUNCTIONS = {
    getattr(ca, f"OP_{name.upper()}"): name
    for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "tanh", "fabs", "sign", "fmin", "fmax", "floor")
}
_PREFIX = {ca.OP_NEG: "-", ca.OP_NOT: "not "}


def readable(relation: SX) -> str:
    """Return a comparison as text, each side cut to a length that a line can hold."""
    left, right = (_cut(_text(relation.dep(i), DEEPEST)) for i in (0, 1))
    return f"{left} {_INFIX[relation.op()]} {right}"


def _cut(text: str) -> str:
    return text if len(text) <= SIDE else f"{text[: SIDE - 3].rstrip()}..."


def _text(x: SX, depth: int) -> str:
    """Return an expression as text; beyond the depth, dots."""
    if x.is_constant():
        return f"{float(x):.6g}"
    if x.is_symbolic():
        return x.name()
    if not depth:
        return "..."
    op, parts = x.op(), [x.dep(i) for i in range(x.n_dep())]
    if (choice := _choice(x)) is not None:
        condition, then, otherwise = (_text(part, depth - 1) for part in choice)
        return f"if {condition} then {then} else {otherwise}"
    if op in _INFIX:
        return f" {_INFIX[op]} ".join(_within(part, depth) for part in parts)
    if op in _PREFIX:
        return _PREFIX[op] + _within(parts[0], depth)
    if op == ca.OP_SQ:
        return f"{_within(parts[0], depth)}**2"
    if op == ca.OP_INV:
        return f"1 / {_within(parts[0], depth)}"
    if op == ca.OP_TWICE:
        return f"2 * {_within(parts[0], depth)}"
    return f"{_FUNCTIONS.get(op, '...')}({', '.join(_text(part, depth - 1) for part in parts)})"


def _within(x: SX, depth: int) -> str:
    """Return an operand, in parentheses where it is an operation itself."""
    text = _text(x, depth - 1)
    return f"({text})" if " " in text and not x.is_symbolic() else text


def _choice(x: SX) -> tuple[SX, SX, SX] | None:
    """Return condition, value and other value of CasADi's (c ? a : 0) + (!c ? b : 0), or of one half of it."""
    if x.op() == ca.OP_IF_ELSE_ZERO:
        return x.dep(0), x.dep(1), SX(0.0)
    if x.op() != ca.OP_ADD or any(x.dep(i).op() != ca.OP_IF_ELSE_ZERO for i in (0, 1)):
        return None
    condition, other = x.dep(0).dep(0), x.dep(1).dep(0)
    if other.op() == ca.OP_NOT and ca.is_equal(condition, other.dep(0), DEEPEST):
        return condition, x.dep(0).dep(1), x.dep(1).dep(1)
    return None
