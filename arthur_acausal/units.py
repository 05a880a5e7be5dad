"""Units of measurement: what a unit text means, and any value brought to SI.

A dimension is a tuple of seven exponents, of m, kg, s, A, K, mol and cd; angles and counts have none. Common
units are read by a small grammar over a table of symbols, in the syntax of pint; pint itself is imported only
for others and for values that are pint quantities. Values: The International System of Units (SI Brochure),
9th ed. (2019), and NIST Special Publication 811 (2008), appendix B, for customary units.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Any

from arthur_acausal.errors import UnitError, nearest

Exponent = int | Fraction
Dimension = tuple[Exponent, ...]

DIMENSIONLESS: Dimension = (0, 0, 0, 0, 0, 0, 0)
_BASE = {"m": 0, "kg": 1, "s": 2, "A": 3, "K": 4, "mol": 5, "cd": 6}
_PINT_BASE = ("length", "mass", "time", "current", "temperature", "substance", "luminosity")
_PINT_UNITS = ("meter", "kilogram", "second", "ampere", "kelvin", "mole", "candela")


def _table(text: str) -> dict[str, str]:
    """Return the definitions ``symbol = unit`` of a text, which stand a line or semicolon apart."""
    pairs = (entry.partition("=") for entry in text.strip().replace("\n", ";").split(";"))
    return {symbol.strip(): definition.strip() for symbol, _, definition in pairs}


_PREFIX = {"da": 1, "h": 2, "k": 3, "M": 6, "G": 9, "T": 12, "P": 15, "d": -1, "c": -2, "m": -3} | {
    "u": -6, "µ": -6, "μ": -6, "n": -9, "p": -12, "f": -15,
}  # fmt: skip

# Symbols that take a prefix; base units stand for themselves.
_PREFIXED = _table("""
    m = m; s = s; A = A; K = K; mol = mol; cd = cd; g = 0.001 kg; rad = 1; sr = 1
    Hz = 1/s; N = kg m/s^2; Pa = N/m^2; J = N m; W = J/s; C = A s; V = W/A; ohm = V/A; Ω = V/A; S = A/V
    F = C/V; Wb = V s; T = Wb/m^2; H = Wb/A; lm = cd; lx = lm/m^2
    L = 0.001 m^3; l = L; bar = 100000 Pa; eV = 1.602176634e-19 J; P = 0.1 Pa s; St = 0.0001 m^2/s
""")
_OTHER = _table("""
    min = 60 s; h = 3600 s; hr = h; hour = h; d = 86400 s; day = d; Wh = W h; kWh = kW h
    deg = pi rad/180; ° = deg; turn = 2 pi rad; rev = turn; rpm = turn/min; rps = turn/s
    dimensionless = 1; percent = 0.01; % = percent; ppm = 1e-6; g_0 = 9.80665 m/s^2; t = 1000 kg; kgf = kg g_0
    inch = 0.0254 m; in = inch; ft = 12 inch; lb = 0.45359237 kg; lbf = lb g_0; psi = lbf/inch^2
    hp = 550 ft lbf/s; gal = 231 inch^3; gpm = gal/min; lpm = L/min; cc = cm^3; atm = 101325 Pa; Nm = N m
    delta_degC = K; delta_degF = 5 K/9; hbar = 6.62607015e-34 J s/(2 pi)
""")
# Temperatures with a zero of their own: K = (value + offset) * scale.
_OFFSET = _table("degC = 273.15; °C = 273.15; degF = 459.67; °F = 459.67")

_MEANING = _table("""
    length = m; area = m^2; volume = m^3; time = s; velocity = m/s; acceleration = m/s^2; mass = kg
    mass flow = kg/s; moment of inertia = kg*m^2; density = kg/m^3; force = N; torque or energy = J; power = W
    pressure = Pa; volume flow = m^3/s; frequency or angular velocity = 1/s; angular acceleration = 1/s^2
    stiffness = N/m; damping = N*s/m; dynamic viscosity = Pa*s; kinematic viscosity = m^2/s; current = A
    charge = C; voltage = V; resistance = ohm; conductance = S; inductance = H; capacitance = F
    magnetic flux = Wb; temperature = K; heat capacity = J/K; specific heat capacity = J/(kg*K)
    thermal conductance = W/K; amount of substance = mol
