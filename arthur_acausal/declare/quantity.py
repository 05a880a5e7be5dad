"""The quantities that a component declares: parameters, variables, potentials, flows, signals, discrete variables."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, cast, overload

from casadi import SX

from arthur_acausal.declare.authored import calling_line
from arthur_acausal.errors import DeclarationError
from arthur_acausal.units import parse_unit

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from pint.facets.plain import PlainQuantity

Kind: TypeAlias = Literal["parameter", "variable", "potential", "flow", "input", "output", "discrete"]
StateSelect: TypeAlias = Literal["never", "avoid", "default", "prefer", "always"]
Scalar: TypeAlias = "float | SX | PlainQuantity[Any] | str"  # pint makes its Quantity a subclass of this one
Deferred: TypeAlias = Callable[[Any], "float | SX | Sequence[float | SX]"]
Given: TypeAlias = (
    "Scalar | Deferred | Sequence[Scalar] | NDArray[np.float64]"  # a sequence: of a vector's elements
)
Numbers: TypeAlias = "float | Sequence[float]"
Shape: TypeAlias = "int | Callable[[Any], int]"


@dataclass(frozen=True, slots=True)
class Start:
    """A start value given by a modification: ``value`` in SI, and whether it is ``fixed`` (None: as declared)."""

    value: Scalar | Deferred | None
    fixed: bool | None = None
    nominal: float | None = None


Value: TypeAlias = "Given | Start | Real"


def start(value: Given | None = None, *, fixed: bool | None = None, nominal: Numbers | None = None) -> Start:
    """Modify a variable's start value [SI, or a quantity with a unit], ``fixed`` attribute or nominal."""
    return Start(cast(Any, value), fixed, cast(Any, nominal))


@dataclass(slots=True, eq=False)
class Quantity:
    """What is declared of one quantity.

    ``unit`` is coherent SI in pint's syntax; ``display`` names the unit that people read. ``default`` belongs to
    parameters and signals, ``start``, ``fixed``, ``nominal`` and ``state_select`` to variables. ``shape``: of a vector,
    the number of elements or a function of the instance; these may then have values of their own.
    """

    kind: Kind
    unit: str
    default: Scalar | Deferred | None = None
    start: Scalar | Deferred | None = None
    fixed: bool = False
    nominal: float | None = None
    min: float | None = None
    max: float | None = None
    state_select: StateSelect = "default"
    display: str | None = None
    description: str = ""
    name: str = ""
    shape: Shape | None = None

    def __post_init__(self) -> None:
        if not parse_unit(self.unit).coherent:
            raise DeclarationError(
                f"the unit {self.unit!r} is not coherent SI",
                where=calling_line(),
                remedy=f"declare the quantity in SI units and give display={self.unit!r}",
            )
        if self.shape is not None:
            return  # the elements are checked
        several = [a for a in ("default", "start", "nominal", "min", "max") if _is_several(getattr(self, a))]
        if several:
            raise DeclarationError(
                f"{several[0]} has several values, but the quantity is one number",
                where=calling_line(),
                remedy="declare a vector with shape=..., or give one value",
            )
        if self.nominal is not None and not self.nominal > 0.0:
            raise DeclarationError(
                f"nominal must be positive, not {self.nominal}",
                where=calling_line(),
                remedy="give the quantity's typical magnitude in SI",
            )

    @property
    def space(self) -> Literal["variable", "parameter", "discrete"]:
        """The numbering that this quantity belongs to: all continuous unknowns share one."""
        if self.kind == "parameter" or self.kind == "discrete":
            return self.kind
        return "variable"


def _is_several(value: Any) -> bool:
    return isinstance(value, list | tuple) or getattr(value, "ndim", 0) > 0


