"""The classes that users subclass: Component, Connector, Record."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, ClassVar, TypeAlias, dataclass_transform

from casadi import SX

from arthur_acausal.declare.quantity import Real, parameter
from arthur_acausal.declare.scope import Scope
from arthur_acausal.errors import DeclarationError, nearest

Equations: TypeAlias = Iterator[Any]

MISSING: Any = object()


@dataclass(frozen=True, slots=True)
class Declarations:
    """What a class declares, bases first: quantities, parts, structural parameters (name -> default or MISSING)."""

    quantities: dict[str, Real] = field(default_factory=dict)
    parts: dict[str, Any] = field(default_factory=dict)
    structural: dict[str, Any] = field(default_factory=dict)
    fixed: frozenset[str] = frozenset()  # parts that the caller may not replace
    slot: dict[str, int] = field(default_factory=dict)  # place of a quantity within its own space


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
                    f"{cls.__name__}.{name} hides a declared quantity or part", path=cls.__name__
                )
    counts = {"variable": 0, "parameter": 0, "discrete": 0}
    slot: dict[str, int] = {}
    for name, quantity in quantities.items():
        slot[name] = counts[quantity.space]
        counts[quantity.space] += 1
    return Declarations(quantities, parts, structural, frozenset(fixed), slot)


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
        where = _caller()
        for name in modifications:
            if name in declared.fixed:
                raise DeclarationError(
                    f"{type(self).__name__}.{name} is a fixed part",
                    where=where,
                    remedy=f"annotate it: {name}: ... = ...",
                )
            if (
                name not in declared.quantities
                and name not in declared.parts
                and name not in declared.structural
            ):
                known = [*declared.quantities, *declared.parts, *declared.structural]
                raise DeclarationError(
                    f"{type(self).__name__} has no {name!r}",
                    where=where,
                    remedy=nearest(name, known) or f"it has {', '.join(known) or 'nothing to modify'}",
                )
        self.__dict__.update(_modifications=modifications, _binding=None, _where=where)
        for name, default in declared.structural.items():
            if name in modifications or default is not MISSING:
                self.__dict__[name] = modifications.get(name, default)

    def _symbol(self, quantity: Real) -> SX:
        binding = self._binding
        if binding is None:
            value = self._modifications.get(quantity.name, quantity.default)
            if isinstance(value, int | float):
                return SX(value)
            raise DeclarationError(
                f"{type(self).__name__}.{quantity.name} has no symbol yet",
                where=self._where,
                cause="the component is not part of a model: its symbols exist inside build() and equations()",
            )
        return binding.scope.symbol(
            quantity.space, binding.first[quantity.space] + self._declarations.slot[quantity.name]
        )

    def __repr__(self) -> str:
        place = f" at {self._binding.path!r}" if self._binding else ""
        return f"<{type(self).__name__}{place}>"


def _caller() -> str:
    """Return file:line of the code that makes the component, outside of this package's declare layer."""
    frame = sys._getframe(2)
    return f"{frame.f_code.co_filename.rsplit('/', 1)[-1]}:{frame.f_lineno}"


@dataclass_transform(kw_only_default=True, field_specifiers=(parameter,))
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
        binding = self._binding
        is_list = isinstance(value, list) and bool(value) and all(isinstance(item, Model) for item in value)
        if isinstance(value, Model) or is_list:
            if binding is None:
                raise DeclarationError(
                    f"{type(self).__name__}.{name}: parts are made in the class body or in build()"
                )
            value = _adopt(self, name, value)
        object.__setattr__(self, name, value)


@dataclass_transform(kw_only_default=True, field_specifiers=(parameter,))
class Connector(Model):
    """Where components meet: potentials are equal, flows sum to zero.

    ``medium``: a Record class that all components of a connection set share (the fluid of a hydraulic port).
    """

    medium: ClassVar[type[Record] | None] = None


@dataclass_transform(kw_only_default=True, field_specifiers=(parameter,))
class Record(Model):
    """A named set of parameters that several components may share."""


