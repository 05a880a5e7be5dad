"""Initial value problems given as text: read by a whitelist over Python's syntax tree, never evaluated."""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Mapping
from typing import Any

import casadi as ca
from casadi import SX

from arthur_acausal import Component, Equations, der, start, time, variable

OPERATORS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: lambda a, b: a + b,
    ast.Sub: lambda a, b: a - b,
    ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b,
    ast.Pow: lambda a, b: a**b,
    ast.USub: lambda a: -a,
    ast.UAdd: lambda a: a,
}
FUNCTIONS: dict[str, Callable[..., Any]] = {
    name: getattr(ca, name)
    for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "tanh", "fabs")
} | {"abs": ca.fabs}


class TextError(ValueError):
    """A text that is not of the format."""


def value_of(text: str | float, names: Mapping[str, Any]) -> Any:
    """Return the value of an expression of ``names``, numbers, + - * / ** and the functions above.

    ``der(x)`` and ``t`` are names for the caller to give. Raises TextError for anything else.
    """
    if isinstance(text, int | float):
        return float(text)
    try:
        return _walk(ast.parse(text, mode="eval").body, names)
    except SyntaxError as error:
        raise TextError(f"{text!r}: {error.msg}") from None


def _walk(node: ast.expr, names: Mapping[str, Any]) -> Any:
    match node:
        case ast.Constant(value=int() | float() as number):
            return float(number)
        case ast.Name(id=name) if name in names:
            return names[name]
        case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
            return OPERATORS[type(op)](_walk(left, names), _walk(right, names))
        case ast.UnaryOp(op=op, operand=operand) if type(op) in OPERATORS:
            return OPERATORS[type(op)](_walk(operand, names))
        case ast.Call(func=ast.Name(id="der"), args=[ast.Name(id=name)], keywords=[]):
            return names[f"der({name})"]
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]) if name in FUNCTIONS:
            return FUNCTIONS[name](*(_walk(a, names) for a in arguments))
    raise TextError(f"{ast.unparse(node)!r} is not allowed here")


def problem(case: Mapping[str, Any]) -> Component:
    """Return the component of a problem: its variables as variables, its initial values as start values."""
    numbers: dict[str, Any] = {"pi": math.pi}
    for name, text in case["parameters"].items():
        numbers[name] = value_of(text, numbers)
    numbers["t"] = float(case["t0"])
    for name, text in case.get("definitions", []):
        try:  # initial values may use definitions that hold at the start
            numbers[name] = value_of(text, numbers)
        except (TextError, KeyError):
            continue
    names: list[str] = case["variables"]
    starts = {name: float(value_of(case["y0"][name], numbers)) for name in names}

    def equations(self: Component) -> Equations:
        known = {k: v for k, v in numbers.items() if k in case["parameters"] or k == "pi"}
        known |= {"t": time()} | {name: getattr(self, name) for name in names}
        rates = {f"der({name})" for text in case["equations"] for name in names if f"der({name})" in text}
        known |= {rate: der(getattr(self, rate[4:-1])) for rate in rates}
        for name, text in case.get("definitions", []):
            known[name] = value_of(text, known)
        for text in case["equations"]:
            left, _, right = text.partition("=")
            yield SX(value_of(left, known)) == SX(value_of(right or "0", known))

    body: dict[str, Any] = {name: variable("1") for name in names}
    body |= {"__annotations__": dict.fromkeys(names, "Real"), "equations": equations, "__module__": __name__}
    kind = type(case["name"], (Component,), body)
    model: Component = kind(**{n: start(v, nominal=max(abs(v), 1e-6)) for n, v in starts.items()})
    return model
