"""Units: the table against pint, symbol by symbol, exact factors against NIST SP 811, all kinds of value."""

from __future__ import annotations

import math
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pint
import pytest

from arthur_acausal.errors import UnitError
from arthur_acausal.units import (
    _OFFSET,
    _OTHER,
    _PREFIX,
    _PREFIXED,
    DIMENSIONLESS,
    Dimension,
    coherent_unit,
    divide,
    format_dimension,
    multiply,
    parse_unit,
    power,
    to_si,
)

PRESSURE: Dimension = (-1, 1, -2, 0, 0, 0, 0)
OURS = {"gpm": "gallon/minute", "lpm": "liter/minute", "rev": "turn", "Nm": "newton*meter", "°F": "degF"}
# without the millicandela, which pint takes for a product of other units
SYMBOLS = [p + s for s in _PREFIXED for p in ("", *_PREFIX) if p + s != "mcd"]
COMMON = [
    *("m^3/s", "kg/m^3", "Pa*s/m^3", "N*m/A", "V*s/rad", "m^2/A", "J/(kg*K)", "1", "rad", "rad/s", "rad/s^2"),
    *("kg*m^2", "N*m*s/rad", "m/s", "m/s^2", "1/s", "1/K", "N/m", "N*s/m", "m^2/s", "W/K", "K/W", "W/m^2/K"),
    *("Pa^0.5", "m^3/(s*Pa^(1/2))", "m**2", "kg^-1", "L/min", "cm^3/rev", "mm/s", "kPa", "mbar", "uF", "µm"),
    *("mH", "kHz", "km/h", "m/s/s", "J/kg/K", "W/(m^2*degC)", "(m/s)^2", "V/(rad/s)"),
    *("s^+2", "N·m", "m²", "m/s kg", "kg m/s^2"),
]


def in_pint(text: str) -> tuple[float, float, Dimension]:
    """Scale, offset and dimension by pint."""
    registry = pint.get_application_registry()  # type: ignore[no-untyped-call]
    for ours, theirs in OURS.items():
        text = text.replace(ours, theirs) if text == ours or ours == "rev" else text
    at_zero, at_one = (
        registry.Quantity(x, registry.parse_units(text)).to_base_units().magnitude for x in (0.0, 1.0)
    )
    exponents = registry.parse_units(text).dimensionality
    names = ("length", "mass", "time", "current", "temperature", "substance", "luminosity")
    dimension = tuple(Fraction(exponents.get(f"[{name}]", 0)).limit_denominator(100) for name in names)
    return at_one - at_zero, at_zero, dimension


@pytest.mark.parametrize("text", [*_OTHER, *_OFFSET, *SYMBOLS, *COMMON])
def test_table_and_grammar_agree_with_pint(text: str) -> None:
    unit = parse_unit(text)
    scale, offset, dimension = in_pint(text)
    assert unit.scale == pytest.approx(scale, rel=1e-12)
    assert unit.offset == pytest.approx(offset, rel=1e-12)
    assert unit.dimension == dimension


@pytest.mark.parametrize(
    ("text", "scale"),
    [
        ("bar", 1e5),
        ("L/min", 1e-3 / 60),
        ("gpm", 3.785411784e-3 / 60),  # NIST SP 811, B.8: US gallon
        ("psi", 6894.757293168361),
        ("rpm", math.pi / 30),
        ("deg", math.pi / 180),
        ("lbf", 4.4482216152605),
        ("kWh", 3.6e6),
        ("cSt", 1e-6),
        ("10 bar", 1e6),
        ("1e-3*m", 1e-3),
        ("1/2*m", 0.5),
        ("mcd", 1e-3),
        ("m/s kg", 1.0),
        ("2*(cm)^2", 2e-4),
    ],
)
def test_scales_are_rounded_correctly(text: str, scale: float) -> None:
    assert parse_unit(text).scale == pytest.approx(scale, rel=3e-16, abs=0)


@pytest.mark.parametrize(
    ("value", "unit", "expected"),
    [
        ("150bar", "Pa", 150e5),
        (" 150 bar ", "Pa", 150e5),
        ("2.5 L/min", "m^3/s", 2.5e-3 / 60),
        ("90deg", "rad", math.pi / 2),
        ("90 °", "1", math.pi / 2),
        ("1.25gpm", "m^3/s", 1.25 * 3.785411784e-3 / 60),
        ("5000rpm", "rad/s", 5000 * math.pi / 30),
        ("20degC", "K", 293.15),
        ("-40 degF", "K", 233.15),
        ("1e3", "Pa", 1000.0),
        ("5e", "C", 5 * 1.602176634e-19),
        ("1_000 Pa", "Pa", 1000.0),
        (".5*m", "m", 0.5),
        ("5 %", "1", 0.05),
        ("inf", "Pa", math.inf),
        ("-inf bar", "Pa", -math.inf),
        (math.inf, "Pa", math.inf),
        (3, "Pa", 3.0),
        (2.0, "bar", 2e5),
        (np.float32(0.5), "m", 0.5),
        (np.int64(4), "m", 4.0),
        (np.array(2.0), "m", 2.0),
        (Fraction(1, 2), "m", 0.5),
    ],
)
def test_values_of_every_kind(value: object, unit: str, expected: float) -> None:
    assert to_si(value, unit) == pytest.approx(expected, rel=1e-15)


