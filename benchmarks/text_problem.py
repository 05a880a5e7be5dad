"""Initial value problems given as text: read by a whitelist over Python's syntax tree, never evaluated."""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Callable, Mapping
from functools import reduce
from typing import Any

import casadi as ca
import numpy as np
from casadi import SX

from arthur_acausal import Component, Equations, der, if_else, start, time, variable

OPERATORS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: lambda a, b: a + b,
    ast.Sub: lambda a, b: a - b,
    ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b,
    ast.Pow: lambda a, b: a**b,
    ast.USub: lambda a: -a,
    ast.UAdd: lambda a: a,
}
COMPARISONS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Lt: lambda a, b: a < b,
    ast.LtE: lambda a, b: a <= b,
    ast.Gt: lambda a, b: a > b,
    ast.GtE: lambda a, b: a >= b,
}
FUNCTIONS: dict[str, Callable[..., Any]] = {
    name: getattr(ca, name)
    for name in (
        *("sqrt", "exp", "log", "log10", "sin", "cos", "tan", "asin", "acos", "atan", "atan2"),
        *("sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "fabs", "floor", "ceil", "sign", "fmod", "erf"),
    )
} | {"abs": ca.fabs, "ln": ca.log, "pow": lambda a, b: a**b}
EXTREMES: dict[str, Callable[..., Any]] = {"min": ca.fmin, "fmin": ca.fmin, "max": ca.fmax, "fmax": ca.fmax}
CHOICES = ("if_else", "where")


class TextError(ValueError):
    """A text that is not of the format."""


def value_of(text: str | float, names: Mapping[str, Any]) -> Any:
    """Return the value of an expression of ``names``, numbers, + - * / **, conditionals, and the functions above.

    ``der(x)`` and ``t`` are names for the caller to give. Raises TextError for anything else.
    """
    if isinstance(text, int | float):
        return float(text)
    try:
        return _walk(ast.parse(text.strip(), mode="eval").body, names)
    except SyntaxError as error:
        raise TextError(f"{text!r}: {error.msg}") from None


def _walk(node: ast.expr, names: Mapping[str, Any]) -> Any:
    match node:
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            return float(number)
        case ast.Name(id=name) if name in names:
            return names[name]
        case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
            return OPERATORS[type(op)](_walk(left, names), _walk(right, names))
        case ast.UnaryOp(op=op, operand=operand) if type(op) in OPERATORS:
            return OPERATORS[type(op)](_walk(operand, names))
        case ast.IfExp(test=test, body=then, orelse=otherwise):
            return _choice(test, then, otherwise, names)
        case ast.Call(func=ast.Name(id="der"), args=[ast.Name(id=name)], keywords=[]):
            return names[f"der({name})"]
        case ast.Call(func=ast.Name(id=name), args=[test, then, otherwise], keywords=[]) if name in CHOICES:
            return _choice(test, then, otherwise, names)
        case ast.Call(func=ast.Name(id=name), args=[_, *_], keywords=[]) if name in EXTREMES:
            return reduce(EXTREMES[name], (_walk(a, names) for a in node.args))
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]) if name in FUNCTIONS:
            try:
                return FUNCTIONS[name](*(_walk(a, names) for a in arguments))
            except (TypeError, NotImplementedError):  # a wrong number of arguments
                raise TextError(f"{ast.unparse(node)!r} has a wrong number of arguments") from None
    raise TextError(f"{ast.unparse(node)!r} is not allowed here")


def _choice(test: ast.expr, then: ast.expr, otherwise: ast.expr, names: Mapping[str, Any]) -> Any:
    """Return the value of a conditional expression; in equations each relation makes an event."""
    condition = _condition(test, names)
    if isinstance(condition, bool | np.bool_):
        return _walk(then if condition else otherwise, names)
    return if_else(condition, SX(_walk(then, names)), SX(_walk(otherwise, names)))


