"""Names and units as Modelica writes them."""

from __future__ import annotations

import re

IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z_0-9]*")
KEYWORDS = frozenset(
    [
        "algorithm",
        "and",
        "annotation",
        "block",
        "break",
        "class",
        "connect",
        "connector",
        "constant",
        "constrainedby",
        "der",
        "discrete",
        "each",
        "else",
        "elseif",
        "elsewhen",
        "encapsulated",
        "end",
        "enumeration",
        "equation",
        "expandable",
        "extends",
        "external",
        "false",
        "final",
        "flow",
        "for",
        "function",
        "if",
        "import",
        "impure",
        "in",
        "initial",
        "inner",
        "input",
        "loop",
        "model",
        "not",
        "operator",
        "or",
        "outer",
        "output",
        "package",
        "parameter",
        "partial",
        "protected",
        "public",
        "pure",
        "record",
        "redeclare",
        "replaceable",
        "return",
        "stream",
        "then",
        "true",
        "type",
        "when",
        "while",
        "within",
        "time",
    ]
)
_FACTOR = re.compile(r"([A-Za-zΩ°µ%]+)(?:(?:\^|\*\*)(-?\d+))?|1")
SPELLING = {"ohm": "Ohm", "degree": "deg", "degC": "degC", "percent": "%"}


def identifier(path: str) -> str:
    """Return a path as an identifier: itself where it is one, else in quotes, other letters by their code."""
    if IDENTIFIER.fullmatch(path) and path not in KEYWORDS:
        return path
    plain = "".join(c if " " <= c <= "~" and c not in "'\\" else f"_u{ord(c):04X}" for c in path)
    return f"'{plain}'"


def model_name(name: str) -> str:
    """Return a plain identifier for a model: ``examples.jack`` becomes ``examples_jack``."""
    plain = re.sub(r"\W", "_", name, flags=re.ASCII) or "Model"
    return plain if IDENTIFIER.fullmatch(plain) and plain not in KEYWORDS else f"M_{plain}"


def text(value: str) -> str:
    """Return a Modelica string."""
    return '"' + value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ") + '"'


def unit(pint: str) -> str:
    """Return a unit in Modelica's syntax, "W/(m2.K)" for "W/(m^2*K)"; "" where it has no form there."""
    above: list[str] = []
    below: list[str] = []
    for sign, factor in _factors(pint):
        match = _FACTOR.fullmatch(factor)
        if match is None:
            return ""
        if match[1] is None:
            continue
        power = sign * int(match[2] or 1)
        symbol = SPELLING.get(match[1], match[1])
        (above if power > 0 else below).append(symbol + (str(abs(power)) if abs(power) != 1 else ""))
    over = ".".join(above) or "1"
    if not below:
        return over
    return f"{over}/{below[0]}" if len(below) == 1 else f"{over}/({'.'.join(below)})"


def _factors(pint: str) -> list[tuple[int, str]]:
    """Return the factors of a unit with +1 or -1 for above or below the line; brackets nest."""
    found: list[tuple[int, str]] = []
    signs, sign, start = [1], 1, ""
    for c in pint.replace(" ", "").replace("**", "^") + "*":
        if c in "*/()":
            if start:
                found.append((signs[-1] * sign, start))
                start = ""
            if c == "(":
                signs.append(signs[-1] * sign)
                sign = 1
            elif c == ")" and len(signs) > 1:
                signs.pop()
                sign = 1
            elif c in "*/":
                sign = -1 if c == "/" else 1
        else:
            start += c
    return found
