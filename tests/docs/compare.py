"""Whether an output is the one that a page shows, apart from what changes with the machine or its load."""

from __future__ import annotations

import math
import re

NUMBER = re.compile(r"[-+]?(?:\d[\d,]*\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
DURATION = re.compile(r"\b\d[\d.e+]* (?:s|ms|µs|min)\b(?= \w|,|$| *\n)")
TIME = re.compile(r"\b\d[\d.e+]* (?:s|ms|µs|min)\b")
STATISTICS = re.compile(r"^statistics\n(?:  .*\n?)*", re.MULTILINE)
VERIFICATION = re.compile(r"(?<=\n)(verification: .*\n)(?:  .*\n?)*")
COUNT = "#"  # stands for a number that may differ
RELATIVE, ABSOLUTE = 5e-3, 2e-3
SMALL = 1e-4  # numbers below are rounding and truncation errors


def difference(said: str, printed: str) -> str:
    """Return the first difference in words, or an empty text.

    A line that is just "..." in ``said`` stands for any lines, "..." within a line for any words. Numbers
    agree to 0.5 %; counts and times of the statistics, wall times, very small numbers and what a verification lists
    may be anything.
    """
    expected, found = normal(said), normal(printed)
    return match(expected.split(), found.split())


def normal(text: str) -> str:
    """The text with what may differ made equal."""
    text = VERIFICATION.sub(r"\1", text)  # which equations are the worst is a matter of rounding
    text = DURATION.sub(f"{COUNT} s", text)
    text = STATISTICS.sub(lambda m: NUMBER.sub(COUNT, TIME.sub(f"{COUNT} s", m[0])), text)
    return NUMBER.sub(lambda m: COUNT if 0.0 < abs(value(m[0])) < SMALL else m[0], text)


def value(number: str) -> float:
    """A number with or without commas between thousands."""
    return float(number.replace(",", ""))


def match(expected: list[str], found: list[str]) -> str:
    """Compare words; "..." skips to the next place where what follows fits."""
    at = 0
    for index, word in enumerate(expected):
        if word == "...":
            rest = expected[index + 1 :]
            starts = range(at, len(found) + 1)
            if not rest or any(not match(rest, found[start:]) for start in starts):
                return ""
            return f"nothing fits what follows the '...' before {' '.join(rest[:6])!r}"
        if at == len(found):
            return f"expected {word!r} after {' '.join(found[-6:])!r}, but there is no more"
        if not same(word, found[at]):
            context = " ".join(found[max(0, at - 5) : at])
            return f"expected {word!r}, found {found[at]!r} after {context!r}"
        at += 1
    return f"found {found[at]!r} after the end" if at < len(found) else ""


def same(word: str, other: str) -> bool:
    """Whether two words are equal, their numbers nearly."""
    if word == other:
        return True
    if NUMBER.sub(COUNT, word) != NUMBER.sub(COUNT, other):
        return False
    expected, found = NUMBER.findall(word), NUMBER.findall(other)
    return len(expected) == len(found) and all(map(close, expected, found))


def close(number: str, other: str) -> bool:
    """Whether two numbers are nearly equal."""
    return math.isclose(value(number), value(other), rel_tol=RELATIVE, abs_tol=ABSOLUTE)