""")


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit as it was written. A value v in it is ``v * scale + offset`` in the coherent SI unit."""

    dimension: Dimension
    scale: float
    offset: float
    text: str

    @property
    def coherent(self) -> bool:
        """Whether a number in this unit is its SI value."""
        return self.scale == 1.0 and self.offset == 0.0

    def to_si(self, value: float) -> float:
        """Return the SI value of a number in this unit."""
        return value * self.scale + self.offset

    def from_si(self, value: Any) -> Any:
        """Return an SI value (a number or an array) in this unit."""
        return (value - self.offset) / self.scale


def multiply(a: Dimension, b: Dimension) -> Dimension:
    """Return the dimension of a product."""
    return tuple(_whole(x + y) for x, y in zip(a, b, strict=True))


def divide(a: Dimension, b: Dimension) -> Dimension:
    """Return the dimension of a quotient."""
    return tuple(_whole(x - y) for x, y in zip(a, b, strict=True))


def power(a: Dimension, exponent: Exponent) -> Dimension:
    """Return the dimension of a power."""
    return tuple(_whole(x * exponent) for x in a)


def _whole(x: Exponent) -> Exponent:
    return x.numerator if x.denominator == 1 else x


def format_dimension(dimension: Dimension) -> str:
    """Return a dimension for people: ``kg m^-1 s^-2 (pressure, Pa)``."""
    if dimension == DIMENSIONLESS:
        return "1 (dimensionless)"
    order = sorted(_BASE, key=lambda name: (name != "kg", _BASE[name]))
    factors = [(name, dimension[_BASE[name]]) for name in order if dimension[_BASE[name]] != 0]
    text = " ".join(
        name if x == 1 else f"{name}^{x}" if x.denominator == 1 else f"{name}^({x})" for name, x in factors
    )
    known = _meanings().get(dimension)
    return f"{text} ({', '.join(known)})" if known else text


@cache
def _meanings() -> dict[Dimension, tuple[str, str]]:
    return {parse_unit(unit).dimension: (name, unit) for name, unit in _MEANING.items()}


@cache
def parse_unit(text: str) -> Unit:
    """Read a unit such as ``"kg/m^3"``, ``"L/min"``, ``"N*m/A"``, ``"J/(kg*K)"`` or ``"1"``.

    Raises
    ------
    UnitError
        When neither the table nor pint knows it.
    """
    text = text.strip()
    if text in _OFFSET:
        dimension, scale = _temperature_difference(text)
        return Unit(dimension, float(scale), float(scale * Fraction(_OFFSET[text])), text)
    try:
        dimension, scale = _Grammar(text).read()
        return Unit(dimension, float(scale), 0.0, text)
    except _UnknownSymbolError as error:
        unit = _parse_with_pint(text)
        if unit is None:
            raise error from None
        return unit


def coherent_unit(text: str, path: str = "") -> Unit:
    """Read the unit of a declared quantity, which must be coherent SI, so that its numbers are SI values."""
    unit = parse_unit(text)
    if not unit.coherent:
        raise UnitError(
            f"{text!r} is not a coherent SI unit",
            path=path,
            cause=f"one {text} is {unit.to_si(1.0):g} in {format_dimension(unit.dimension)}",
            remedy="declare the quantity in SI units; display= gives the unit that people see",
        )
    return unit


class _UnknownSymbolError(UnitError):
    """The grammar is satisfied so far, the table is not."""


Factor = tuple[Dimension, Fraction]  # a dimension and what one of the unit is in SI


