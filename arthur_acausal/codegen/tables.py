"""What a compiled model tells of its relations, events, start values and sparsity."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.int32]


@dataclass(frozen=True, slots=True)
class Relation:
    """A comparison that makes events: true where root function g > 0, or >= 0 if ``inclusive``; ``path``: whose."""

    label: str
    where: str
    inclusive: bool
    time_only: bool
    path: str = ""


@dataclass(frozen=True, slots=True)
class WhenClause:
    """One ``when``: carried out when its condition becomes true, unless one of the ``earlier`` clauses is, too.

    ``initial``: it acts at the start, too, where its condition, which names ``initial()``, holds.
    """

    label: str
    where: str
    earlier: int = 0
    initial: bool = False
    path: str = ""


@dataclass(frozen=True, slots=True)
class SampledBlock:
    """A function that is called periodically: with ``count`` sample inputs from ``first`` on; it sets z[outputs].

    ``begins``: with a first-order hold, where z holds the beginnings of the ramps, of which z[outputs] are the slopes;
    z[since] is when they began. ``trigger``: the sample input that calls it when it changes; -1: none.
    """

    label: str
    where: str
    function: Callable[..., Any]
    first: int
    count: int
    outputs: tuple[int, ...]
    begins: tuple[int, ...] = ()
    since: int = -1
    trigger: int = -1


@dataclass(frozen=True, slots=True)
class Assignment:
    """What an event changes: ``when`` is the clause's number, -1 for a discrete equation, which always holds."""

    kind: Literal["state", "discrete", "terminate"]
    index: int
    when: int
    message: str
    label: str


@dataclass(frozen=True, slots=True)
class Pattern:
    """A sparsity pattern in compressed columns: rows of column j are row[colind[j]:colind[j + 1]]."""

    colind: IntArray
    row: IntArray

    @property
    def nnz(self) -> int:
        """How many structural nonzeros there are."""
        return len(self.row)


@dataclass(frozen=True, slots=True)
class Attributes:
    """Attributes of y, each (n,), for one vector of parameters; ``z_start`` (nz,) of the discrete variables.

    ``origin``: where each start comes from, in brackets.
    """

    start: FloatArray
    fixed: BoolArray
    start_given: BoolArray
    nominal: FloatArray
    min: FloatArray
    max: FloatArray
    z_start: FloatArray
    origin: Sequence[str]


@dataclass(frozen=True, slots=True)
class StartEntry:
    """A start value kept behind the parameters in p: of y[index] (-1: of no y), times ``sign``."""

    path: str
    index: int
    sign: int
    fixed: bool
    unit: str
    place: int
    where: str = ""
