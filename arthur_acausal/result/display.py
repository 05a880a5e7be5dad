"""Units and numbers as people read them: bar and L/min in pictures and tables, SI everywhere else."""

from __future__ import annotations

import math
import re

from arthur_acausal.units import Unit, parse_unit

# What people read for an SI unit whose variable names no display unit: the first unit in which the largest
# magnitude is at least 1, else the last.
CUSTOMARY = {
    "Pa": ("bar",),
    "m^3/s": ("L/min",),
    "m^3": ("L", "mL"),
    "m": ("km", "m", "mm", "um"),
    "m/s": ("m/s", "mm/s"),
    "kg": ("kg", "g"),
    "N": ("kN", "N"),
    "W": ("kW", "W"),
    "J": ("kJ", "J"),
    "V": ("V", "mV"),
    "A": ("A", "mA"),
    "s": ("s", "ms", "us"),
}

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def display_unit(unit: str, display: str = "", magnitude: float = math.nan) -> Unit:
    """The unit in which to show values of a variable.

    Parameters
    ----------
    unit : SI unit of the values.
    display : the unit that the variable itself names, if any.
    magnitude : largest absolute value, SI; not a number or zero: the SI unit itself where that is customary.
    """
    choices = CUSTOMARY.get(unit, (unit,))
    if display or not math.isfinite(magnitude) or magnitude == 0.0:
        return parse_unit(display or (unit if unit in choices else choices[0]))
    units = [parse_unit(choice) for choice in choices]
    return next((u for u in units if magnitude >= u.scale), units[-1])


def pretty_unit(text: str) -> str:
    """A unit for people: m³/s, N·m, µm, °C; an empty text for 1."""
    if text in ("1", ""):
        return ""
    text = re.sub(r"(\^|\*\*)(-?\d+)", lambda match: match[2].translate(SUPERSCRIPTS), text)
    text = re.sub(r"\bdeg(?=[CF]\b)", "°", text)
    return re.sub(r"\bu(?=[a-zA-Z])", "µ", text.replace("*", "·"))


def labelled(name: str, unit: str) -> str:
    """An axis label: the name, with the unit in brackets where there is one."""
    return f"{name} [{pretty_unit(unit)}]" if pretty_unit(unit) else name
