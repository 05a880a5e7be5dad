"""Choosing variables by patterns such as ``valves[*].I``."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from arthur_acausal.errors import ResultError, nearest


def is_pattern(text: str) -> bool:
    """Whether a path holds a wildcard; brackets are part of paths and mean themselves."""
    return "*" in text or "?" in text


def compile_pattern(pattern: str) -> re.Pattern[str]:
    """Translate a pattern: ``*`` is any text without a dot, ``**`` any text, ``?`` one but a dot."""
    wild = {"**": ".*", "*": "[^.]*", "?": "[^.]"}
    pieces = re.split(r"(\*\*|\*|\?)", pattern)
    return re.compile("".join(wild.get(piece) or re.escape(piece) for piece in pieces))


def select(patterns: str | Iterable[str], paths: Sequence[str]) -> list[str]:
    """Return the paths that the patterns choose, in the patterns' order, each once.

    Raises ResultError where a pattern chooses nothing.
    """
    known = dict.fromkeys(paths)
    chosen: dict[str, None] = {}
    for pattern in [patterns] if isinstance(patterns, str) else patterns:
        if not is_pattern(pattern):
            chosen[require(pattern, known)] = None
            continue
        matches = compile_pattern(pattern)
        hits = [path for path in paths if matches.fullmatch(path)]
        if not hits:
            raise ResultError(
                f"no variable matches {pattern!r}",
                remedy="a * does not reach over a dot; ** does",
            )
        chosen.update(dict.fromkeys(hits))
    return list(chosen)


def require(path: str, known: Iterable[str]) -> str:
    """Return the path where it is known, else raise ResultError with the nearest ones."""
    paths = known if isinstance(known, dict) else list(known)
    if path in paths:
        return path
    hint = nearest(path, paths)
    raise ResultError(
        f"the solution has no variable {path!r}",
        remedy=hint or "Solution.paths lists all variables",
    )
