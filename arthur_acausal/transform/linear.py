"""How an expression depends on each of its unknowns: by a constant, a parameter-dependent, or a varying coefficient."""

from __future__ import annotations

from typing import NamedTuple

import casadi as ca
from casadi import SX

from arthur_acausal.flatten.block import Expression

Coefficient = float | SX | None
"""A number; an expression of parameters; or None: varying or nonlinear, so that nothing is solved for it."""


class Shape(NamedTuple):
    """``a * x[i] + b * x[j] == 0`` with numbers |a| = |b|: x[i] = sign x[j]; ``j`` is -1 where x[i] = 0."""

    i: int
    j: int
    sign: int


class LinearAnalysis:
    """Coefficients and shapes of expressions, computed once for each class-level expression."""

    def __init__(self) -> None:
        self._coefficients: dict[Expression, dict[int, Coefficient]] = {}
        self._shapes: dict[Expression, Shape | None] = {}
        self._negated: dict[int, tuple[SX, SX]] = {}

    def negated(self, coefficient: Coefficient) -> Coefficient:
        """Return minus a coefficient; the same expression for the same one."""
        if not isinstance(coefficient, SX):
            return None if coefficient is None else -coefficient
        key = coefficient.element_hash()
        if key not in self._negated:
            self._negated[key] = (coefficient, -coefficient)
        return self._negated[key][1]

    def coefficients(self, expression: Expression) -> dict[int, Coefficient]:
        """Return d(expression)/d(unknown) by the unknown's position among the symbols; zero ones are left out."""
        found = self._coefficients.get(expression)
        if found is None:
            found = self._coefficients[expression] = _coefficients(expression)
        return found

    def shape(self, expression: Expression) -> Shape | None:
        """Return the alias that the expression set to zero says, if it says just that."""
        if expression not in self._shapes:
            self._shapes[expression] = self._shape(expression)
        return self._shapes[expression]

    def _shape(self, expression: Expression) -> Shape | None:
        n = len(expression.symbols)
        if not 1 <= n <= 2 or any(atom.kind not in ("variable", "der") for atom in expression.atoms):
            return None
        linear = self.coefficients(expression)
        a, b = linear.get(0), linear.get(1)
        if not isinstance(a, float) or (n == 2 and not (isinstance(b, float) and abs(a) == abs(b))):
            return None
        at_zero = ca.substitute(expression.value, ca.vertcat(*expression.symbols), SX.zeros(n))
        if not (at_zero.is_constant() and float(at_zero) == 0.0):
            return None
        if n == 1:
            return Shape(0, -1, 0)
        assert isinstance(b, float)
        return Shape(0, 1, -1 if a * b > 0.0 else 1)


def _coefficients(expression: Expression) -> dict[int, Coefficient]:
    positions = [i for i, atom in enumerate(expression.atoms) if atom.kind in ("variable", "der")]
    if not positions:
        return {}
    row = ca.jacobian(expression.value, ca.vertcat(*[expression.symbols[i] for i in positions]))
    varying = {
        s.element_hash()
        for s, a in zip(expression.symbols, expression.atoms, strict=True)
        if a.kind != "parameter"
    }
    found: dict[int, Coefficient] = {}
    for k, column in enumerate(row.sparsity().get_col()):
        position, entry = positions[column], row.nz[k]
        if entry.is_constant():
            if float(entry) != 0.0:
                found[position] = float(entry)
        elif any(s.element_hash() in varying for s in ca.symvar(entry)):
            found[position] = None
        else:
            found[position] = entry
    for position in expression.through or ():
        if expression.atoms[position].kind in ("variable", "der"):
            found[position] = None
    return found
