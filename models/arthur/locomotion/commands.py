"""Command inputs (7.2): what the robot shall do."""

from __future__ import annotations

import csv
from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass, fields
from math import isfinite
from pathlib import Path

from arthur_acausal import UsageError
from arthur_acausal.models.arthur.locomotion.gaits import GAITS


@dataclass(frozen=True, slots=True)
class Command:
    """What is commanded at one moment.

    Attributes
    ----------
    v_x, v_y : velocity ahead and to the left [m/s]. yaw_rate : to the left [rad/s]. Vertical velocity, roll and pitch
        rate are zero (7.2.2).
    height : of the trunk's centre above the ground, H_base [m].
    half_step : step half length, L_span [m]. swing_height : H_sw [m]. gait : one of GAITS.
    """

    v_x: float = 0.0
    v_y: float = 0.0
    yaw_rate: float = 0.0
    height: float = 0.25
    half_step: float = 0.094
    swing_height: float = 0.05
    gait: str = "trot"

    def __post_init__(self) -> None:
        if self.gait not in GAITS:
            raise UsageError(f"there is no gait {self.gait!r}", remedy=f"choose one of {', '.join(GAITS)}")
        numbers = [getattr(self, name) for name in NUMBERS]
        if not all(isfinite(x) for x in numbers):
            raise UsageError(f"a command of {self} is not finite", remedy="give finite numbers")
        if min(self.height, self.half_step) <= 0.0 or self.swing_height < 0.0:
            raise UsageError(
                f"height {self.height} m, half_step {self.half_step} m and swing_height {self.swing_height} m "
                "must be positive",
                remedy="give lengths in metres, upward positive",
            )


NUMBERS = tuple(field.name for field in fields(Command) if field.name != "gait")

Commands = Callable[[float], Command]
"""A command for each time [s]."""


@dataclass(frozen=True, slots=True)
class Constant:
    """The same command always."""

    command: Command

    def __call__(self, t: float) -> Command:
        return self.command


@dataclass(frozen=True, slots=True)
class Table:
    """Commands that hold from their times [s] on, in ascending order; the first also holds before."""

    times: tuple[float, ...]
    commands: tuple[Command, ...]

    def __post_init__(self) -> None:
        finite = all(isfinite(t) for t in self.times)
        ascending = finite and all(a < b for a, b in zip(self.times, self.times[1:], strict=False))
        if not self.times or len(self.times) != len(self.commands) or not ascending:
            raise UsageError(
                "the times of a table of commands must ascend, one for each command",
                remedy="sort the rows and give each a time of its own",
            )

    def __call__(self, t: float) -> Command:
        return self.commands[max(bisect_right(self.times, t) - 1, 0)]


def read_commands(path: str | Path) -> Table:
    """Read a CSV with a column ``t`` [s] and any of the fields of Command; missing fields keep their defaults.

    Raises
    ------
    UsageError : names the line and the column that is not understood.
    """
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as cause:
        raise UsageError(f"{path} is not read: {cause}", remedy="give a CSV file in UTF-8") from cause
    header, *lines = [row for row in csv.reader(text.splitlines()) if row] or [[]]
    names = [name.strip() for name in header]
    if "t" not in names or len(set(names)) < len(names) or set(names) - {"t", "gait", *NUMBERS}:
        raise UsageError(
            f"{path}: the columns are {names}",
            remedy=f"have a column t and any of {', '.join(NUMBERS)}, gait",
        )
    times, commands = [], []
    for row, line in enumerate(lines, start=1):
        if len(line) != len(names):
            raise UsageError(
                f"{path}: row {row} has {len(line)} cells, not {len(names)}",
                remedy="give a cell for each column",
            )
        cells = dict(zip(names, (cell.strip() for cell in line), strict=True))
        gait = cells.pop("gait", "trot")
        numbers = {name: _number(cell, f"{path}: row {row}: {name}") for name, cell in cells.items()}
        times.append(numbers.pop("t"))
        commands.append(Command(**numbers, gait=gait))
    return Table(tuple(times), tuple(commands))


def _number(text: str, place: str) -> float:
    try:
        return float(text)
    except ValueError as cause:
        raise UsageError(f"{place} is {text!r}", remedy="write a number") from cause
