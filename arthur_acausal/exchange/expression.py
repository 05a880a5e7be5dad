"""CasADi expressions as Modelica text, operation by operation, numbers exact.

A relation that makes events stands in an expression as a symbol (its frozen mode); it is printed as the relation
itself in a plain ``if``, which makes an event in Modelica, too. Conditions of what changes at events only need no
more; all other choices are printed in ``noEvent``.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping

import casadi as ca
from casadi import SX

from arthur_acausal.errors import UsageError

TOP, OR, AND, NOT, RELATION, SUM, PRODUCT, POWER, ATOM = range(9)

Text = tuple[str, int]
"""Text and how tightly its outermost operation binds."""

_BINARY = {ca.OP_ADD: ("+", SUM), ca.OP_MUL: ("*", PRODUCT)}
_RELATIONS = {ca.OP_LT: "<", ca.OP_LE: "<="}
_FUNCTIONS = {
    ca.OP_EXP: "exp",
    ca.OP_LOG: "log",
    ca.OP_SQRT: "sqrt",
    ca.OP_SIN: "sin",
    ca.OP_COS: "cos",
    ca.OP_TAN: "tan",
    ca.OP_ASIN: "asin",
    ca.OP_ACOS: "acos",
    ca.OP_ATAN: "atan",
    ca.OP_SINH: "sinh",
    ca.OP_COSH: "cosh",
    ca.OP_TANH: "tanh",
    ca.OP_FABS: "abs",
    ca.OP_SIGN: "sign",
    ca.OP_FMIN: "min",
    ca.OP_FMAX: "max",
    ca.OP_ATAN2: "atan2",
}
_TEMPLATES = {
    ca.OP_SQ: "{0}^2",
    ca.OP_TWICE: "2*{0}",
    ca.OP_INV: "1/{0}",
    ca.OP_FLOOR: "noEvent(floor({0}))",
    ca.OP_CEIL: "noEvent(ceil({0}))",
    ca.OP_FMOD: "noEvent(rem({0}, {1}))",
    ca.OP_LOG1P: "log(1 + {0})",
    ca.OP_EXPM1: "(exp({0}) - 1)",
    ca.OP_HYPOT: "sqrt({0}^2 + {1}^2)",
    ca.OP_ASINH: "log({0} + sqrt({0}^2 + 1))",
    ca.OP_ACOSH: "log({0} + sqrt({0}^2 - 1))",
    ca.OP_ATANH: "0.5*log((1 + {0})/(1 - {0}))",
    ca.OP_COPYSIGN: "noEvent(if {1} >= 0 then abs({0}) else -abs({0}))",
}
_LOGIC = {ca.OP_LT, ca.OP_LE, ca.OP_EQ, ca.OP_NE, ca.OP_NOT, ca.OP_AND, ca.OP_OR}
_TEMPLATE_BINDS = {ca.OP_SQ: POWER, ca.OP_TWICE: PRODUCT, ca.OP_INV: PRODUCT}


def number(value: float) -> str:
    """Return the shortest text that reads as exactly this number. Raises UsageError where there is none."""
    if not math.isfinite(value):
        raise UsageError(f"{value} cannot be written in Modelica")
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)


class Printer:
    """Prints expressions of the symbols of one equation.

    ``names``: symbol (by hash) -> text of a number; ``relations``: symbol (by hash) -> text of the relation behind it;
    ``held``: symbols that change at events only, ``whole``: those that stand for Integers.
    """

    def __init__(
        self,
        names: Mapping[int, str],
        relations: Mapping[int, str],
        held: Collection[int],
        whole: Collection[int],
        where: str,
    ) -> None:
        self._names, self._relations, self._where = names, relations, where
        self._held, self._whole = held, whole
        self._done: dict[tuple[int, bool], Text] = {}

    def real(self, x: SX) -> str:
        """Return the text of a Real expression."""
        return self._memo(x, False)[0]

    def operand(self, x: SX) -> str:
        """Return the text of one side of a relation."""
        return self._in(x, SUM)

    def boolean(self, x: SX) -> str:
        """Return the text of a condition."""
        return self._memo(x, True)[0]

    def integral(self, x: SX) -> bool:
        """Tell whether an expression is a whole number whatever its symbols are."""
        if x.is_constant():
            return float(x).is_integer()
        if x.is_symbolic():
            return x.element_hash() in self._whole or x.element_hash() in self._relations
        op = x.op()
        if op == ca.OP_IF_ELSE_ZERO:
            return self.integral(x.dep(1))
        if op in (ca.OP_ADD, ca.OP_SUB, ca.OP_MUL, ca.OP_NEG, ca.OP_TWICE):
            return all(self.integral(x.dep(i)) for i in range(x.n_dep()))
        return op in _LOGIC

    def _plain(self, condition: SX) -> bool:
        """Tell whether a choice needs no ``noEvent``: its condition makes events, or changes at events only."""
        found = [symbol.element_hash() for symbol in ca.symvar(condition)]
        return any(f in self._relations for f in found) or all(f in self._held for f in found)

    def _memo(self, x: SX, logical: bool) -> Text:
        key = (x.element_hash(), logical)
        if key not in self._done:
            self._done[key] = self._boolean(x) if logical else self._real(x)
        return self._done[key]

    def _in(self, x: SX, least: int) -> str:
        """Return the text of a Real operand, in brackets where it binds more loosely than ``least``."""
        text, binds = self._memo(x, False)
        return text if binds >= least else f"({text})"

    def _condition(self, x: SX, least: int) -> str:
        text, binds = self._memo(x, True)
        return text if binds >= least else f"({text})"

    def _real(self, x: SX) -> Text:
        if x.is_constant():
            value = float(x)
            return number(value), ATOM if value >= 0.0 else SUM
        if x.is_symbolic():
            key = x.element_hash()
            if key in self._relations:
                return f"(if {self._relations[key]} then 1 else 0)", ATOM
            return self._names[key], ATOM
        op = x.op()
        if op in _BINARY:
            return self._sum_or_product(x, op)
        if op == ca.OP_SUB:
            return f"{self._in(x.dep(0), SUM)} - {self._in(x.dep(1), PRODUCT)}", SUM
        if op == ca.OP_DIV:
            return f"{self._in(x.dep(0), PRODUCT)}/{self._in(x.dep(1), POWER)}", PRODUCT
        if op == ca.OP_NEG:
            return f"-{self._in(x.dep(0), PRODUCT)}", SUM
        if op in (ca.OP_POW, ca.OP_CONSTPOW):
            return f"{self._in(x.dep(0), ATOM)}^{self._in(x.dep(1), ATOM)}", POWER
        if op == ca.OP_IF_ELSE_ZERO:
            return self._choice(x.dep(0), x.dep(1), SX(0.0))
        if op in _LOGIC:
            return self._if(x, "1", "0")
        return self._function(x, op)

    def _sum_or_product(self, x: SX, op: int) -> Text:
        a, b = x.dep(0), x.dep(1)
        if op == ca.OP_ADD and (pair := _complement(a, b)):
            return self._choice(*pair)
        sign, binds = _BINARY[op]
        space = " " if op == ca.OP_ADD else ""
        if op == ca.OP_ADD and not b.is_leaf() and b.op() == ca.OP_NEG:
            return f"{self._in(a, SUM)} - {self._in(b.dep(0), PRODUCT)}", SUM
        return f"{self._in(a, binds)}{space}{sign}{space}{self._in(b, binds + (op == ca.OP_ADD))}", binds

    def _choice(self, condition: SX, then: SX, otherwise: SX) -> Text:
        return self._if(condition, self.real(then), self.real(otherwise))

    def _if(self, condition: SX, then: str, otherwise: str) -> Text:
        text = f"if {self.boolean(condition)} then {then} else {otherwise}"
        return (f"({text})" if self._plain(condition) else f"noEvent({text})"), ATOM

    def _function(self, x: SX, op: int) -> Text:
        parts = [x.dep(i) for i in range(x.n_dep())]
        if op in _FUNCTIONS:
            return f"{_FUNCTIONS[op]}({', '.join(map(self.real, parts))})", ATOM
        if op in _TEMPLATES:
            arguments = [self._in(part, ATOM) for part in parts]
            return _TEMPLATES[op].format(*arguments), _TEMPLATE_BINDS.get(op, ATOM)
        raise UsageError(
            f"an operation of this equation has no counterpart in Modelica: {str(x)[:80]}",
            where=self._where,
            remedy="write it with elementary functions",
        )

    def _boolean(self, x: SX) -> Text:
        if x.is_constant():
            return ("true" if float(x) else "false"), ATOM
        if x.is_symbolic() and x.element_hash() in self._relations:
            return self._relations[x.element_hash()], RELATION
        op = -1 if x.is_symbolic() else x.op()
        if op in _RELATIONS:
            return f"{self._in(x.dep(0), SUM)} {_RELATIONS[op]} {self._in(x.dep(1), SUM)}", RELATION
        if op == ca.OP_NOT:
            return f"not {self._condition(x.dep(0), ATOM)}", NOT
        if op == ca.OP_AND:
            return f"{self._condition(x.dep(0), NOT)} and {self._condition(x.dep(1), NOT)}", AND
        if op == ca.OP_OR:
            return f"{self._condition(x.dep(0), AND)} or {self._condition(x.dep(1), AND)}", OR
        if op == ca.OP_IF_ELSE_ZERO and x.dep(1).is_constant():
            return self._memo(x.dep(0), True) if float(x.dep(1)) > 0.5 else ("false", ATOM)
        if op in (ca.OP_EQ, ca.OP_NE) and self.integral(x.dep(0)) and self.integral(x.dep(1)):
            sign = "==" if op == ca.OP_EQ else "<>"
            return f"{self._in(x.dep(0), SUM)} {sign} {self._in(x.dep(1), SUM)}", RELATION
        if op in (ca.OP_EQ, ca.OP_NE):  # Modelica compares no Reals
            sign = "<" if op == ca.OP_EQ else ">="
            return f"abs({self._in(x.dep(0), SUM)} - {self._in(x.dep(1), PRODUCT)}) {sign} 0.5", RELATION
        return f"{self._in(x, SUM)} > 0.5", RELATION


def _complement(a: SX, b: SX) -> tuple[SX, SX, SX] | None:
    """Return (condition, then, otherwise) where a + b is CasADi's form of a choice: one of them is zero."""
    if a.is_leaf() or b.is_leaf() or a.op() != ca.OP_IF_ELSE_ZERO or b.op() != ca.OP_IF_ELSE_ZERO:
        return None
    first, second = a.dep(0), b.dep(0)
    if _negates(second, first):
        return first, a.dep(1), b.dep(1)
    return (second, b.dep(1), a.dep(1)) if _negates(first, second) else None


def _negates(x: SX, y: SX) -> bool:
    return not x.is_leaf() and x.op() == ca.OP_NOT and bool(ca.is_equal(x.dep(0), y, 0))
