"""Binding: from what the author wrote to instances that have their place, path and numbers in a model."""

from __future__ import annotations

from types import NoneType
from typing import Any

from casadi import SX

from arthur_acausal.declare.authored import authored
from arthur_acausal.declare.model import MISSING, Binding, Component, Model, Record, constraint
from arthur_acausal.declare.modify import declared, settle
from arthur_acausal.declare.scope import Scope, using
from arthur_acausal.declare.vector import split
from arthur_acausal.errors import DeclarationError, UsageError


def bind_root(model: Model, scope: Scope) -> Model:
    """Return the instance of a whole model in ``scope``, with every value that was given as a function."""
    scope.makes_events = False  # values of parameters and start values do not change at events
    with using(scope):
        root = bind(model, "", scope, None)
        settle(scope)
    if scope.structural:
        path = next(iter(scope.structural))
        raise UsageError(f"{path} is no structural parameter of {type(model).__name__}")
    scope.makes_events = True
    return root


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
    if scope.structural:
        _replace_structural(bound, path)
    _check_structural(bound, path)
    if bound._declarations.vectors:
        with authored("the shape of a vector", path or type(bound).__name__, bound._where):
            bound.__dict__["_declarations"] = bound._declarations.sized(bound)
    _number_quantities(bound, binding)
    parts = bound._declarations.parts | _optional_parts(bound)
    # records first: the other parts may be given them
    for part, default in sorted(parts.items(), key=lambda item: not isinstance(item[1], Record)):
        given = bound._modifications.get(part, default)
        if part in bound._modifications:
            binding.explicit.add(part)
        if given is None and NoneType in constraint(type(bound), part):
            bound.__dict__[part] = None
            continue
        bound.__dict__[part] = _bind_part(
            bound, part, given, owner if part in bound._modifications else bound
        )
        if part in bound._modifications:
            _check_constraint(bound, part)
    if isinstance(bound, Component):
        with authored("build()", path or type(bound).__name__, bound._where):
            bound.build()
    binding.complete = True
    return bound


def _optional_parts(bound: Model) -> dict[str, Model]:
    """Return the parts that the class declares without one of its own: ``brake: Brake | None = None``."""
    values = bound.__dict__
    return {n: values[n] for n in bound._declarations.structural if isinstance(values[n], Model)}


def adopt(owner: Model, name: str, value: Any) -> Any:
    """Bind what ``build`` assigned: a part, or a list of parts."""
    declared, binding = owner._declarations, owner._binding
    if binding is None or binding.complete:
        raise DeclarationError(
            f"{type(owner).__name__}.{name} is made too late",
            remedy="parts are made in the class body or in build()",
        )
    if (
        name in declared.parts
        or name in declared.written
        or isinstance(owner.__dict__.get(name), Model | list)
    ):
        raise DeclarationError(
            f"{type(owner).__name__}.{name} is made twice",
            remedy="make it in the class body or in build(), once",
        )
    if isinstance(value, list | tuple):
        strange = next((item for item in value if not isinstance(item, Model)), None)
        if strange is not None:
            raise DeclarationError(
                f"{type(owner).__name__}.{name} mixes parts with {strange!r}",
                remedy="a list of parts holds parts only",
            )
        return [_bind_part(owner, f"{name}[{i}]", item, owner) for i, item in enumerate(value)]
    return _bind_part(owner, name, value, owner)


def _bind_part(owner: Model, name: str, given: Any, author: Model | None) -> Model:
    """Bind one part below ``owner``; a record that already has its place is shared.

    ``author`` is the instance in whose class the part was written: there, one component object has one place.
    """
    binding = owner._binding
    assert binding is not None
    if callable(given) and not isinstance(given, Model):
        with authored(f"the function for {name}", binding.path, owner._where):
            given = given(binding.owner)
    if not isinstance(given, Model):
        raise DeclarationError(
            f"{type(owner).__name__}.{name} must be a component, connector or record, not {given!r}",
            path=binding.path,
            where=owner._where,
            remedy=f"give an instance, {type(owner).__name__}({name}=SomeClass(...))",
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
    """Return a copy without a place; its values stand for nothing, since those of ``record`` count."""
    copy = type(record).__new__(type(record))
    copy.__dict__.update(record.__dict__, _binding=None)
    copy.__dict__["_modifications"] = (
        dict.fromkeys(
            (n for n, q in record._declarations.quantities.items() if q.kind == "parameter"), SX(0.0)
        )
        | {n: v for n, v in record._modifications.items() if n in record._declarations.structural}
        | {n: v for n, v in record.__dict__.items() if isinstance(v, Record)}
    )
    return copy


def _check_constraint(bound: Model, part: str) -> None:
    """Raise DeclarationError where the caller's part is not of the class that the annotation says."""
    wanted = constraint(type(bound), part)
    given = bound.__dict__[part]
    if wanted and not isinstance(given, wanted):
        names = " or ".join("None" if kind is NoneType else kind.__name__ for kind in wanted)
        raise DeclarationError(
            f"{type(bound).__name__}.{part} must be a {names}, which {type(given).__name__} is not",
            path=bound._binding.path if bound._binding else "",
            where=bound._where,
            cause=f"the annotation in {type(bound).__name__}, {part}: {names}, is what any replacement must be",
            remedy=f"give a subclass of {names}, or annotate the part with a base class of both",
        )


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


def _replace_structural(bound: Model, path: str) -> None:
    """Take over, and out of the scope, what is given for the structural parameters of this instance."""
    given = bound._binding.scope.structural if bound._binding else {}
    for name in bound._declarations.structural:
        whole = f"{path}.{name}" if path else name
        if whole in given:
            bound.__dict__[name] = given[whole]
            bound.__dict__["_modifications"] = {**bound._modifications, name: given.pop(whole)}


def _number_quantities(bound: Model, binding: Binding) -> None:
    prefix = f"{binding.path}." if binding.path else ""
    scope, modifications = binding.scope, bound._modifications
    if bound._declarations.vectors:
        with authored("a value", binding.path or type(bound).__name__, bound._where):
            modifications = split(modifications, bound._declarations.vectors)
    for name, quantity in bound._declarations.quantities.items():
        entry = declared(bound, prefix + name, quantity, modifications.get(name, MISSING))
        getattr(scope, quantity.space).append(entry)
