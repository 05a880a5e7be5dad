"""Rows: the equations that remain after alias elimination, over the nodes of a graph of unknowns."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple, TypeAlias

import casadi as ca
from casadi import SX

from arthur_acausal.declare.scope import Atom
from arthur_acausal.errors import StructureError
from arthur_acausal.flatten.block import Expression
from arthur_acausal.flatten.system import FlatEquation, FlatSystem, Shift, shifted
from arthur_acausal.transform.alias import Aliases
from arthur_acausal.transform.linear import Coefficient, LinearAnalysis

RefKind: TypeAlias = Literal[
    "node", "parameter", "input", "discrete", "pre", "mode", "time", "zero", "initial", "homotopy", "external"
]


class Ref(NamedTuple):
    """What a symbol of a row stands for: a node (unknown), or something known; ``sign`` times it."""

    kind: RefKind
    number: int
    sign: int = 1


@dataclass(frozen=True, slots=True)
class Row:
    """``expression == 0``, its symbols standing for ``refs``; ``text`` is path, label and source line."""

    expression: Expression
    refs: tuple[Ref, ...]
    text: str


class Node(NamedTuple):
    """An unknown: the ``order``-th derivative of a variable (a root of the aliases)."""

    variable: int
    order: int


class Nodes:
    """The numbering of unknowns while a system is being built: variables, then derivatives as they are met."""

    def __init__(self, flat: FlatSystem, aliases: Aliases) -> None:
        self.flat = flat
        self.aliases = aliases
        self.inputs = {aliases.root[i]: k for k, i in enumerate(flat.inputs)}
        if len(self.inputs) < len(flat.inputs):
            twice = next(i for k, i in enumerate(flat.inputs) if self.inputs[aliases.root[i]] != k)
            raise StructureError(
                "two external inputs are connected to each other", path=flat.variables[twice].path
            )
        self.all: list[Node] = []
        self.derivative: list[int] = []
        self.start_only: set[str] = set()  # "initial", "homotopy": what distinguishes the start from the run
        self._number: dict[int, int] = {}
        for i, root in enumerate(aliases.root):
            if i == root and root not in self.inputs and root not in aliases.zero:
                self._number[root] = len(self.all)
                self.all.append(Node(root, 0))
                self.derivative.append(-1)
        for x, w in aliases.rate.items():
            self.derivative[self._number[x]] = self._number[w]

    def of_variable(self, i: int) -> Ref:
        """Return what variable i stands for."""
        root, sign = self.aliases.root[i], self.aliases.sign[i]
        if root in self.inputs:
            return Ref("input", self.inputs[root], sign)
        if root in self.aliases.zero:
            return Ref("zero", 0)
        return Ref("node", self._number[root], sign)

    def of_derivative(self, i: int, text: str) -> Ref:
        """Return what der(variable i) stands for."""
        ref = self.of_variable(i)
        if ref.kind == "input":
            path, source = (self.flat.variables[k].path for k in (i, self.flat.inputs[ref.number]))
            raise StructureError(
                f"{text}: der({path}) is not known"
                + ("" if path == source else f": {path} equals the external input {source}"),
                cause="an external input is known as a function of time only by its values",
                remedy="connect the input to a source within the model, or pass it through a filter",
            )
        return ref if ref.kind == "zero" else Ref("node", self.derivative_of(ref.number), ref.sign)

    def derivative_of(self, node: int) -> int:
        """Return the node of a node's derivative, made where it is met for the first time."""
        if self.derivative[node] < 0:
            self.derivative[node] = len(self.all)
            self.all.append(Node(self.all[node].variable, self.all[node].order + 1))
            self.derivative.append(-1)
        return self.derivative[node]

    def without_unused(self, rows: Sequence[Row]) -> list[Row]:
        """Take out derivatives that stand in no row, and number the rest anew; return the rows over them."""
        used = {ref.number for row in rows for ref in row.refs if ref.kind == "node"}
        gone: set[int] = set()
        while True:  # from the highest order down
            more = {
                n
                for n, (_, order) in enumerate(self.all)
                if order and n not in used | gone and self.derivative[n] in {-1} | gone
            }
            if not more:
                break
            gone |= more
        if not gone:
            return list(rows)
        kept = [n for n in range(len(self.all)) if n not in gone]
        new = {n: k for k, n in enumerate(kept)}
        self.all = [self.all[n] for n in kept]
        self.derivative = [new.get(self.derivative[n], -1) for n in kept]
        return [
            replace(
                row, refs=tuple(r._replace(number=new[r.number]) if r.kind == "node" else r for r in row.refs)
            )
            for row in rows
        ]

    def ref(self, atom: Atom, text: str) -> Ref:
        """Return what an atom of the flat system stands for."""
        match atom.kind:
            case "variable" | "left":
                return self.of_variable(atom.number)
            case "der":
                return self.of_derivative(atom.number, text)
            case "parameter":
                return Ref("parameter", self.flat.parameter(atom.number))
            case "initial" | "homotopy":
                self.start_only.add(atom.kind)
        return Ref(atom.kind, atom.number)

    def row(self, equation: FlatEquation) -> Row:
        """Return the row of an equation."""
        text = equation.text
        return Row(equation.equation.residual, tuple(self.ref(a, text) for a in equation.atoms()), text)

    def expression(self, expression: Expression, shift: Shift, text: str) -> Row:
        """Return an expression of one component instance as a row, to be evaluated rather than solved."""
        return Row(expression, tuple(self.ref(shifted(a, shift), text) for a in expression.atoms), text)

    def name(self, node: int) -> str:
        """Return how people read a node."""
        variable, order = self.all[node]
        path = self.flat.variables[variable].path
        return path if order == 0 else "der(" * order + path + ")" * order


def incidence(row: Row, linear: LinearAnalysis) -> dict[int, Coefficient]:
    """Return node -> coefficient; terms that cancel by their numbers are left out."""
    found: dict[int, Coefficient] = {}
    for position, coefficient in linear.coefficients(row.expression).items():
        ref = row.refs[position]
        if ref.kind != "node":
            continue
        signed = coefficient if ref.sign > 0 else linear.negated(coefficient)
        if ref.number not in found:
            found[ref.number] = signed
            continue
        earlier = found[ref.number]
        both = earlier + signed if isinstance(earlier, float) and isinstance(signed, float) else None
        if both == 0.0:
            del found[ref.number]
        else:
            found[ref.number] = both
    return found


class Evaluator:
    """Evaluates rows: class-level expressions as CasADi functions, applied to an instance's own expressions."""

    def __init__(self) -> None:
        self._functions: dict[tuple[Expression, int], tuple[SX, ca.Function]] = {}

    def __call__(self, row: Row, lookup: Callable[[Ref], SX], value: SX | None = None) -> SX:
        """Return the row's expression (or ``value``, over the same symbols) with each ref looked up."""
        expression = row.expression.value if value is None else value
        symbols = row.expression.symbols
        if not symbols:
            return expression
        key = (row.expression, expression.element_hash())
        if key not in self._functions:
            function = ca.Function("row", [ca.vertcat(*symbols)], [expression])
            self._functions[key] = (expression, function)  # the expression is kept: its hash is its address
        arguments = [lookup(r) if r.sign > 0 else -lookup(r) for r in row.refs]
        result: SX = self._functions[key][1](ca.vertcat(*arguments))
        return result
