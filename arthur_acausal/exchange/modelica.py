"""One flat Modelica model of a translated model: ``to_modelica``.

Every variable keeps its path as a quoted identifier, 'load.flange.s'; equations stand as they were written, with
component, label and source line behind them. What comes from outside are inputs with their default values. States
whose start value is taken because nothing else is said are fixed, so that every tool starts from the same point.
Modelica Language Specification 3.6, chapters 3, 8 and appendix A.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import zip_longest
from typing import Any

import casadi as ca
from casadi import SX

from arthur_acausal.declare.scope import Atom, Declared
from arthur_acausal.errors import UsageError
from arthur_acausal.exchange.expression import Printer, number
from arthur_acausal.exchange.names import identifier, model_name, text, unit
from arthur_acausal.flatten.block import Expression
from arthur_acausal.flatten.system import UNSHIFTED, FlatClause, FlatEquation, FlatSystem, Shift, shifted

STATE_SELECT = {"never", "avoid", "prefer", "always"}


@dataclass(frozen=True, slots=True)
class Given:
    """What a model does not say itself.

    ``fixed``: states whose start values are taken though they are not declared as fixed, with these values;
    ``parameters``: values in place of the model's own; both by path.
    """

    fixed: Mapping[str, float] = field(default_factory=dict)
    parameters: Mapping[str, float] = field(default_factory=dict)
    stop_time: float | None = None
    tolerance: float = 1e-6


def to_modelica(flat: FlatSystem, given: Given | None = None) -> str:
    """Return the text of a flat Modelica model.

    Raises UsageError for what Modelica has no words for: functions in Python, external or called at samples.
    """
    return "\n".join(_Writer(flat, given or Given()).lines()) + "\n"


class _Writer:
    whole: frozenset[int]

    def __init__(self, flat: FlatSystem, given: Given) -> None:
        self.flat, self.given = flat, given
        self.inputs = set(flat.inputs)
        self.assigned = {
            a.target.number + c.shift.discrete
            for c in flat.clauses
            for a in c.clause.assignments
            if a.target is not None and a.target.kind == "discrete" and c.clause.condition is not None
        }
        self.whole = self._whole_numbers()

    def lines(self) -> Iterator[str]:
        """All lines of the model."""
        flat = self.flat
        if flat.samplings:
            sampling = flat.samplings[0]
            raise UsageError(
                f"{sampling.path} calls a function of Python at its samples, which has no form in Modelica",
                where=sampling.sampling.where,
                remedy="replace it by discrete equations for the export",
            )
        if flat.calls:
            raise UsageError(
                f"{flat.calls[0].text}: an external function has no form in Modelica",
                where=flat.calls[0].call.where,
                remedy="replace it by equations for the export",
            )
        name = model_name(flat.name)
        root = flat.components[0]
        about = (type(root).__doc__ or "").strip().split("\n")[0]
        yield f"model {name} {text(about)}" if about else f"model {name}"
        yield from self._declarations()
        if flat.initial:
            yield "initial equation"
            yield from map(self._equation, flat.initial)
        yield "equation"
        for alias in flat.aliases:
            yield f"  {self._variable(alias.i)} = {self._variable(alias.j)};{_comment('connect', alias.where)}"
        yield from map(self._equation, flat.equations)
        yield from self._clauses()
        yield from self._experiment()
        yield f"end {name};"

    def _experiment(self) -> Iterator[str]:
        given = self.given
        if given.stop_time is not None:
            stop, tolerance = number(given.stop_time), number(given.tolerance)
            yield f"  annotation(experiment(StopTime={stop}, Tolerance={tolerance}));"

    # --- declarations

    def _declarations(self) -> Iterator[str]:
        scope = self.flat.scope
        for i, d in enumerate(scope.parameter):
            if i not in self.flat.parameter_aliases:
                value = self._value(self.given.parameters.get(d.path, d.value), d.path)
                yield f"  parameter Real {identifier(d.path)}{_attributes(self._bounds(d))} = {value}{_about(d)};"
        for i, d in enumerate(scope.variable):
            if i in self.inputs:
                default = self._value(d.value, d.path) if d.value is not None else "0"
                yield f"  input Real {identifier(d.path)}{_attributes(self._bounds(d))} = {default}{_about(d)};"
            else:
                yield f"  Real {identifier(d.path)}{_attributes(self._variable_attributes(d))}{_about(d)};"
        for i, d in enumerate(scope.discrete):
            start = self._value(d.start.value if d.start is not None else 0.0, d.path)
            kind = "Integer" if i in self.whole else "discrete Real" if i in self.assigned else "Real"
            if i in self.whole and d.start is not None and not _is_number(d.start.value):
                start = f"integer({start})"
            bounds = self._bounds(d) if i not in self.whole else []
            values = [*bounds, f"start={start}", "fixed=true"]
            yield f"  {kind} {identifier(d.path)}{_attributes(values)}{_about(d)};"

    def _bounds(self, d: Declared) -> list[str]:
        q = d.quantity
        found = []
        if (spelled := unit(q.unit)) and spelled != "1":
            found.append(f'unit="{spelled}"')
        if q.min is not None:
            found.append(f"min={number(q.min)}")
        if q.max is not None:
            found.append(f"max={number(q.max)}")
        return found

    def _variable_attributes(self, d: Declared) -> list[str]:
        found = self._bounds(d)
        start = d.start
        fixed = d.path in self.given.fixed
        if start is not None and start.value is not None:
            found.append(f"start={self._value(start.value, d.path)}")
            fixed |= bool(start.fixed)
        elif fixed:
            found.append(f"start={number(self.given.fixed[d.path])}")
        if fixed:
            found.append("fixed=true")
        nominal = start.nominal if start is not None and start.nominal is not None else d.quantity.nominal
        if nominal is not None:
            found.append(f"nominal={number(nominal)}")
        if d.quantity.state_select in STATE_SELECT:
            found.append(f"stateSelect=StateSelect.{d.quantity.state_select}")
        return found

    def _value(self, value: Any, path: str) -> str:
        """Return the text of a number or of an expression of parameters."""
        if not isinstance(value, SX):
            return number(float(value))
        return self._expression(_whole(value, self.flat), UNSHIFTED, path)

    def _whole_numbers(self) -> frozenset[int]:
        """Return the discrete variables that equations, not clauses, determine as whole numbers.

        Modelica knows pre() of such a variable where it is an Integer.
        """
        starts: list[Any] = [d.start.value if d.start is not None else 0.0 for d in self.flat.scope.discrete]
        self.whole = frozenset(
            i
            for i, value in enumerate(starts)
            if i not in self.assigned and (not _is_number(value) or float(value).is_integer())
        )
        while True:
            broken = set()
            for item in self.flat.clauses:
                for a in item.clause.assignments:
                    if a.target is not None and a.target.kind == "discrete":
                        atoms = [shifted(atom, item.shift) for atom in a.value.atoms]
                        printer = self._printer(a.value.symbols, atoms, a.where)
                        if not printer.integral(a.value.value):
                            broken.add(a.target.number + item.shift.discrete)
            if not broken & self.whole:
                return self.whole
            self.whole -= broken

    # --- expressions

    def _variable(self, i: int) -> str:
        return identifier(self.flat.variables[i].path)

    def _name(self, atom: Atom, before: Collection[int] = ()) -> str:
        """Return the text of an atom; ``before``: variables of which the value before the event is meant."""
        scope = self.flat.scope
        match atom.kind:
            case "variable" | "left":
                name = self._variable(atom.number)
                return f"pre({name})" if atom.number in before else name
            case "der":
                return f"der({self._variable(atom.number)})"
            case "parameter":
                return identifier(scope.parameter[self.flat.parameter(atom.number)].path)
            case "discrete":
                return identifier(scope.discrete[atom.number].path)
            case "pre":
                return f"pre({identifier(scope.discrete[atom.number].path)})"
            case "initial":
                return "initial()"
            case "homotopy":
                return "1.0"
        return "time"

    def _printer(
        self, symbols: Sequence[SX], atoms: Sequence[Atom], where: str, before: Collection[int] = ()
    ) -> Printer:
        names, relations = {}, {}
        held, whole = set(), set()
        for symbol, atom in zip(symbols, atoms, strict=True):
            if atom.kind in ("parameter", "discrete", "pre"):
                held.add(symbol.element_hash())
            if atom.kind in ("discrete", "pre") and atom.number in self.whole:
                whole.add(symbol.element_hash())
            if atom.kind == "mode":
                relations[symbol.element_hash()] = self._relation(atom.number, before)
            else:
                names[symbol.element_hash()] = self._name(atom, before)
        return Printer(names, relations, held, whole, where)

    def _relation(self, k: int, before: Collection[int]) -> str:
        """Return a relation as it was written, left < right: its g is right - left.

        Whole numbers in it are read before they change: event iteration goes on until they no longer do, and so a
        number that depends on a relation of itself makes no loop.
        """
        placed = self.flat.relations[k]
        g = placed.relation.g
        atoms = [shifted(a, placed.shift) for a in g.atoms]
        atoms = [
            Atom("pre", a.number) if a.kind == "discrete" and a.number in self.whole else a for a in atoms
        ]
        printer = self._printer(g.symbols, atoms, placed.relation.where, before)
        sign = "<=" if placed.relation.inclusive else "<"
        if not g.value.is_leaf() and g.value.op() == ca.OP_SUB:
            return f"{printer.operand(g.value.dep(1))} {sign} {printer.operand(g.value.dep(0))}"
        if not g.value.is_leaf() and g.value.op() == ca.OP_NEG:
            return f"{printer.operand(g.value.dep(0))} {sign} 0"
        return f"{printer.operand(g.value)} {'>=' if placed.relation.inclusive else '>'} 0"

    def _expression(
        self,
        expression: Expression,
        shift: Shift,
        where: str,
        before: Collection[int] = (),
        logical: bool = False,
    ) -> str:
        atoms = [shifted(a, shift) for a in expression.atoms]
        printer = self._printer(expression.symbols, atoms, where, before)
        return (printer.boolean if logical else printer.real)(expression.value)

    # --- equations

    def _equation(self, flat: FlatEquation) -> str:
        e = flat.equation
        printer = self._printer(e.symbols, flat.atoms(), e.where)
        return f"  {printer.real(e.lhs)} = {printer.real(e.rhs)};{_comment(flat.path, e.label, e.where)}"

    def _clauses(self) -> Iterator[str]:
        clauses = self.flat.clauses
        for item, after in zip_longest(clauses, clauses[1:]):
            clause = item.clause
            if clause.condition is None:
                yield from self._assignments(item)
                continue
            condition = self._expression(clause.condition, item.shift, clause.where, logical=True)
            word = "elsewhen" if clause.earlier else "when"
            yield f"  {word} {condition} then{_comment(item.path, clause.label, clause.where)}"
            yield from (f"  {line}" for line in self._assignments(item))
            if after is None or not after.clause.earlier:
                yield "  end when;"

    def _assignments(self, item: FlatClause) -> Iterator[str]:
        targets = {
            a.target.number + item.shift.variable
            for a in item.clause.assignments
            if a.target is not None and a.target.kind != "discrete"
        }
        for assignment in item.clause.assignments:
            target = assignment.target
            if target is None:
                yield f"  terminate({text(assignment.message)});"
                continue
            value = self._expression(assignment.value, item.shift, assignment.where, targets)
            name = self._name(shifted(target, item.shift))
            yield f"  {name} = {value};" if target.kind == "discrete" else f"  reinit({name}, {value});"


def _is_number(value: Any) -> bool:
    return not isinstance(value, SX) or bool(value.is_constant())


def _whole(value: SX, flat: FlatSystem) -> Expression:
    """Return an expression of the model's own symbols."""
    symbols = ca.symvar(value)
    atoms = [flat.scope.atom(symbol) for symbol in symbols]
    return Expression(value, symbols, [atom for atom in atoms if atom is not None])


def _attributes(values: Sequence[str]) -> str:
    return f"({', '.join(values)})" if values else ""


def _about(d: Declared) -> str:
    about = d.quantity.description
    return f" {text(about)}" if about else ""


def _comment(*parts: str) -> str:
    told = " ".join(part for part in parts if part)
    return f" // {told}" if told else ""
