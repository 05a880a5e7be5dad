"""The flat system: variables, parameters and equations by number, and the components that they came from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from arthur_acausal.declare.model import Component
from arthur_acausal.declare.scope import Atom, Declared, Scope
from arthur_acausal.flatten.block import Call, Clause, Comparison, Equation, Sampling
from arthur_acausal.flatten.connections import Alias


class Shift(NamedTuple):
    """From a component class's own numbering to the model's: what is added to each kind of number."""

    variable: int = 0
    parameter: int = 0
    discrete: int = 0
    mode: int = 0


UNSHIFTED = Shift()


@dataclass(frozen=True, slots=True)
class FlatEquation:
    """One equation of the model: a class-level expression, and where its symbols stand in the model."""

    equation: Equation
    path: str
    shift: Shift = UNSHIFTED
    indices: tuple[int, ...] | None = None  # of a flow sum: its variables, in the order of the symbols

    def atoms(self) -> list[Atom]:
        """Return what the equation's symbols stand for in the model, in their order."""
        if self.indices is not None:
            return [Atom("variable", i) for i in self.indices]
        if self.shift == UNSHIFTED:
            return self.equation.atoms
        return [shifted(atom, self.shift) for atom in self.equation.atoms]

    @property
    def text(self) -> str:
        """What an error message calls the equation: path, label (or the equation itself), file:line."""
        return f"{self.path} {self.equation.name} ({self.equation.where})".lstrip()


def shifted(atom: Atom, shift: Shift) -> Atom:
    """Return the model's atom behind a component class's own."""
    match atom.kind:
        case "variable" | "left" | "der":
            return Atom(atom.kind, atom.number + shift.variable)
        case "parameter":
            return Atom(atom.kind, atom.number + shift.parameter)
        case "discrete" | "pre":
            return Atom(atom.kind, atom.number + shift.discrete)
        case "mode":
            return Atom(atom.kind, atom.number + shift.mode)
    return atom


@dataclass(frozen=True, slots=True)
class FlatRelation:
    """A relation of one component instance."""

    relation: Comparison
    path: str
    shift: Shift


@dataclass(frozen=True, slots=True)
class FlatClause:
    """A ``when`` (or a discrete equation) of one component instance."""

    clause: Clause
    path: str
    shift: Shift


@dataclass(frozen=True, slots=True)
class FlatSampling:
    """A periodic call of one component instance."""

    sampling: Sampling
    path: str
    shift: Shift


@dataclass(frozen=True, slots=True)
class FlatCall:
    """A call of an external function by one component instance, in the model's own numbers."""

    call: Call
    path: str

    @property
    def text(self) -> str:
        """What an error message calls it: path, label and name of the function, file:line."""
        label = f'"{self.call.label}" ' if self.call.label else ""
        return f"{self.path} {label}{self.call.function.name} ({self.call.where})".lstrip()


@dataclass(frozen=True, slots=True)
class FlatSystem:
    """All that a model says, in numbers: the input of the transformations.

    ``scope`` holds variables, parameters and discretes in the order of declaration; ``inputs`` are the variables
    that come from outside; ``parameter_aliases`` maps a parameter to the one that it stands for (a shared medium).
    """

    name: str
    scope: Scope
    equations: list[FlatEquation]
    initial: list[FlatEquation]
    aliases: list[Alias]
    relations: list[FlatRelation]
    clauses: list[FlatClause]
    samplings: list[FlatSampling]
    calls: list[FlatCall]
    inputs: list[int]
    parameter_aliases: dict[int, int]
    components: list[Component]

    @property
    def variables(self) -> list[Declared]:
        """All continuous quantities."""
        return self.scope.variable

    def parameter(self, i: int) -> int:
        """Return the parameter that parameter i stands for: itself, or that of a shared record."""
        while i in self.parameter_aliases:
            i = self.parameter_aliases[i]
        return i

    @property
    def n_equations(self) -> int:
        """How many raw equations there are, those of connections and inputs included."""
        return len(self.equations) + len(self.aliases) + len(self.inputs)
