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
        ascending = all(a < b for a, b in zip(self.times, self.times[1:], strict=False))
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
    times, commands = [], []
    with Path(path).open(newline="", encoding="utf-8") as file:
        reader = csv.DictReader(file)
        strangers = set(reader.fieldnames or ()) - {"t", "gait", *NUMBERS}
        if strangers or "t" not in (reader.fieldnames or ()):
            raise UsageError(
                f"{path}: the columns are {reader.fieldnames}",
                remedy=f"have a column t and any of {', '.join(NUMBERS)}, gait",
            )
        for row in reader:
            values = {
                name: _number(row[name], f"{path}:{reader.line_num}: {name}")
                for name in row
                if name != "gait"
            }
            times.append(values.pop("t"))
            gait = {"gait": row["gait"].strip()} if "gait" in row else {}
            commands.append(Command(**values, **gait))  # type: ignore[arg-type]
    return Table(tuple(times), tuple(commands))


def _number(text: str | None, place: str) -> float:
    try:
        return float(text or "")
    except ValueError as cause:
        raise UsageError(f"{place} is {text!r}", remedy="write a number") from cause