class Real(Quantity):
    """One declared quantity: the declaration on the class, a CasADi symbol on an instance.

    Only components, connectors and records have attributes of this type: everywhere else a declaration is a
    ``Quantity``, for which type checkers know no symbol.
    """

    __slots__ = ()

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    @overload
    def __get__(self, instance: None, owner: type) -> Real: ...
    @overload
    def __get__(self, instance: object, owner: type) -> SX: ...
    def __get__(self, instance: Any, owner: type) -> Real | SX:
        if instance is None:
            return self
        return cast(SX, instance._symbol(self))

    def __set__(self, instance: object, value: Value) -> None:
        raise DeclarationError(
            f"{type(instance).__name__}.{self.name} cannot be assigned",
            remedy=f"yield {self.name} == ... in equations(), or give it where the component is made: "
            f"{type(instance).__name__}({self.name}=...)",
        )


_REQUIRED: Any = None


def _declared(
    kind: Kind, unit: str, shape: Shape | None, display: str | None, description: str, **attributes: Any
) -> Real:
    """Return a declaration; the attributes of a vector may be sequences, of which each element takes its own."""
    return Real(kind, unit, shape=shape, display=display, description=description, **attributes)


def parameter(
    unit: str,
    *,
    default: Given = _REQUIRED,
    min: Numbers | None = None,
    max: Numbers | None = None,
    shape: Shape | None = None,
    display: str | None = None,
    description: str = "",
) -> Any:
    """Declare a parameter [``unit``]: constant in time, may change between runs without a new translation.

    Without ``default`` the caller must give it. ``default`` may be a function of the component, for a parameter
    that depends on others: ``default=lambda self: 0.75 * self.area_a``.

    This and all other declarations: with ``shape=n`` it is a vector of n, to which attributes are given as one value
    for all or as a sequence.
    """
    return _declared("parameter", unit, shape, display, description, default=default, min=min, max=max)


def variable(
    unit: str,
    *,
    start: Given | None = None,
    fixed: bool = False,
    nominal: Numbers | None = None,
    min: Numbers | None = None,
    max: Numbers | None = None,
    state_select: StateSelect = "default",
    shape: Shape | None = None,
    display: str | None = None,
    description: str = "",
) -> Real:
    """Declare a continuous variable [``unit``], an unknown of the equations."""
    return _declared(
        "variable",
        unit,
        shape,
        display,
        description,
        start=start,
        fixed=fixed,
        nominal=nominal,
        min=min,
        max=max,
        state_select=state_select,
    )


def potential(
    unit: str,
    *,
    start: Given | None = None,
    nominal: Numbers | None = None,
    min: Numbers | None = None,
    max: Numbers | None = None,
    shape: Shape | None = None,
    display: str | None = None,
    description: str = "",
) -> Real:
    """Declare a connector's potential [``unit``]: equal in all connectors of a connection set."""
    return _declared(
        "potential", unit, shape, display, description, start=start, nominal=nominal, min=min, max=max
    )


def flow(
    unit: str,
    *,
    nominal: Numbers | None = None,
    shape: Shape | None = None,
    display: str | None = None,
    description: str = "",
) -> Real:
    """Declare a connector's flow [``unit``], positive into the component: the sum over a connection set is zero."""
    return _declared("flow", unit, shape, display, description, nominal=nominal)


def real_input(
    unit: str,
    *,
    default: Given | None = None,
    nominal: Numbers | None = None,
    min: Numbers | None = None,
    max: Numbers | None = None,
    shape: Shape | None = None,
    display: str | None = None,
    description: str = "",
) -> Real:
    """Declare a signal [``unit``] that comes from outside: by ``connect``, or as an external input of the run."""
    return _declared(
        "input", unit, shape, display, description, default=default, nominal=nominal, min=min, max=max
    )


def real_output(
    unit: str,
    *,
    nominal: Numbers | None = None,
    shape: Shape | None = None,
    display: str | None = None,
    description: str = "",
) -> Real:
    """Declare a signal [``unit``] that this component computes for others."""
    return _declared("output", unit, shape, display, description, nominal=nominal)


def discrete(
    unit: str = "1",
    *,
    start: Given = 0.0,
    shape: Shape | None = None,
    display: str | None = None,
    description: str = "",
) -> Real:
    """Declare a discrete variable [``unit``]: constant between events, changed by ``when``."""
    return _declared("discrete", unit, shape, display, description, start=start, fixed=True)
