"""Verification: every raw equation of the flat model, before any elimination, evaluated on a solution."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from arthur_acausal.declare.scope import Atom
from arthur_acausal.flatten.block import Expression
from arthur_acausal.flatten.system import FlatEquation, FlatSystem
from arthur_acausal.result.solution import Solution
from arthur_acausal.transform.structured import StructuredDAE

FloatArray = NDArray[np.float64]

LISTED = 10  # the worst equations that a verification keeps
BATCH = 2_000_000  # values evaluated at once
TINY = float(np.finfo(float).tiny)


@dataclass(frozen=True, slots=True)
class Residual:
    """The largest scaled residual of one raw equation, and when [s]."""

    scaled: float
    time: float
    equation: str


@dataclass(frozen=True, slots=True)
class Verification:
    """How well a solution fulfils the raw equations.

    A residual is scaled by the sum of what each quantity in the equation contributes to it: |d(lhs - rhs)/dx| times
    the largest |x| of the run. ``worst`` first; ``equations``: how many were evaluated, those of connections included.
    """

    worst: list[Residual]
    equations: int

    @property
    def largest(self) -> float:
        """The largest scaled residual of all."""
        return self.worst[0].scaled if self.worst else 0.0

    @property
    def path(self) -> str:
        """The equation with the largest scaled residual."""
        return self.worst[0].equation if self.worst else ""


def verify(flat: FlatSystem, structured: StructuredDAE, solution: Solution) -> Verification:
    """Evaluate all raw equations; each class-level equation at once for all its instances and times."""
    t = np.asarray(solution.t)
    values = _values(flat, structured, solution)
    groups: dict[Expression, list[FlatEquation]] = {}
    for equation in flat.equations:
        groups.setdefault(equation.equation.residual, []).append(equation)
    found = [r for expression, group in groups.items() for r in _group(expression, group, values, t)]
    for alias in flat.aliases:
        a, b = values(Atom("variable", alias.i)), values(Atom("variable", alias.j))
        scale = max(float(np.max(np.abs(a))), float(np.max(np.abs(b))), TINY)
        worst = int(np.argmax(np.abs(a - b)))
        paths = f"{flat.variables[alias.i].path} == {flat.variables[alias.j].path}"
        found.append(Residual(float(abs(a - b)[worst]) / scale, float(t[worst]), f"{paths} ({alias.where})"))
    found.sort(key=lambda r: -r.scaled if np.isfinite(r.scaled) else -np.inf)
    return Verification(found[:LISTED], len(flat.equations) + len(flat.aliases))


def _values(flat: FlatSystem, structured: StructuredDAE, solution: Solution) -> Callable[[Atom], FloatArray]:
    """Return what gives an atom's values (nt,) over the solution."""
    scope, t = flat.scope, np.asarray(solution.t)
    solution.values(
        [d.path for d in (*scope.variable, *scope.parameter, *scope.discrete)]
    )  # computed together
    kept: dict[Atom, FloatArray] = {}

    @cache
    def called() -> FloatArray:
        return _external(flat, value, len(t))

    def fetch(atom: Atom) -> FloatArray:
        match atom.kind:
            case "variable":
                return solution[scope.variable[atom.number].path]
            case "parameter":
                return solution[scope.parameter[flat.parameter(atom.number)].path]
            case "discrete" | "pre":
                return solution[scope.discrete[atom.number].path]
            case "initial":
                return np.zeros(len(t))
            case "homotopy":
                return np.ones(len(t))
            case "mode":
                return solution.modes[:, atom.number]
            case "external":
                return np.asarray(called()[atom.number])
            case "der":
                ref = structured.nodes.of_derivative(atom.number, "")
                zero = np.zeros(len(t))
                return zero if ref.kind == "zero" else ref.sign * solution[structured.nodes.name(ref.number)]
        return t

    def value(atom: Atom) -> FloatArray:
        if atom not in kept:
            kept[atom] = np.asarray(fetch(atom), dtype=float) * np.ones(len(t))
        return kept[atom]

    return value


def _external(flat: FlatSystem, values: Callable[[Atom], FloatArray], count: int) -> FloatArray:
    """Return the outputs of all external functions (n, nt), each of the raw equations' inputs."""
    found = np.zeros((len(flat.scope.external), count))
    for flat_call in flat.calls:
        call = flat_call.call
        inputs = np.zeros((count, len(call.inputs)))
        for k, x in enumerate(call.inputs):
            if x.symbols:
                formula = ca.Function("input", [ca.vertcat(*x.symbols)], [x.value])
                columns = np.array([values(atom) for atom in x.atoms])
                inputs[:, k] = np.asarray(formula.map(count)(columns), dtype=float).reshape(-1)
            else:
                inputs[:, k] = float(x.value)
        function, outputs = call.function.fresh(), np.zeros(len(call.sparsity))
        for k in range(count):
            function.evaluate(inputs[k], outputs)
            found[call.first : call.first + len(outputs), k] = outputs
    return found


def _group(
    expression: Expression, group: list[FlatEquation], values: Callable[[Atom], FloatArray], t: FloatArray
) -> list[Residual]:
    if not expression.symbols:
        return [Residual(0.0, float(t[0]), e.text) for e in group]
    symbols = ca.vertcat(*expression.symbols)
    slope = ca.densify(ca.jacobian(expression.value, symbols))
    function = ca.Function("raw", [symbols], [expression.value, slope])
    together = max(1, BATCH // (len(t) * len(expression.symbols)))
    found = []
    for first in range(0, len(group), together):
        part = group[first : first + together]
        x = np.array(
            [[values(atom) for atom in equation.atoms()] for equation in part]
        )  # instance, symbol, time
        columns = np.ascontiguousarray(np.moveaxis(x, 1, 0).reshape(x.shape[1], -1))
        residual, slopes = function.map(columns.shape[1])(columns)
        size = np.abs(np.array(slopes.nonzeros())).reshape(len(part), len(t), x.shape[1])
        scale = np.einsum("its,is->it", size, np.max(np.abs(x), axis=2))
        scaled = np.abs(np.array(residual.nonzeros())).reshape(len(part), len(t)) / np.maximum(scale, TINY)
        worst = np.argmax(np.where(np.isfinite(scaled), scaled, np.inf), axis=1)
        found += [
            Residual(float(row[k]), float(t[k]), e.text)
            for e, row, k in zip(part, scaled, worst, strict=True)
        ]
    return found
