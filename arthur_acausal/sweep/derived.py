"""Parameters computed from varied ones: arithmetic over paths, read by a whitelist and never evaluated as code."""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable, Mapping
from typing import Any

from arthur_acausal.errors import UsageError, nearest

_OPERATORS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
_FUNCTIONS: dict[str, Callable[..., Any]] = {
    name: getattr(math, name) for name in ("sqrt", "exp", "log", "log10", "sin", "cos", "tan", "atan", "tanh")
} | {"abs": abs, "min": min, "max": max}


def compute(text: str, values: Mapping[str, float]) -> float:
    """Return the value of an expression over paths, numbers, + - * / ** and common functions, all in SI.

    Raises UsageError for anything else, for a path without a value, and for a result that is no real number.
    """
    try:
        tree = ast.parse(text, mode="eval")
    except SyntaxError as error:
        raise UsageError(f"{text!r} is no expression", cause=error.msg) from None
    try:
        result = _walk(tree.body, values)
    except (ArithmeticError, ValueError) as error:
        raise UsageError(f"{text!r} cannot be computed", cause=str(error)) from None
    if isinstance(result, complex) or not math.isfinite(result):
        raise UsageError(f"{text!r} is {result}")
    return float(result)


def _walk(node: ast.expr, values: Mapping[str, float]) -> Any:
    match node:
        case ast.Constant(value=bool()):
            pass
        case ast.Constant(value=int() | float() as number):
            return float(number)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
            return _OPERATORS[type(op)](_walk(left, values), _walk(right, values))
        case ast.UnaryOp(op=op, operand=operand) if type(op) in _OPERATORS:
            return _OPERATORS[type(op)](_walk(operand, values))
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]) if name in _FUNCTIONS:
            try:
                return _FUNCTIONS[name](*(_walk(a, values) for a in arguments))
            except TypeError as error:
                raise UsageError(f"{ast.unparse(node)!r} is wrong", cause=str(error)) from None
        case ast.Name(id="pi"):
            return math.pi
        case ast.Name() | ast.Attribute() | ast.Subscript():
            path = ast.unparse(node)
            if path in values:
                return values[path]
            raise UsageError(f"{path} has no value here", remedy=nearest(path, values))
    raise UsageError(f"{ast.unparse(node)!r} is not allowed in an expression")