class _Grammar:
    """A unit text read by recursive descent; all three operators of a product bind alike, from left to right.

    product = power {("*" | "/" | nothing) power};  power = (number | symbol | "(" product ")") ["^" exponent]
    exponent = [sign] number | "(" [sign] number ["/" number] ")";  "**" stands for "^" as well
    """

    _TOKEN = re.compile(r"\s*(\*\*|[*/^()+-]|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[°%]\w*|[^\W\d]\w*)")
    _PLAIN = str.maketrans({"·": "*", "×": "*", "²": "^2", "³": "^3"})

    def __init__(self, text: str) -> None:
        self.text = text
        plain = text.translate(self._PLAIN).rstrip()
        self.tokens: list[str] = []
        position = 0
        while position < len(plain):
            match = self._TOKEN.match(plain, position)
            if match is None or len(plain) > 200:
                raise self.error(f"not understood from {plain[position : position + 10].strip()!r} on")
            self.tokens.append(match[1])
            position = match.end()
        self.tokens = ["", *reversed(self.tokens)]  # the next one is last; "" is the end

    def error(self, cause: str) -> UnitError:
        return UnitError(f"unit {self.text!r}: {cause}")

    def take(self, *expected: str) -> str:
        """Take the next token if it is one of the expected ones, else return ""."""
        return self.tokens.pop() if self.tokens[-1] in expected and self.tokens[-1] else ""

    def read(self) -> Factor:
        try:
            dimension, scale = self.product()
            float(scale)
        except OverflowError:
            raise self.error("a factor is out of range") from None
        if self.tokens[-1]:
            raise self.error(f"unexpected {self.tokens[-1]!r}")
        return dimension, scale

    def product(self) -> Factor:
        dimension, scale = self.power()
        while self.tokens[-1] not in ("", ")", "^", "**", "+", "-"):
            if self.take("*", "/") == "/":
                other, factor = self.power()
                dimension, scale = divide(dimension, other), scale / factor
            else:
                other, factor = self.power()
                dimension, scale = multiply(dimension, other), scale * factor
        return dimension, scale

    def power(self) -> Factor:
        if self.take("("):
            dimension, scale = self.product()
            self.close()
        elif self.tokens[-1][:1].isalpha() or self.tokens[-1][:1] in ("°", "%"):
            dimension, scale = self.symbol(self.tokens.pop())
        else:
            dimension, scale = DIMENSIONLESS, self.number()
        if not self.take("^", "**"):
            return dimension, scale
        exponent = self.exponent()
        return power(dimension, exponent), _scale_power(scale, exponent)

    def symbol(self, name: str) -> Factor:
        if (known := _symbol(name)) is None:
            raise _UnknownSymbolError(
                f"unit {self.text!r}: {name!r} is not known", remedy=nearest(name, _known_symbols())
            )
        return known

    def number(self) -> Fraction:
        token = self.tokens[-1]
        if not re.match(r"[\d.]", token):
            raise self.error(f"unexpected {token!r}" if token else "it ends too early")
        if not 1e-300 < float(token) < 1e300:
            raise self.error(f"{token} is out of range")
        return Fraction(self.tokens.pop())

    def exponent(self) -> Exponent:
        closing = self.take("(")
        sign = -1 if self.take("+", "-") == "-" else 1
        exponent = sign * self.number()
        if closing:
            if self.take("/"):
                exponent /= self.number()
            self.close()
        if abs(exponent) > 20 or exponent.denominator > 1000:
            raise self.error(f"exponent {exponent} is out of range")
        return _whole(exponent)

    def close(self) -> None:
        if not self.take(")"):
            raise self.error("')' is missing")


def _scale_power(scale: Fraction, exponent: Exponent) -> Fraction:
    if scale == 1 or exponent.denominator == 1:
        return scale**exponent.numerator
    return Fraction(float(scale) ** float(exponent))


@cache
def _symbol(name: str) -> Factor | None:
    """Return what a symbol of the table means, with a prefix or without."""
    if name in _BASE:
        return tuple(int(i == _BASE[name]) for i in range(7)), Fraction(1)
    if name == "pi":
        return DIMENSIONLESS, Fraction(math.pi)
    definition = _PREFIXED.get(name) or _OTHER.get(name)
    if definition is not None:
        return _Grammar(definition).read()
    for prefix, exponent in _PREFIX.items():
        if name.startswith(prefix) and name[len(prefix) :] in _PREFIXED:
            dimension, scale = _Grammar(name[len(prefix) :]).read()
            return dimension, scale * Fraction(10) ** exponent
    return _temperature_difference(name) if name in _OFFSET else None


