"""What blocks share: signals whose unit is chosen."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any, ClassVar, TypeVar, cast

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
        return cast("type[B]", _with_units(cls, y, u or y))


@cache
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
