"""What goes into which panel of a picture, in which unit."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from arthur_acausal.errors import ResultError, UnitError
from arthur_acausal.result.display import display_unit, labelled
from arthur_acausal.result.interpolate import FloatArray
from arthur_acausal.units import Unit, format_dimension, parse_unit

if TYPE_CHECKING:
    from arthur_acausal.result.solution import Solution

LONGEST_NAME = 24  # characters that fit beside a panel
MOST_LINES = 28  # in one panel: as many as there are pairs of colour and style

Lines: TypeAlias = str | Iterable[str] | Mapping[str, str]
Wanted: TypeAlias = str | Iterable[str] | Mapping[str, Lines]


@dataclass(frozen=True, slots=True)
class Panel:
    """One panel: the text at its axis, the unit of its values, and its lines: label to path."""

    label: str
    unit: Unit
    lines: Mapping[str, str]


def panels(solution: Solution, wanted: Wanted) -> list[Panel]:
    """The panels of a picture.

    Parameters
    ----------
    wanted : patterns, which give one panel for each unit; or the panels themselves: from the text at the axis
        with its unit, "pressure [bar]", to patterns or to a mapping of labels to paths (none: an empty panel).

    Raises
    ------
    ResultError
        Where a pattern matches nothing, or a panel would hold more lines than can be told apart.
    UnitError
        Where a variable cannot be shown in its panel's unit.
    """
    if isinstance(wanted, Mapping):
        found = [titled_panel(solution, title, lines) for title, lines in wanted.items()]
    else:
        found = by_unit(solution, solution.select(wanted))
    for panel in found:
        if len(panel.lines) > MOST_LINES:
            raise ResultError(
                f"{len(panel.lines)} variables in {panel.unit.text} are too many for one picture",
                remedy=f"choose at most {MOST_LINES} of each unit",
            )
    return found


def titled_panel(solution: Solution, title: str, lines: Lines) -> Panel:
    """A panel from the text at its axis and what it shows."""
    parts = re.fullmatch(r"\s*(.*?)\s*(?:\[(.*)\])?\s*", title)
    assert parts is not None  # it matches any text
    unit = parse_unit(parts[2] or "1")
    if not isinstance(lines, Mapping):
        lines = {path: path for path in (solution.select(lines) if lines else [])}
    for path in lines.values():
        dimension = parse_unit(solution.unit(path)).dimension
        if dimension != unit.dimension:
            raise UnitError(f"{path} is {format_dimension(dimension)} and cannot be shown in {unit.text}")
    return Panel(labelled(parts[1], unit.text), unit, lines)


def by_unit(solution: Solution, paths: Sequence[str]) -> list[Panel]:
    """One panel for each unit that people read, in the order of their first appearance."""
    declared = {path: (solution.unit(path), solution.variable(path).display) for path in paths}
    largest: dict[tuple[str, str], float] = {}
    for path, key in declared.items():
        largest[key] = max(largest.get(key, 0.0), magnitude(solution[path]))
    units = {key: display_unit(*key, value) for key, value in largest.items()}
    groups: dict[Unit, list[str]] = {}
    for path, key in declared.items():
        groups.setdefault(units[key], []).append(path)
    return [
        Panel(labelled(common_name(solution, members), unit.text), unit, {path: path for path in members})
        for unit, members in groups.items()
    ]


def magnitude(values: FloatArray) -> float:
    """Largest absolute value that is finite; 0 where there is none."""
    return float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0))


def common_name(solution: Solution, paths: Sequence[str]) -> str:
    """What all these variables are: the short description they share, or their quantity, or last name."""
    described = {solution.description(path) for path in paths}
    kinds = {quantity(solution.unit(path)) for path in paths}
    for names in (described, kinds, {path.rpartition(".")[2] for path in paths}):
        if len(names) == 1 and 0 < len(name := names.pop()) <= LONGEST_NAME:
            return name
    return ""


def quantity(unit: str) -> str:
    """What is measured in a unit: "pressure"; empty where that is not known or not certain."""
    known = re.search(r"\((.*), ", format_dimension(parse_unit(unit).dimension))
    return known[1] if known and " or " not in known[1] else ""
