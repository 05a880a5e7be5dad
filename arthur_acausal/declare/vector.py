"""Vectors of quantities: one declaration, as many scalar quantities ``r[0]``, ``r[1]``, ... as its shape says.

Everything behind the declaration sees the scalars only; on an instance the vector is a column of their symbols.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any

import casadi as ca
import numpy as np
from casadi import SX

from arthur_acausal.declare.quantity import Real, Start
from arthur_acausal.errors import DeclarationError

# What each element has of its own, where it is given as a sequence.
_OF_ELEMENTS = ("default", "start", "nominal", "min", "max")


def elements(x: Any) -> list[SX]:
    """Return the scalars of a number, a symbol or a matrix, column by column."""
    return list(ca.vertsplit(ca.vec(ca.densify(SX(x))))) if not isinstance(x, SX) or x.numel() != 1 else [x]


def scalars(values: Iterable[Any]) -> tuple[SX, ...]:
    """Return the scalars of several numbers, symbols and columns, one after the other."""
    return tuple(element for value in values for element in elements(value))


def mapped(x: SX, function: Callable[[SX], SX]) -> SX:
    """Return a matrix of what a function makes of each element."""
    return ca.reshape(column([function(element) for element in elements(x)]), *x.shape)


def column(items: list[SX]) -> SX:
    """Return a column, which may be empty."""
    return ca.vertcat(*items) if items else SX(0, 1)


def expanded(declared: Mapping[str, Real], sizes: Mapping[str, int]) -> dict[str, Real]:
    """Return scalar quantities by name: those that were declared, and the elements of vectors of these sizes."""
    found: dict[str, Real] = {}
    for name, quantity in declared.items():
        if quantity.shape is None:
            found[name] = quantity
            continue
        for k in range(sizes[name]):
            own = {a: _part(getattr(quantity, a), k, sizes[name], name) for a in _OF_ELEMENTS}
            found[f"{name}[{k}]"] = replace(quantity, name=f"{name}[{k}]", shape=None, **own)
    return found


def size_of(quantity: Real, instance: Any) -> int:
    """Return the number of elements, where need be asked from the instance."""
    size = quantity.shape(instance) if callable(quantity.shape) else quantity.shape
    if isinstance(size, bool) or not isinstance(size, int) or size < 0:
        raise DeclarationError(
            f"the shape of {quantity.name} is {size!r}",
            remedy="give the number of elements, or a function of structural parameters: "
            "shape=lambda self: self.n",
        )
    return size


def split(modifications: Mapping[str, Any], sizes: Mapping[str, int]) -> dict[str, Any]:
    """Return the modifications with those of vectors by element."""
    found = dict(modifications)
    for name, size in sizes.items():
        if name in found:
            value = found.pop(name)
            found |= {f"{name}[{k}]": _part(value, k, size, name) for k in range(size)}
    return found


def constant(quantity: Real, instance: Any, value: Any) -> SX | None:
    """Return a vector of numbers that is no part of a model as a column; None where it is not of numbers."""
    size = size_of(quantity, instance)
    parts = [_part(value, k, size, quantity.name) for k in range(size)]
    return column([SX(p) for p in parts]) if all(isinstance(p, int | float) for p in parts) else None


def _part(value: Any, k: int, size: int, name: str) -> Any:
    """Return what of a value belongs to element k: one value for all, or one each."""
    if isinstance(value, Start):
        return Start(*(_part(x, k, size, name) for x in (value.value, value.fixed, value.nominal)))
    if _is_function(value):
        return lambda instance: _part(value(instance), k, size, name)
    count = _count(value)
    if count is None:
        return value
    if count != size:
        raise DeclarationError(
            f"{name} has {size} elements, but {count} values are given",
            remedy="give one value for all elements, or one for each",
        )
    elements: Any = value
    part = elements[k]
    return part.item() if isinstance(part, np.generic) else part


def _is_function(value: Any) -> bool:
    return callable(value) and not hasattr(value, "dimensionality") and not isinstance(value, SX)


def _count(value: Any) -> int | None:
    """Return the number of values; None for one that counts for all elements."""
    if isinstance(value, SX | ca.DM):
        return None if value.numel() == 1 else int(value.numel())
    value = getattr(value, "magnitude", value)
    return len(value) if isinstance(value, list | tuple | np.ndarray) and np.ndim(value) else None