def _condition(node: ast.expr, names: Mapping[str, Any]) -> Any:
    match node:
        case ast.Compare(left=left, ops=operators, comparators=others) if all(
            type(op) in COMPARISONS for op in operators
        ):
            values = [_walk(part, names) for part in (left, *others)]
            pairs = zip(operators, values, values[1:], strict=False)
            return reduce(_both, [COMPARISONS[type(op)](a, b) for op, a, b in pairs])
        case ast.BoolOp(op=ast.And(), values=parts):
            return reduce(_both, [_condition(part, names) for part in parts])
        case ast.BoolOp(op=ast.Or(), values=parts):
            return _not(reduce(_both, [_not(_condition(part, names)) for part in parts]))
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return _not(_condition(operand, names))
    raise TextError(f"{ast.unparse(node)!r} is no condition")


def _both(a: Any, b: Any) -> Any:
    if isinstance(a, SX) and isinstance(b, SX):
        return ca.logic_and(a, b)
    symbolic, plain = (a, b) if isinstance(a, SX) else (b, a)
    return symbolic if plain else plain


def _not(a: Any) -> Any:
    return ca.logic_not(a) if isinstance(a, SX) else not a


def _sides(text: str) -> tuple[str, str]:
    """Split an equation at its equals sign (`=` or `==`, not that of a relation); without one it equals zero."""
    parts = re.split(r"(?<![<>!=])==?(?!=)", text)
    if len(parts) > 2:
        raise TextError(f"{text!r} has more than one equals sign")
    return parts[0], parts[1] if len(parts) == 2 else "0"


def _starts(case: Mapping[str, Any], numbers: dict[str, Any]) -> dict[str, float]:
    """Return the initial values; they may use definitions and each other, in any order."""
    waiting: dict[str, Any] = dict(case.get("definitions", [])) | {
        n: case["y0"][n] for n in case["variables"]
    }
    known = {"t": float(case["t0"])} | numbers
    while True:
        before = len(waiting)
        for name, text in list(waiting.items()):
            try:
                known[name] = float(value_of(text, known))
            except (TextError, KeyError):
                continue
            del waiting[name]
        if len(waiting) == before:
            break
    missing = [name for name in case["variables"] if name in waiting]
    if missing:
        value_of(waiting[missing[0]], known)  # says what is wrong
    return {name: known[name] for name in case["variables"]}


def problem(
    case: Mapping[str, Any], nominal: Mapping[str, float] | None = None, unknown: float = 1.0
) -> Component:
    """Return the component of a problem: its variables as variables, its initial values as start values.

    ``nominal``: magnitudes of variables; of the others that of the initial value, ``unknown`` where it is zero.
    """
    numbers: dict[str, Any] = {"pi": math.pi}
    for name, text in case["parameters"].items():
        numbers[name] = value_of(text, numbers)
    names: list[str] = case["variables"]
    starts = _starts(case, numbers)

    def equations(self: Component) -> Equations:
        known = numbers | {"t": time()} | {name: getattr(self, name) for name in names}
        texts = [*case["equations"], *(text for _, text in case.get("definitions", []))]
        rates = {name for text in texts for name in re.findall(r"\bder\(\s*(\w+)\s*\)", str(text))}
        known |= {f"der({name})": der(getattr(self, name)) for name in rates if name in names}
        for name, text in case.get("definitions", []):
            known[name] = value_of(text, known)
        for text in case["equations"]:
            left, right = _sides(text)
            yield SX(value_of(left, known)) == SX(value_of(right, known))

    body: dict[str, Any] = {name: variable("1") for name in names}
    body |= {"__annotations__": dict.fromkeys(names, "Real"), "equations": equations, "__module__": __name__}
    kind = type(case["name"], (Component,), body)
    sizes = {n: abs(v) or unknown for n, v in starts.items()} | dict(nominal or {})
    model: Component = kind(**{n: start(v, nominal=sizes[n]) for n, v in starts.items()})
    return model
