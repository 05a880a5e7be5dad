"""The quantities that a component declares: parameters, variables, potentials, flows, signals, discrete variables."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, cast, overload

from casadi import SX

from arthur_acausal.declare.authored import calling_line
from arthur_acausal.errors import DeclarationError
from arthur_acausal.units import parse_unit

if TYPE_CHECKING:
    from pint.facets.plain import PlainQuantity

Kind: TypeAlias = Literal["parameter", "variable", "potential", "flow", "input", "output", "discrete"]
StateSelect: TypeAlias = Literal["never", "avoid", "default", "prefer", "always"]
Scalar: TypeAlias = "float | SX | PlainQuantity[Any] | str"  # pint makes its Quantity a subclass of this one
Deferred: TypeAlias = Callable[[Any], "float | SX"]


@dataclass(frozen=True, slots=True)
class Start:
    """A start value given by a modification: ``value`` in SI, and whether it is ``fixed`` (None: as declared)."""

    value: Scalar | Deferred | None
    fixed: bool | None = None
    nominal: float | None = None


Value: TypeAlias = "Scalar | Deferred | Start | Real"


def start(
    value: Scalar | Deferred | None = None, *, fixed: bool | None = None, nominal: float | None = None
) -> Start:
    """Modify a variable's start value [SI, or a quantity with a unit], ``fixed`` attribute or nominal."""
    return Start(value, fixed, nominal)


@dataclass(slots=True, eq=False)
class Quantity:
    """What is declared of one quantity.

    ``unit`` is coherent SI in pint's syntax; ``display`` names the unit that people read. ``default`` belongs to
    parameters and signals, ``start``, ``fixed``, ``nominal`` and ``state_select`` to variables.
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

    def __post_init__(self) -> None:
        if not parse_unit(self.unit).coherent:
            raise DeclarationError(
                f"the unit {self.unit!r} is not coherent SI",
                where=calling_line(),
                remedy=f"declare the quantity in SI units and give display={self.unit!r}",
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


def parameter(
    unit: str,
    *,
    default: Scalar | Deferred = _REQUIRED,
    min: float | None = None,
    max: float | None = None,
    display: str | None = None,
    description: str = "",
) -> Any:
    """Declare a parameter [``unit``]: constant in time, may change between runs without a new translation.

    Without ``default`` the caller must give it. ``default`` may be a function of the component, for a parameter
    that depends on others: ``default=lambda self: 0.75 * self.area_a``.
    """
    return Real(
        "parameter", unit, default=default, min=min, max=max, display=display, description=description
    )


def variable(
    unit: str,
    *,
    start: Scalar | Deferred | None = None,
    fixed: bool = False,
    nominal: float | None = None,
    min: float | None = None,
    max: float | None = None,
    state_select: StateSelect = "default",
    display: str | None = None,
    description: str = "",
) -> Real:
    """Declare a continuous variable [``unit``], an unknown of the equations."""
    return Real("variable", unit, None, start, fixed, nominal, min, max, state_select, display, description)


def potential(
    unit: str,
    *,
    start: Scalar | Deferred | None = None,
    nominal: float | None = None,
    min: float | None = None,
    max: float | None = None,
    display: str | None = None,
    description: str = "",
) -> Real:
    """Declare a connector's potential [``unit``]: equal in all connectors of a connection set."""
    return Real(
        "potential",
        unit,
        start=start,
        nominal=nominal,
        min=min,
        max=max,
        display=display,
        description=description,
    )


def flow(
    unit: str, *, nominal: float | None = None, display: str | None = None, description: str = ""
) -> Real:
    """Declare a connector's flow [``unit``], positive into the component: the sum over a connection set is zero."""
    return Real("flow", unit, nominal=nominal, display=display, description=description)


def real_input(
    unit: str,
    *,
    default: Scalar | Deferred | None = None,
    nominal: float | None = None,
    min: float | None = None,
    max: float | None = None,
    display: str | None = None,
    description: str = "",
) -> Real:
    """Declare a signal [``unit``] that comes from outside: by ``connect``, or as an external input of the run."""
    return Real(
        "input", unit, default, nominal=nominal, min=min, max=max, display=display, description=description
    )


def real_output(
    unit: str, *, nominal: float | None = None, display: str | None = None, description: str = ""
) -> Real:
    """Declare a signal [``unit``] that this component computes for others."""
    return Real("output", unit, nominal=nominal, display=display, description=description)


def discrete(
    unit: str = "1", *, start: Scalar | Deferred = 0.0, display: str | None = None, description: str = ""
) -> Real:
    """Declare a discrete variable [``unit``]: constant between events, changed by ``when``."""
    return Real("discrete", unit, start=start, fixed=True, display=display, description=description)
