"""The classes that users subclass: Component, Connector, Record."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from types import NoneType
from typing import Any, ClassVar, TypeAlias, dataclass_transform, get_args

from casadi import SX

from arthur_acausal.declare.authored import calling_line
from arthur_acausal.declare.quantity import Real, parameter
from arthur_acausal.declare.scope import Scope
from arthur_acausal.declare.vector import column, constant, expanded, size_of
from arthur_acausal.errors import DeclarationError, nearest_or_all

Equations: TypeAlias = Iterator[Any]

MISSING: Any = object()


@dataclass(frozen=True, slots=True)
class Declarations:
    """What a class declares, bases first: quantities, parts, structural parameters (name -> default or MISSING).

    ``written``: the quantities as they are declared; ``quantities``: the same with the elements of vectors, by which
    everything else counts; ``vectors``: the number of elements, of a class 0 where only an instance knows it.
    """

    written: dict[str, Real] = field(default_factory=dict)
    quantities: dict[str, Real] = field(default_factory=dict)
    parts: dict[str, Any] = field(default_factory=dict)
    structural: dict[str, Any] = field(default_factory=dict)
    fixed: frozenset[str] = frozenset()  # parts that the caller may not replace
    slot: dict[str, int] = field(default_factory=dict)  # place of a quantity within its own space
    vectors: dict[str, int] = field(default_factory=dict)

    @property
    def names(self) -> list[str]:
        """What the caller may give, and all that is declared."""
        return [*self.written, *self.parts, *self.structural]

    def sized(self, instance: Model) -> Declarations:
        """Return the declarations with the vectors of which only the instance knows the size."""
        sizes = {name: size_of(self.written[name], instance) for name in self.vectors}
        return self if sizes == self.vectors else replace(self, **_numbered(self.written, sizes))


@dataclass(slots=True)
class Binding:
    """Where an instance stands in a model: its scope, path, and the first numbers of its own quantities."""

    scope: Scope
    path: str
    first: dict[str, int]
    owner: Model | None
    depth: int
    children: list[Model] = field(default_factory=list)
    explicit: set[str] = field(default_factory=set)  # parts that the caller gave
    complete: bool = False  # all parts are made: build() is over


def _is_class_variable(annotation: Any) -> bool:
    text = annotation if isinstance(annotation, str) else str(annotation)
    return text.startswith(("ClassVar", "typing.ClassVar"))


def _collect(cls: type) -> Declarations:
    quantities: dict[str, Real] = {}
    parts: dict[str, Any] = {}
    structural: dict[str, Any] = {}
    fixed: set[str] = set()
    for base in reversed(cls.__mro__):
        if base is object or base.__module__ == __name__:
            continue
        annotations = inspect.get_annotations(base)
        names = list(annotations) + [n for n in base.__dict__ if n not in annotations]
        for name in names:
            value = base.__dict__.get(name, MISSING)
            if name.startswith("_") or (name in annotations and _is_class_variable(annotations[name])):
                continue
            if isinstance(value, Real):
                quantities[name] = value
            elif isinstance(value, Model):
                parts[name] = value
                fixed.discard(name)
                if name not in annotations:
                    fixed.add(name)
            elif name in annotations:
                structural[name] = value
            elif name in parts or name in quantities:
                raise DeclarationError(
                    f"{cls.__name__}.{name} hides a declared quantity or part",
                    where=calling_line(),
                    remedy=f"declare it anew, with its annotation: {name}: ... = ..., or choose another name",
                )
    vectors = {
        n: 0 if callable(q.shape) else size_of(q, None) for n, q in quantities.items() if q.shape is not None
    }
    return Declarations(
        quantities,
        parts=parts,
        structural=structural,
        fixed=frozenset(fixed),
        **_numbered(quantities, vectors),
    )


def _numbered(written: dict[str, Real], vectors: dict[str, int]) -> dict[str, Any]:
    """Return what the declarations hold of the quantities one by one, for vectors of these sizes."""
    quantities = expanded(written, vectors)
    counts = {"variable": 0, "parameter": 0, "discrete": 0}
    slot: dict[str, int] = {}
    for name, quantity in quantities.items():
        slot[name] = counts[quantity.space]
        counts[quantity.space] += 1
    return {"quantities": quantities, "slot": slot, "vectors": vectors}


def constraint(cls: type, name: str) -> tuple[type, ...]:
    """Return the classes that the annotation of a part names; none where they cannot be found by their names.

    NoneType is one of them where the part may be absent.
    """
    for base in cls.__mro__:
        annotation = inspect.get_annotations(base).get(name)
        if annotation is None:
            continue
        if isinstance(annotation, type):
            return (annotation,)
        if not isinstance(annotation, str):
            return tuple(k for k in get_args(annotation) if isinstance(k, type))
        module = sys.modules.get(base.__module__)  # a notebook's or a page's may be none
        known = {"None": NoneType, **(vars(module) if module is not None else {})}
        found = [known.get(text.strip()) for text in annotation.strip("\"'").split("|")]
        return (
            tuple(k for k in found if isinstance(k, type)) if all(isinstance(k, type) for k in found) else ()
        )
    return ()


class Model:
    """What components, connectors and records share: keyword arguments modify what the class declares."""

    _declarations: ClassVar[Declarations] = Declarations()
    _modifications: dict[str, Any]
    _binding: Binding | None
    _where: str

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls._declarations = _collect(cls)

    def __init__(self, **modifications: Any) -> None:
        declared = self._declarations
        where = calling_line()
        for name in modifications:
            if name in declared.fixed:
                raise DeclarationError(
                    f"{type(self).__name__}.{name} is a fixed part",
                    where=where,
                    remedy=f"annotate it: {name}: ... = ...",
                )
            if (
                name not in declared.written
                and name not in declared.parts
                and name not in declared.structural
            ):
                raise DeclarationError(
                    f"{type(self).__name__} has no {name!r}",
                    where=where,
                    remedy=nearest_or_all(name, declared.names),
                )
        self.__dict__.update(_modifications=modifications, _binding=None, _where=where)
        for name, default in declared.structural.items():
            if name in modifications or default is not MISSING:
                self.__dict__[name] = modifications.get(name, default)
        self.__dict__.update((n, given) for n, given in modifications.items() if isinstance(given, Record))

    def _symbol(self, quantity: Real) -> SX:
        binding = self._binding
        if binding is None:
            value = self._modifications.get(quantity.name, quantity.default)
            if quantity.shape is not None and (vector := constant(quantity, self, value)) is not None:
                return vector
            if isinstance(value, int | float):
                return SX(value)
            raise DeclarationError(
                f"{type(self).__name__}.{quantity.name} has no symbol here",
                cause=f"the {type(self).__name__} made at {self._where} is not part of the model",
                remedy="make it a part, in the class body or in build(); equations use their component and its parts",
            )
        first, slot = binding.first[quantity.space], self._declarations.slot
        if quantity.shape is None:
            return binding.scope.symbol(quantity.space, first + slot[quantity.name])
        names = [f"{quantity.name}[{k}]" for k in range(self._declarations.vectors[quantity.name])]
        return column([binding.scope.symbol(quantity.space, first + slot[name]) for name in names])

    def __repr__(self) -> str:
        place = f" at {self._binding.path!r}" if self._binding else ""
        return f"<{type(self).__name__}{place}>"


def title_of(model: Model) -> str:
    """Return what messages call an instance: its path, or its class where it is a whole model."""
    return (model._binding.path if model._binding else "") or type(model).__name__


@dataclass_transform(kw_only_default=True, eq_default=False, field_specifiers=(parameter,))
class Component(Model):
    """A piece of a model: parameters, variables, connectors, parts, and the equations between them.

    Subclasses declare quantities and parts in the class body, may create parts in ``build`` (arrays, conditional
    parts), and yield their equations from ``equations``; ``initial_equations`` hold at the start only.
    """

    def build(self) -> None:
        """Create parts that depend on structural parameters: ``self.cells = [Cell() for _ in range(self.n)]``."""

    def equations(self) -> Equations:
        """Yield equations (``lhs == rhs``, optionally after a label), ``connect`` and ``when`` statements."""
        yield from ()

    def initial_equations(self) -> Equations:
        """Yield equations that hold at the start of a run only."""
        yield from ()

    def __setattr__(self, name: str, value: Any) -> None:
        is_list = isinstance(value, list | tuple) and any(isinstance(item, Model) for item in value)
        if isinstance(value, Model) or is_list:
            from arthur_acausal.declare.bind import (
                adopt,
            )  # which binds instances of the classes of this module

            value = adopt(self, name, value)
        object.__setattr__(self, name, value)


@dataclass_transform(kw_only_default=True, eq_default=False, field_specifiers=(parameter,))
class Connector(Model):
    """Where components meet: potentials are equal, flows sum to zero.

    ``medium``: a Record class that all components of a connection set share (the fluid of a hydraulic port).
    """

    medium: ClassVar[type[Record] | None] = None

    def power(self) -> SX | None:
        """Return the power [W] that enters the component here: of its quantities, and their `der`; None: not said."""
        return None


@dataclass_transform(kw_only_default=True, eq_default=False, field_specifiers=(parameter,))
class Record(Model):
    """A named set of parameters that several components may share."""
