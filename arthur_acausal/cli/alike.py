"""Arrays told in one line: valves[0-11].I for the twelve of them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import TypeVar

INDEX = re.compile(r"\[(\d+)\]")
T = TypeVar("T")


def alike(items: Iterable[tuple[str, T]]) -> list[tuple[str, list[T]]]:
    """Join what belongs to paths that differ in their indices only: a common name, and the members' items."""
    groups: dict[str, list[tuple[str, T]]] = {}
    for path, item in items:
        groups.setdefault(INDEX.sub("[*]", path), []).append((path, item))
    return [
        (common_path([path for path, _ in members]), [item for _, item in members])
        for members in groups.values()
    ]


def common_path(paths: Sequence[str]) -> str:
    """One text for paths that differ in their indices only; ``[*]`` where the indices are no whole range."""
    found = [[int(index) for index in INDEX.findall(path)] for path in paths]
    texts = iter([span(column) for column in zip(*found, strict=True)])
    return INDEX.sub(lambda _: next(texts), paths[0])


def span(indices: Sequence[int]) -> str:
    """The indices that one place of a path takes."""
    low, high = min(indices), max(indices)
    if low == high:
        return f"[{low}]"
    return f"[{low}-{high}]" if set(indices) == set(range(low, high + 1)) else "[*]"


def names(paths: Iterable[str]) -> list[str]:
    """Paths with arrays joined."""
    return [name for name, _ in alike((path, None) for path in paths)]
