"""Initial value problems given as text: read by a whitelist over Python's syntax tree, never evaluated."""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Callable, Iterable, Mapping
from functools import reduce
from keyword import iskeyword
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
    ast.Mod: lambda a, b: a - b * ca.floor(a / b),
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
        *("sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "fabs", "floor", "ceil", "fmod", "erf"),
    )
} | {
    **{"abs": ca.fabs, "ln": ca.log, "pow": OPERATORS[ast.Pow], "mod": OPERATORS[ast.Mod]},
    **{"sign": lambda x: _sign(x), "heaviside": lambda x: (_sign(x) + 1.0) / 2.0},
}
EXTREMES: dict[str, Callable[..., Any]] = {"min": ca.fmin, "fmin": ca.fmin, "max": ca.fmax, "fmax": ca.fmax}
CHOICES = ("if_else", "ifelse", "where")


class TextError(ValueError):
    """A text that is not of the format."""


def value_of(text: str | float, names: Mapping[str, Any]) -> Any:
    """Return the value of an expression of ``names``, numbers, + - * / **, conditionals, and the functions above.

    ``der(x)`` and ``t`` are names for the caller to give. Raises TextError for anything else.
    """
    if isinstance(text, int | float):
        return float(text)
    try:
        return _walk(ast.parse(_python(text), mode="eval").body, names)
    except SyntaxError as error:
        raise TextError(f"{text!r}: {error.msg}") from None


def _python(text: str) -> str:
    """Return a text with what other languages write otherwise: ^ for a power, a variable called lambda."""
    return re.sub(r"\blambda\b", "lambda_", text.strip().replace("^", "**"))


def _plain(node: ast.expr) -> str:
    """Return the text of a name with or without indices, without blanks."""
    return re.sub(r"\blambda_\b", "lambda", ast.unparse(node)).replace(" ", "")


def _walk(node: ast.expr, names: Mapping[str, Any]) -> Any:
    match node:
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            return float(number)
        case ast.Name() if (name := _plain(node)) in names:
            return names[name]
        case ast.Subscript(value=ast.Name()) if (name := _plain(node)) in names:
            return names[name]
        case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
            return OPERATORS[type(op)](_walk(left, names), _walk(right, names))
        case ast.UnaryOp(op=op, operand=operand) if type(op) in OPERATORS:
            return OPERATORS[type(op)](_walk(operand, names))
        case ast.IfExp(test=test, body=then, orelse=otherwise):
            return _choice(test, then, otherwise, names)
        case ast.Call(func=ast.Name(id="der"), args=[argument], keywords=[]) if (
            rate := f"der({_plain(argument)})"
        ) in names:
            return names[rate]
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


def _sign(x: Any) -> Any:
    """Return the sign; in equations it makes events."""
    if not isinstance(x, SX) or x.is_constant():
        return ca.sign(x)
    return if_else(x > 0.0, SX(1.0), if_else(x < 0.0, SX(-1.0), SX(0.0)))


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


def numbers(case: Mapping[str, Any]) -> dict[str, Any]:
    """Return the parameters' values; they may use each other, in any order."""
    return _solved(case["parameters"], {"pi": math.pi}, needed=case["parameters"])


def starts(case: Mapping[str, Any]) -> dict[str, float]:
    """Return the initial values; they may use definitions and each other, in any order."""
    names: list[str] = case["variables"]
    texts: dict[str, Any] = dict(case.get("definitions", [])) | {n: case["y0"][n] for n in names}
    known = _solved(texts, {"t": float(case["t0"])} | numbers(case), needed=names)
    return {name: known[name] for name in names}


def _solved(texts: Mapping[str, Any], known: Mapping[str, Any], needed: Iterable[str]) -> dict[str, Any]:
    """Return what is known, and the value of each text as soon as all that it uses is known."""
    values, waiting = dict(known), dict(texts)
    while True:
        before = len(waiting)
        for name, text in list(waiting.items()):
            try:
                values[name] = float(value_of(text, values))
            except (TextError, KeyError):
                continue
            del waiting[name]
        if len(waiting) == before:
            break
    for name in needed:
        if name in waiting:
            value_of(waiting[name], values)  # says what is wrong
    return values


def problem(case: Mapping[str, Any], nominal: Mapping[str, float] | None = None) -> Component:
    """Return the component of a problem: its variables as variables, its initial values as start values.

    ``nominal``: magnitudes of variables; of the others that of the initial value, 1 where it is zero.
    """
    first, given = starts(case), numbers(case)
    attribute = attributes(case)
    definitions = dict(case.get("definitions", []))
    texts = [str(text) for text in (*case["equations"], *definitions.values())]
    rates = {name for text in texts for name in re.findall(r"\bder\(\s*([^()]+?)\s*\)", text)}

    def equations(self: Component) -> Equations:
        own = {name: getattr(self, path) for name, path in attribute.items()}
        known: dict[str, Any] = {"time": time(), "t": time()} | given | own
        known |= {f"der({name})": der(own[name]) for name in sorted(rates & own.keys())}
        known = Definitions(known, definitions)
        for text in case["equations"]:
            left, right = _sides(text)
            yield SX(value_of(left, known)) == SX(value_of(right, known))

    body: dict[str, Any] = {path: variable("1") for path in attribute.values()}
    body |= {
        "__annotations__": dict.fromkeys(attribute.values(), "Real"),
        "equations": equations,
        "__module__": __name__,
    }
    kind = type(case["name"], (Component,), body)
    sizes = {name: abs(value) or 1.0 for name, value in first.items()} | dict(nominal or {})
    model: Component = kind(
        **{attribute[name]: start(value, nominal=sizes[name]) for name, value in first.items()}
    )
    return model


def attributes(case: Mapping[str, Any]) -> dict[str, str]:
    """Return for each variable the name of its attribute: its own unless that is none in Python, or is taken."""
    found: dict[str, str] = {}
    taken = {name for name in case["variables"] if name.isidentifier()}
    for name in case["variables"]:
        path = re.sub(r"\W+", "_", name).strip("_")
        while (
            path in taken - {name} or not path.isidentifier() or iskeyword(path) or hasattr(Component, path)
        ):
            path = f"v_{path}"
        taken.add(path)
        found[name] = path
    return found


class Definitions(dict[str, Any]):
    """Names with their values, and texts that are read when they are asked for, so that their order is free."""

    def __init__(self, known: Mapping[str, Any], texts: Mapping[str, Any]) -> None:
        super().__init__(known)
        self._waiting = dict(texts)

    def __contains__(self, name: object) -> bool:
        return super().__contains__(name) or name in self._waiting

    def __missing__(self, name: str) -> Any:
        if name not in self._waiting:
            raise KeyError(name)
        self[name] = value_of(self._waiting.pop(name), self)
        return self[name]
