"""What blocks share: signals whose unit is chosen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any, ClassVar, Self, TypeVar, cast

from arthur_acausal import Component, Real, real_input, real_output

B = TypeVar("B", bound="Block")


class Block(Component):
    """A block computes output signals from input signals.

    Blocks are declared without units. ``Block.of("A")`` is the same block with the output ``y`` in amperes;
    ``Block.of("A", "m")`` has the input ``u`` in metres as well (by default it has the unit of ``y``).
    ``_units`` says how the units of the quantities follow from ``{y}`` and ``{u}``.
    """

    _units: ClassVar[dict[str, str]] = {}

    @classmethod
    def of(cls: type[B], y: str, u: str = "") -> type[B]:
        """Return this block with its output in the unit ``y``, its input in ``u`` (where given) or ``y``."""
        key = (cls, y, u or y)
        if key not in _MADE:
            _MADE[key] = _with_units(*key)
        return cast("type[B]", _MADE[key])


_MADE: dict[tuple[type[Block], str, str], type[Block]] = {}
"""The classes made by ``of``: one for each choice of units, so that each is checked once."""


def _with_units(block: type[Block], y: str, u: str) -> type[Block]:
    body: dict[str, Any] = {"__doc__": block.__doc__, "__module__": block.__module__}
    for name, pattern in block._units.items():
        unit = pattern.format(y=y, u=u)
        body[name] = replace(getattr(block, name), unit=unit)
    return type(f"{block.__name__}[{y}]" if u == y else f"{block.__name__}[{y}, {u}]", (block,), body)


class Source(Block):
    """A block with one output ``y`` and no input."""

    _units = {"y": "{y}"}
    y: Real = real_output("1")


class SISO(Block):
    """A block with one input ``u`` and one output ``y``."""

    _units = {"u": "{u}", "y": "{y}"}
    u: Real = real_input("1")
    y: Real = real_output("1")


class SizedBlock(Block):
    """A block with as many signals or states as its structural parameters say.

    An instance is one of a subclass that declares them: ``_members`` says which, from what the caller gave.
    """

    _is_sized: ClassVar[bool] = False

    def __new__(cls, **modifications: Any) -> Self:
        """Return an instance of the class with as many members."""
        sized = cls if cls._is_sized else _sized(cast("Any", cls), tuple(cls._members(modifications).items()))
        return cast("Self", object.__new__(sized))

    @classmethod
    def _members(cls, given: Mapping[str, Any]) -> dict[str, Real]:
        """Return the quantities that an instance with these modifications has in addition."""
        raise NotImplementedError


@cache
def _sized(block: type[SizedBlock], members: tuple[tuple[str, Real], ...]) -> type[SizedBlock]:
    body: dict[str, Any] = {"__doc__": block.__doc__, "__module__": block.__module__, "_is_sized": True}
    body |= {name: replace(real) for name, real in members}
    return cast("type[SizedBlock]", type(f"{block.__name__}({len(members)})", (block,), body))
