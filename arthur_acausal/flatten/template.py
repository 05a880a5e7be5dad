"""Class-level blocks: the equations of a component class are run once, for all instances of the same structure."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

from casadi import SX

from arthur_acausal.declare.model import Binding, Component, Model
from arthur_acausal.declare.scope import Scope

SPACES = ("variable", "parameter", "discrete")


def structure_key(component: Component) -> Hashable | None:
    """Return what makes the equations of two instances the same; None if that cannot be told.

    Equations see symbols only, never values: the class, the plain Python attributes and the parts decide.
    """
    key = _key(component)
    try:
        hash(key)
    except TypeError:
        return None
    return key


def _key(model: Model) -> Hashable | None:
    names: list[Any] = [type(model)]
    for name, value in model.__dict__.items():
        if name.startswith("_"):
            continue
        if isinstance(value, Model):
            part = _key(value) if not isinstance(value, Component) and _is_child(value, model) else None
            if part is None:
                return None
            names.append((name, part))
        elif isinstance(value, list) and value and isinstance(value[0], Model):
            parts = tuple(_key(item) if not isinstance(item, Component) else None for item in value)
            if None in parts:
                return None
            names.append((name, parts))
        elif isinstance(value, SX):
            return None  # an expression of this instance's own symbols
        else:
            names.append((name, type(value), value))  # 1 == True, but equations may tell them apart
    return tuple(names)


def _is_child(part: Model, owner: Model) -> bool:
    assert owner._binding is not None
    return any(part is child for child in owner._binding.children)


def rebased(component: Component) -> tuple[Component, Scope]:
    """Return a copy of a bound component, numbered from zero in a scope of its own."""
    binding = component._binding
    assert binding is not None
    scope = Scope(prefix=f"{binding.path}." if binding.path else "")
    for space in SPACES:
        first = binding.first[space]
        counted = len_of(component, space)
        setattr(scope, space, getattr(binding.scope, space)[first : first + counted])
    copy = _copy(component, scope, dict(binding.first))
    assert isinstance(copy, Component)
    return copy, scope


def len_of(model: Model, space: str) -> int:
    """Return how many quantities of a space a model and everything below it declare."""
    assert model._binding is not None
    own = sum(q.space == space for q in model._declarations.quantities.values())
    return own + sum(len_of(child, space) for child in model._binding.children)


def _copy(model: Model, scope: Scope, base: dict[str, int]) -> Model:
    old = model._binding
    assert old is not None
    copy = type(model).__new__(type(model))
    first = {space: old.first[space] - base[space] for space in SPACES}
    binding = Binding(scope, old.path, first, None, old.depth, complete=True)
    copies = {id(child): _copy(child, scope, base) for child in old.children}
    binding.children = list(copies.values())
    for child in binding.children:
        assert child._binding is not None
        child._binding.owner = copy
    for name, value in model.__dict__.items():
        if isinstance(value, Model):
            copy.__dict__[name] = copies.get(id(value), value)  # what is not its part stays what it is
        elif isinstance(value, list) and value and isinstance(value[0], Model):
            copy.__dict__[name] = [copies.get(id(item), item) for item in value]
        else:
            copy.__dict__[name] = value
    copy.__dict__["_binding"] = binding
    return copy