def bind(template: Model, name: str, scope: Scope, owner: Model | None) -> Model:
    """Return an instance of ``template`` at ``owner.name`` in ``scope``, with everything below it.

    Its own quantities are numbered first, then those of its parts in order: a component without parts of its own
    kind takes consecutive numbers, whatever its place.
    """
    if template._binding is not None:
        raise DeclarationError(
            f"one {type(template).__name__} is used at two places: {template._binding.path} and {name}",
            path=owner._binding.path if owner and owner._binding else "",
            where=template._where,
            remedy="make one component for each place; only a Record may be shared",
        )
    above = owner._binding if owner is not None else None
    path = f"{above.path}.{name}" if above and above.path else name
    bound = type(template).__new__(type(template))
    binding = Binding(
        scope,
        path,
        {"variable": len(scope.variable), "parameter": len(scope.parameter), "discrete": len(scope.discrete)},
        owner,
        above.depth + 1 if above else 0,
    )
    bound.__dict__.update(template.__dict__)
    bound.__dict__["_binding"] = binding
    _check_structural(bound, path)
    _number_quantities(bound, binding)
    for part, default in bound._declarations.parts.items():
        given = bound._modifications.get(part, default)
        if part in bound._modifications:
            binding.explicit.add(part)
        bound.__dict__[part] = _bind_part(
            bound, part, given, owner if part in bound._modifications else bound
        )
    if isinstance(bound, Component):
        bound.build()
    return bound


def _adopt(owner: Model, name: str, value: Any) -> Any:
    if isinstance(value, list):
        return [_bind_part(owner, f"{name}[{i}]", item, owner) for i, item in enumerate(value)]
    return _bind_part(owner, name, value, owner)


def _bind_part(owner: Model, name: str, given: Any, author: Model | None) -> Model:
    """Bind one part below ``owner``; a record that already has its place is shared.

    ``author`` is the instance in whose class the part was written: there, one component object has one place.
    """
    binding = owner._binding
    assert binding is not None
    if callable(given) and not isinstance(given, Model):
        given = given(binding.owner)
    if not isinstance(given, Model):
        raise DeclarationError(
            f"{type(owner).__name__}.{name} must be a component, connector or record, not {given!r}",
            path=binding.path,
            where=owner._where,
        )
    if isinstance(given, Record) and given._binding is not None:
        # numbered anew, so that a class's numbering is the same everywhere; its values are those of the shared one
        part = bind(_unbound(given), name, binding.scope, owner)
        binding.scope.shared.append((part, given))
        binding.explicit.add(name)
        binding.children.append(part)
        return part
    part = bind(given, name, binding.scope, owner)
    if not isinstance(given, Record):
        earlier, _ = binding.scope.places.setdefault(
            (id(given), id(author)), (part, given)
        )  # kept: ids stay unique
        if earlier is not part:
            assert earlier._binding is not None and part._binding is not None
            raise DeclarationError(
                f"one {type(given).__name__} is used at two places: {earlier._binding.path} and {part._binding.path}",
                where=given._where,
                remedy="make one component for each place; only a Record may be shared",
            )
    binding.children.append(part)
    return part


def _unbound(record: Record) -> Record:
    copy = type(record).__new__(type(record))
    copy.__dict__.update(
        {k: v for k, v in record.__dict__.items() if not isinstance(v, Model)}, _binding=None
    )
    copy.__dict__["_modifications"] = dict.fromkeys(
        (n for n, q in record._declarations.quantities.items() if q.kind == "parameter"), 0.0
    ) | {n: v for n, v in record._modifications.items() if n in record._declarations.structural}
    return copy


def _check_structural(bound: Model, path: str) -> None:
    missing = [
        n for n, d in bound._declarations.structural.items() if d is MISSING and n not in bound._modifications
    ]
    if missing:
        raise DeclarationError(
            f"{type(bound).__name__} needs {', '.join(missing)}",
            path=path,
            where=bound._where,
            remedy=f"give it: {type(bound).__name__}({missing[0]}=...)",
        )


def _number_quantities(bound: Model, binding: Binding) -> None:
    from arthur_acausal.declare.modify import declared

    prefix = f"{binding.path}." if binding.path else ""
    scope = binding.scope
    for name, quantity in bound._declarations.quantities.items():
        entry = declared(bound, prefix + name, quantity, bound._modifications.get(name, MISSING))
        getattr(scope, quantity.space).append(entry)
