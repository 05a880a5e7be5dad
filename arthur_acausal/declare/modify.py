"""Modifications: from what the caller wrote to the value, start and fixed attribute of a declared quantity."""

from __future__ import annotations

from typing import Any

from casadi import SX

from arthur_acausal.declare.model import MISSING, Binding, Model
from arthur_acausal.declare.quantity import Real, Start
from arthur_acausal.declare.scope import Declared, using
from arthur_acausal.errors import ArthurError, DeclarationError, ParameterError
from arthur_acausal.units import to_si


def declared(bound: Model, path: str, quantity: Real, modification: Any) -> Declared:
    """Return the entry of one quantity of ``bound``, its modification (or MISSING) taken in."""
    binding = bound._binding
    assert binding is not None
    if quantity.kind in ("parameter", "input"):
        return _valued(bound, binding, path, quantity, modification)
    if modification is MISSING:
        begin = (
            Start(quantity.start, quantity.fixed) if quantity.start is not None or quantity.fixed else None
        )
        own = (
            None if begin is None else Start(_resolve(begin.value, quantity, path, bound, bound), begin.fixed)
        )
        return Declared(path, quantity, start=own, depth=binding.depth + 1)
    given = modification if isinstance(modification, Start) else Start(modification)
    first = given.value if given.value is not None else quantity.start
    source = binding.owner if given.value is not None else bound
    fixed = quantity.fixed if given.fixed is None else given.fixed
    value = Start(_resolve(first, quantity, path, bound, source), fixed, given.nominal)
    return Declared(path, quantity, start=value, depth=binding.depth)


def _valued(bound: Model, binding: Binding, path: str, quantity: Real, modification: Any) -> Declared:
    if modification is MISSING:
        if quantity.default is None and quantity.kind == "parameter":
            raise ParameterError(
                f"{type(bound).__name__} needs the parameter {quantity.name} [{quantity.unit}]",
                path=path,
                where=bound._where,
                remedy=f"give it: {type(bound).__name__}({quantity.name}=...)",
            )
        return Declared(
            path, quantity, _resolve(quantity.default, quantity, path, bound, bound), depth=binding.depth + 1
        )
    if isinstance(modification, Start):
        raise ParameterError(
            f"a {quantity.kind} takes a value, not start(...)", path=path, where=bound._where
        )
    return Declared(
        path, quantity, _resolve(modification, quantity, path, bound, binding.owner), depth=binding.depth
    )


def _resolve(value: Any, quantity: Real, path: str, bound: Model, source: Model | None) -> Any:
    """Return a float in SI or an SX of parameters; functions are called with ``source``, their component."""
    if value is None or isinstance(value, float):
        return value
    if isinstance(value, SX):
        return value
    if callable(value) and not hasattr(value, "dimensionality"):
        if source is None:
            raise DeclarationError(
                "a function needs an owner to be called with", path=path, where=bound._where
            )
        binding = bound._binding
        assert binding is not None
        with using(binding.scope):
            return _resolve(value(source), quantity, path, bound, None)
    try:
        return to_si(value, quantity.unit, path=path)
    except ArthurError as error:
        error.where = error.where or bound._where
        raise