def test_pint_quantities_of_any_registry() -> None:
    registry: Any
    for registry in (pint.UnitRegistry(), pint.UnitRegistry(system="cgs")):
        assert to_si(registry.Quantity(150, "bar"), "Pa") == pytest.approx(150e5)
        assert to_si(registry.Quantity(20.0, "degC"), "K") == pytest.approx(293.15)
        assert to_si(registry.Quantity(180.0, "degree"), "1") == pytest.approx(math.pi)
        with pytest.raises(UnitError, match="mass, kg"):
            to_si(registry.Quantity(1.0, "kg"), "Pa")


def test_unusual_units_come_from_pint() -> None:
    assert parse_unit("meter per second").dimension == (1, 0, -1, 0, 0, 0, 0)
    assert parse_unit("millimeter_Hg").scale == pytest.approx(133.322387415)
    assert to_si("1 furlong", "m") == pytest.approx(201.168, rel=1e-5)


@pytest.mark.parametrize("text", ["dB", "decibel", "pixel", "dot/m"])
def test_units_without_an_si_dimension_are_refused(text: str) -> None:
    with pytest.raises(UnitError, match=r"outside SI|not proportional"):
        parse_unit(text)


@pytest.mark.parametrize(
    "text",
    ["", "m/", "(m", "m)", "m^", "m^x", "m^(1/)", "*m", "m?", "m^99", "1e999*m", "0*m", "Pm^20*Pm^20",
     "m" * 300, "__import__('os')", "m+s", "(" * 5000],
)  # fmt: skip
def test_nonsense_is_refused(text: str) -> None:
    with pytest.raises(UnitError):
        parse_unit(text)


def test_unknown_unit_names_the_nearest() -> None:
    with pytest.raises(UnitError, match=r"did you mean .*MPa") as caught:
        to_si("3 Mpa", "Pa", "jack.supply.p")
    assert caught.value.path == "jack.supply.p"
    assert "'Mpa' is not known" in str(caught.value)


def test_wrong_dimension_names_both() -> None:
    with pytest.raises(UnitError) as caught:
        to_si("3 bar", "m^3/s", "pump.q")
    message = str(caught.value)
    assert "kg m^-1 s^-2 (pressure, Pa)" in message
    assert "m^3 s^-1 (volume flow, m^3/s)" in message
    assert message.startswith("pump.q: ")


@pytest.mark.parametrize(
    "value", [math.nan, "many", "", "bar", None, [1.0, 2.0], "nan", 1j, 10**400, object()]
)
def test_what_is_no_number_is_refused(value: object) -> None:
    with pytest.raises(UnitError, match=r"^tank\.p: "):
        to_si(value, "Pa", "tank.p")


def test_declared_units_are_coherent() -> None:
    assert coherent_unit("kg/m^3").coherent
    assert coherent_unit("V*s/rad").coherent
    for text in ("bar", "degC", "mm", "percent"):
        with pytest.raises(UnitError, match="not a coherent SI unit"):
            coherent_unit(text, "tank.p")


def test_there_and_back() -> None:
    unit = parse_unit("degC")
    assert unit.from_si(unit.to_si(20.0)) == pytest.approx(20.0)
    assert parse_unit("bar").from_si(np.array([1e5, 2e5])) == pytest.approx([1.0, 2.0])


def test_arithmetic_of_dimensions() -> None:
    metre: Dimension = (1, 0, 0, 0, 0, 0, 0)
    assert multiply(metre, metre) == power(metre, 2) == (2, 0, 0, 0, 0, 0, 0)
    assert divide(metre, metre) == DIMENSIONLESS
    root = power(PRESSURE, Fraction(1, 2))
    assert root == (Fraction(-1, 2), Fraction(1, 2), -1, 0, 0, 0, 0)
    assert multiply(root, root) == PRESSURE
    assert all(type(x) is int for x in multiply(root, root))


@pytest.mark.parametrize(
    ("unit", "text"),
    [
        ("Pa", "kg m^-1 s^-2 (pressure, Pa)"),
        ("1", "1 (dimensionless)"),
        ("rad", "1 (dimensionless)"),
        ("m^3/s/Pa^0.5", "kg^(-1/2) m^(7/2)"),
        ("rad/s", "s^-1 (frequency or angular velocity, 1/s)"),
    ],
)
def test_dimensions_for_people(unit: str, text: str) -> None:
    assert format_dimension(parse_unit(unit).dimension) == text


def test_common_units_do_without_pint() -> None:
    code = f"import sys\nfrom arthur_acausal.units import parse_unit\nfor t in {COMMON}: parse_unit(t)\n"
    code += "assert 'pint' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True, cwd=Path(__file__).parents[1])
