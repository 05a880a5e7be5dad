"""Modifications: from what the caller wrote to the value, start and fixed attribute of a declared quantity."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from casadi import SX

from arthur_acausal.declare.authored import authored
from arthur_acausal.declare.model import MISSING, Binding, Model
from arthur_acausal.declare.quantity import Quantity, Start
from arthur_acausal.declare.scope import Declared, Later, Scope
from arthur_acausal.errors import ArthurError, DeclarationError, ParameterError
from arthur_acausal.units import to_si


def declared(bound: Model, path: str, quantity: Quantity, modification: Any) -> Declared:
    """Return the entry of one quantity of ``bound``, its modification (or MISSING) taken in."""
    binding = bound._binding
    assert binding is not None
    if quantity.kind in ("parameter", "input"):
        return _valued(bound, binding, path, quantity, modification)
    entry = Declared(path, quantity, depth=binding.depth + 1, where=bound._where)
    if modification is MISSING:
        if quantity.start is not None or quantity.fixed:
            entry.start = Start(_resolved(quantity.start, entry, bound, bound), quantity.fixed)
        return entry
    given = modification if isinstance(modification, Start) else Start(modification)
    first = given.value if given.value is not None else quantity.start
    source = binding.owner if given.value is not None else bound
    fixed = quantity.fixed if given.fixed is None else given.fixed
    entry.depth = binding.depth
    entry.start = Start(_resolved(first, entry, bound, source), fixed, given.nominal)
    return entry


def _valued(bound: Model, binding: Binding, path: str, quantity: Quantity, modification: Any) -> Declared:
    entry = Declared(path, quantity, depth=binding.depth, where=bound._where)
    if modification is MISSING:
        if quantity.default is None and quantity.kind == "parameter":
            raise ParameterError(
                f"{type(bound).__name__} needs the parameter {quantity.name} [{quantity.unit}]",
                path=path,
                where=bound._where,
                remedy=f"give it: {type(bound).__name__}({quantity.name}=...)",
            )
        entry.depth = binding.depth + 1
        entry.value = _resolved(quantity.default, entry, bound, bound)
        return entry
    if isinstance(modification, Start):
        raise ParameterError(
            f"a{'n' if quantity.kind == 'input' else ''} {quantity.kind} takes a value, not start(...)",
            path=path,
            where=bound._where,
            remedy=f"write {type(bound).__name__}({quantity.name}=value)",
        )
    entry.value = _resolved(modification, entry, bound, binding.owner)
    return entry


def _resolved(value: Any, entry: Declared, bound: Model, source: Model | None) -> Any:
    """Return a float in SI or an SX of parameters; None for now if it is a function of ``source``."""
    if not callable(value) or hasattr(value, "dimensionality") or isinstance(value, SX):
        return _plain(value, entry)
    if source is None:
        raise DeclarationError(
            "a function has no owner here that it could be called with",
            path=entry.path,
            where=bound._where,
            remedy="give a number, or let another component own this one",
        )
    assert bound._binding is not None
    bound._binding.scope.later.append(Later(entry, value, bound, source))
    return None


def settle(scope: Scope) -> None:
    """Call the functions that values were given as, now that all parts that they may use are there."""
    for entry, function, bound, source in scope.later:
        with authored(f"the function for {entry.quantity.name}", entry.path, bound._where):
            value = _plain(function(source), entry)
        if entry.quantity.kind in ("parameter", "input"):
            entry.value = value
        else:
            assert entry.start is not None
            entry.start = replace(entry.start, value=value)
    scope.later.clear()


def _plain(value: Any, entry: Declared) -> Any:
    """Return a value as a float in SI, within its bounds, or as an SX of parameters; None: no start value."""
    if isinstance(value, SX) or (value is None and entry.quantity.kind != "parameter"):
        return value
    try:
        number = to_si(value, entry.quantity.unit, path=entry.path)
    except ArthurError as error:
        error.where = error.where or entry.where
        raise
    if entry.quantity.kind == "parameter":
        _check_bounds(number, entry)
    return number


def _check_bounds(value: float, entry: Declared) -> None:
    quantity = entry.quantity
    low = -math.inf if quantity.min is None else quantity.min
    high = math.inf if quantity.max is None else quantity.max
    if not low <= value <= high:
        raise ParameterError(
            f"{value:g} {quantity.unit} is outside of [{low:g}, {high:g}]",
            path=entry.path,
            where=entry.where,
            cause=f"it is: {quantity.description}" if quantity.description else "",
            remedy="choose a value within the bounds that the component declares",
        )
