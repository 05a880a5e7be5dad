"""Scopes: the numbering of everything declared below one root, and its CasADi symbols, created when asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple, TypeAlias

from casadi import SX

from arthur_acausal.declare.quantity import Quantity, Start
from arthur_acausal.errors import DeclarationError

AtomKind: TypeAlias = Literal[
    "variable",
    "left",
    "der",
    "parameter",
    "discrete",
    "pre",
    "mode",
    "time",
    "initial",
    "homotopy",
    "external",
]


class Atom(NamedTuple):
    """What one symbol stands for: its kind, and its number among the variables, parameters, discretes, relations
    or outputs of external functions."""

    kind: AtomKind
    number: int


@dataclass(slots=True)
class Declared:
    """One quantity at its place in the model: ``value`` is the modification or default of a parameter."""

    path: str
    quantity: Quantity
    value: Any = None
    start: Start | None = None
    depth: int = 0  # of the modification's owner; 0 is the root: the outermost modification wins
    where: str = ""  # file:line of the component that it belongs to

    @property
    def guessed(self) -> bool:
        """Whether a start value was chosen for this place: by a modification, or by the whole model's own class."""
        if self.start is None or self.start.value is None:
            return False
        return self.depth <= self.path.count(".") or "." not in self.path


class Later(NamedTuple):
    """A value given as a function of the component ``source``: it is called when all parts are there."""

    entry: Declared
    function: Callable[[Any], Any]
    bound: Any
    source: Any


@dataclass(frozen=True, slots=True)
class Relation:
    """A comparison that makes events: true where ``g`` > 0, or >= 0 if ``inclusive``."""

    g: SX
    inclusive: bool
    where: str
    text: str


class ExternalOutput(NamedTuple):
    """One output of a call of an external function: how people read it, and its unit, empty if not known."""

    name: str
    unit: str


@dataclass(slots=True)
class Scope:
    """All declared quantities below one root, by space, in the order of declaration."""

    variable: list[Declared] = field(default_factory=list)
    parameter: list[Declared] = field(default_factory=list)
    discrete: list[Declared] = field(default_factory=list)
    relations: list[Relation] = field(default_factory=list)
    external: list[ExternalOutput] = field(default_factory=list)
    places: dict[tuple[int, int], Any] = field(
        default_factory=dict
    )  # (component object, its author) -> instance
    shared: list[tuple[Any, Any]] = field(
        default_factory=list
    )  # (record of a component, the record that it stands for)
    later: list[Later] = field(default_factory=list)
    structural: dict[str, Any] = field(
        default_factory=dict
    )  # path of a structural parameter -> what replaces all that its model says
    prefix: str = ""  # of all paths, left out in names: a component class reads the same in all its places
    makes_events: bool = True
    _symbols: dict[Atom, SX] = field(default_factory=dict)
    _atoms: dict[int, Atom] = field(default_factory=dict)

    def symbol(self, kind: AtomKind, index: int) -> SX:
        """Return the symbol of an atom."""
        atom = Atom(kind, index)
        found = self._symbols.get(atom)
        if found is None:
            found = SX.sym(self.name(atom))
            self._symbols[atom] = found
            self._atoms[found.element_hash()] = atom
        return found

    def name(self, atom: Atom) -> str:
        """Return how people read an atom."""
        match atom.kind:
            case "der":
                return f"der({self.short(self.variable[atom.number].path)})"
            case "left":
                return f"pre({self.short(self.variable[atom.number].path)})"
            case "pre":
                return f"pre({self.short(self.discrete[atom.number].path)})"
            case "mode":
                return f"relation[{atom.number}]"
            case "time" | "homotopy":
                return atom.kind
            case "initial":
                return "initial()"
            case "external":
                return self.external[atom.number].name
            case _:
                return self.short(getattr(self, atom.kind)[atom.number].path)

    def short(self, path: str) -> str:
        """Return a path as seen from the scope's root."""
        return path.removeprefix(self.prefix)

    def atom(self, symbol: SX) -> Atom | None:
        """Return what a symbol stands for; None if it is not a plain symbol of this scope."""
        if not isinstance(symbol, SX) or symbol.numel() != 1 or not symbol.is_symbolic():
            return None
        return self._atoms.get(symbol.element_hash())

    def quantity(self, atom: Atom) -> Quantity | None:
        """Return the declaration behind an atom; None for time, relations and the like."""
        space = {"der": "variable", "left": "variable", "pre": "discrete"}.get(atom.kind, atom.kind)
        if space in ("time", "mode", "initial", "homotopy", "external"):
            return None
        declared: Declared = getattr(self, space)[atom.number]
        return declared.quantity


_current: ContextVar[Scope | None] = ContextVar("scope", default=None)


def current_scope(what: str) -> Scope:
    """Return the scope whose equations are being written; ``what`` is named if there is none."""
    scope = _current.get()
    if scope is None:
        raise DeclarationError(
            f"{what} is used outside of equations() and build()",
            remedy="equations are made where the component is instantiated: move it into equations()",
        )
    return scope


@contextmanager
def using(scope: Scope) -> Iterator[Scope]:
    """Make ``scope`` the current one."""
    token = _current.set(scope)
    try:
        yield scope
    finally:
        _current.reset(token)