def _temperature_difference(name: str) -> Factor:
    """Return what a degree means within a product, where it is a difference."""
    return _Grammar("delta_degF" if name.endswith("F") else "K").read()


@cache
def _known_symbols() -> list[str]:
    return [*_OTHER, *_PREFIXED, *_OFFSET, *(p + s for s in _PREFIXED for p in _PREFIX)]


def _parse_with_pint(text: str) -> Unit | None:
    """Return a unit that pint knows, None where it does not."""
    import pint  # slow to import, and seldom needed

    registry: Any = pint.get_application_registry()  # type: ignore[no-untyped-call]
    try:
        unit = registry.parse_units(text)
        at = [_magnitude_in_si(registry.Quantity(float(x), unit)) for x in range(3)]
    except UnitError:
        raise
    except Exception:  # pint raises what its tokenizer, parser and converters raise: no common class
        return None
    if not math.isclose(at[2] - at[1], at[1] - at[0], rel_tol=1e-9):
        raise UnitError(f"unit {text!r} is not proportional to an SI unit")
    return Unit(_dimension_of(registry.Quantity(1.0, unit)), at[1] - at[0], at[0], text)


def _dimension_of(quantity: Any) -> Dimension:
    """Return the dimension of a pint quantity."""
    exponents: Mapping[str, float] = {key.strip("[]"): x for key, x in quantity.dimensionality.items()}
    if strange := exponents.keys() - set(_PINT_BASE):
        raise UnitError(f"unit {str(quantity.units)!r} has a dimension outside SI: {', '.join(strange)}")
    return tuple(_whole(Fraction(exponents.get(key, 0)).limit_denominator(1000)) for key in _PINT_BASE)


def _magnitude_in_si(quantity: Any) -> float:
    """Return the SI value of a pint quantity, whatever base units its registry prefers."""
    factors = (f"{unit}**({x})" for unit, x in zip(_PINT_UNITS, _dimension_of(quantity), strict=True) if x)
    return float(quantity.to("*".join(factors) or "dimensionless").magnitude)


_NUMBER = re.compile(
    r"\s*([+-]?(?:\d[\d_]*\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[+-]?inf\b)\s*\*?\s*(.*?)\s*$", re.DOTALL
)


def to_si(value: object, unit: str | Unit, path: str = "") -> float:
    """Return a value as a plain SI number for a quantity that is declared in ``unit``.

    A number is taken to be in ``unit``; a text such as ``"150 bar"``, ``"1.25gpm"`` or ``"90deg"`` and a pint
    quantity carry their own unit, a text without one is a number. Infinity is a value, NaN is not.

    Raises
    ------ UnitError When the dimension is not that of ``unit``, the unit is unknown, or there is no number.
        ``path`` is named.
    """
    declared = parse_unit(unit) if isinstance(unit, str) else unit
    try:
        if isinstance(value, str):
            result, dimension = _read(value, declared)
        elif hasattr(value, "magnitude") and hasattr(value, "dimensionality"):
            result, dimension = _magnitude_in_si(value), _dimension_of(value)
        else:
            result, dimension = declared.to_si(float(value)), declared.dimension  # type: ignore[arg-type]
    except UnitError as error:
        raise UnitError(error.message, path=path, cause=error.cause, remedy=error.remedy) from None
    except (TypeError, ValueError, OverflowError):
        raise UnitError(f"{value!r} is not a number in {declared.text}", path=path) from None
    if dimension != declared.dimension:
        raise UnitError(
            f"{str(value)!r} is in {format_dimension(dimension)}, but the quantity is in "
            f"{format_dimension(declared.dimension)}",
            path=path,
            remedy=f"give a value in {declared.text}",
        )
    if math.isnan(result):
        raise UnitError("the value is NaN", path=path)
    return result


def _read(text: str, declared: Unit) -> tuple[float, Dimension]:
    """Return the SI value and the dimension of a number with a unit, or without."""
    match = _NUMBER.match(text)
    if match is None:
        raise UnitError(f"{text!r} does not begin with a number")
    number = float(match[1])
    unit = parse_unit(match[2]) if match[2] else declared
    return unit.to_si(number), unit.dimension
