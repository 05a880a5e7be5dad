"""What the solver needs of a compiled model: F(t, y, y', p, u, z, pre(z), m) = 0 and what belongs to it.

n is the number of unknowns y: the states (they have a derivative) and the algebraic variables that stay.
z are the discrete variables, m the truth values of the relations that make events, frozen during integration.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.int32]
Kernel = Callable[[], FloatArray]


class Relation(Protocol):
    """One relation g > 0 or g >= 0 that makes events."""

    @property
    def label(self) -> str: ...
    @property
    def where(self) -> str: ...
    @property
    def path(self) -> str: ...
    @property
    def inclusive(self) -> bool:
        """True: holds at g == 0 too."""
        ...

    @property
    def time_only(self) -> bool:
        """True: g depends on t, p, z only and is affine in t, so that its next event is known in advance."""
        ...


class WhenClause(Protocol):
    """One `when`; its condition is a Boolean function of the relations and the discrete variables."""

    @property
    def label(self) -> str: ...
    @property
    def where(self) -> str: ...
    @property
    def path(self) -> str: ...
    @property
    def earlier(self) -> int:
        """How many clauses before it are branches of the same `when`; one of them acting keeps it from acting."""
        ...

    @property
    def initial(self) -> bool:
        """Whether its condition names initial(): then it acts at the start, too, where it holds."""
        ...


class SampledBlock(Protocol):
    """A function that is called periodically."""

    @property
    def label(self) -> str: ...
    @property
    def where(self) -> str: ...
    @property
    def function(self) -> Callable[..., Any]: ...
    @property
    def first(self) -> int:
        """Number of its first input among the sample inputs of all blocks."""
        ...

    @property
    def count(self) -> int: ...
    @property
    def outputs(self) -> Sequence[int]:
        """The discrete variables that it sets, as indices into z."""
        ...

    @property
    def begins(self) -> Sequence[int]:
        """With a first-order hold: where z holds the beginnings of ramps, the outputs their slopes; else empty."""
        ...

    @property
    def since(self) -> int:
        """Where z holds the time when the ramps began, s."""
        ...

    @property
    def trigger(self) -> int:
        """Number of the sample input that calls it when it changes; -1: none."""
        ...


class Assignment(Protocol):
    """What a `when` does, or a discrete equation that is always active."""

    @property
    def kind(self) -> str:
        """ "state" (reinit of y[index]), "discrete" (z[index] is set) or "terminate"."""
        ...

    @property
    def index(self) -> int: ...
    @property
    def when(self) -> int:
        """The number of its `when` clause; -1: active at every event."""
        ...

    @property
    def message(self) -> str:
        """Of a "terminate": what to tell the user."""
        ...


class Attributes(Protocol):
    """Numerical attributes of y, each of shape (n,), for one vector of parameters; z_start (nz,) of z."""

    @property
    def start(self) -> FloatArray: ...
    @property
    def fixed(self) -> BoolArray: ...
    @property
    def start_given(self) -> BoolArray: ...
    @property
    def origin(self) -> Sequence[str]:
        """Where each start value comes from, behind a space in brackets; for messages."""
        ...

    @property
    def nominal(self) -> FloatArray: ...
    @property
    def min(self) -> FloatArray: ...
    @property
    def max(self) -> FloatArray: ...
    @property
    def z_start(self) -> FloatArray: ...


class Pattern(Protocol):
    """A sparsity pattern in compressed columns: rows of column j are row[colind[j]:colind[j + 1]]."""

    @property
    def colind(self) -> IntArray: ...
    @property
    def row(self) -> IntArray: ...


class External(Protocol):
    """The external functions of a model; kernels call them."""

    exact: bool  # whether derivatives are to be exact: else stale or approximate ones serve

    @property
    def count(self) -> int:
        """Evaluations so far."""
        ...

    @property
    def seconds(self) -> float:
        """Wall time in them and their derivatives, s."""
        ...

    def restart(self) -> None:
        """Take notice that an event has been handled."""
        ...

    def without_value(self) -> Sequence[str]:
        """The calls whose latest outputs are not all finite."""
        ...


class Evaluator(Protocol):
    """The kernels with their pinned arguments: write the arguments, call, read the (always same) result array."""

    @property
    def t(self) -> FloatArray: ...
    @property
    def y(self) -> FloatArray: ...
    @property
    def yp(self) -> FloatArray: ...
    @property
    def p(self) -> FloatArray: ...
    @property
    def u(self) -> FloatArray: ...
    @property
    def z(self) -> FloatArray: ...
    @property
    def zp(self) -> FloatArray: ...
    @property
    def m(self) -> FloatArray: ...
    @property
    def cj(self) -> FloatArray: ...

    @property
    def residual(self) -> Kernel: ...
    @property
    def jacobian(self) -> Kernel: ...
    @property
    def jacobian_y(self) -> Kernel: ...
    @property
    def jacobian_yp(self) -> Kernel: ...
    @property
    def roots(self) -> Kernel: ...
    @property
    def conditions(self) -> Kernel: ...
    @property
    def when_values(self) -> Kernel: ...
    @property
    def sample_inputs(self) -> Kernel: ...
    @property
    def sample_times(self) -> Kernel: ...
    @property
    def initial(self) -> Kernel: ...
    @property
    def initial_jacobian(self) -> Kernel: ...
    @property
    def external(self) -> External | None: ...

    def blamed(self, rows: Sequence[int]) -> Sequence[str]:
        """The equations, as they are written, that make these rows of F not finite at the arguments as they are."""
        ...


class DAE(Protocol):
    """A compiled model."""

    @property
    def name(self) -> str: ...
    @property
    def n(self) -> int: ...
    @property
    def y_paths(self) -> Sequence[str]: ...
    @property
    def differential(self) -> BoolArray: ...
    @property
    def row_labels(self) -> Sequence[str]: ...
    @property
    def u_paths(self) -> Sequence[str]: ...
    @property
    def u_default(self) -> FloatArray: ...
    @property
    def z_paths(self) -> Sequence[str]: ...
    @property
    def relations(self) -> Sequence[Relation]: ...
    @property
    def whens(self) -> Sequence[WhenClause]: ...
    @property
    def assignments(self) -> Sequence[Assignment]: ...
    @property
    def samples(self) -> Sequence[SampledBlock]: ...
    @property
    def sparsity(self) -> Pattern: ...
    @property
    def init_sparsity(self) -> Pattern: ...
    @property
    def n_init(self) -> int: ...
    @property
    def init_labels(self) -> Sequence[str]: ...
    @property
    def blends(self) -> bool:
        """Whether the last entry of p is the part of homotopy's actual expressions."""
        ...

    @property
    def starting(self) -> DAE | None:
        """The system that holds in place of this one while initial values are sought, where it is another.

        It has the same y, z and m; its p may have one entry more.
        """
        ...

    def parameter_vector(
        self, overrides: Mapping[str, Any] | None = None, start: Mapping[str, Any] | None = None
    ) -> FloatArray: ...
    def ignored_starts(self, start: Mapping[str, Any] | None = None) -> Sequence[str]:
        """Notes of the start values, of the model and of this run, that nothing uses."""
        ...

    def attributes(self, p: FloatArray) -> Attributes: ...
    def evaluator(self) -> Evaluator: ...
