"""What Arthur says when something is wrong: one message with path, equation, file:line, cause and remedy."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from typing import Any


class ArthurError(Exception):
    """Base of all errors that a user can cause or meet.

    The parts are kept as attributes, so that tools can show them apart; ``str`` joins them into one message:
    ``jack.cylinder "mass balance" (cylinder.py:73): message Cause: ... Remedy: ...``
    """

    def __init__(
        self,
        message: str,
        *,
        path: str = "",
        equation: str = "",
        where: str = "",
        cause: str = "",
        remedy: str = "",
    ) -> None:
        super().__init__(message)
        self.message = message
        self.path = path
        self.equation = equation
        self.where = where
        self.cause = cause
        self.remedy = remedy

    def __str__(self) -> str:
        place = " ".join(
            part
            for part in (
                self.path,
                f'"{self.equation}"' if self.equation else "",
                f"({self.where})" if self.where else "",
            )
            if part
        )
        text = f"{place}: {self.message}" if place else self.message
        if self.cause:
            text += f"\n  cause: {self.cause}"
        if self.remedy:
            text += f"\n  remedy: {self.remedy}"
        return text


class DeclarationError(ArthurError):
    """A component class or a modification of it is not valid."""


class UnitError(ArthurError):
    """Units or dimensions do not agree."""


class ConnectError(ArthurError):
    """Two connectors cannot be connected."""


class ParameterError(ArthurError):
    """A parameter is missing, unknown, or out of its bounds."""


class StructureError(ArthurError):
    """The equations and the unknowns do not match."""


class InitializationError(ArthurError):
    """No consistent initial values were found."""


class SimulationError(ArthurError):
    """The integration stopped early. ``solution`` holds what was computed up to there, or None."""

    solution: Any = None


class ResultError(ArthurError):
    """A result cannot be read, written, or does not hold what was asked for."""


class UsageError(ArthurError):
    """A command or a call was given something that it cannot use."""


def nearest(name: str, known: Iterable[str]) -> str:
    """Return ``did you mean a, b?`` with the known names nearest to ``name``, or an empty string."""
    names = list(known)
    matches = [other for other in names if other.lower() == name.lower()]
    matches = matches or difflib.get_close_matches(name, names, n=3, cutoff=0.6)
    return f"did you mean {', '.join(matches)}?" if matches else ""


def nearest_or_all(name: str, known: Iterable[str], most: int = 8) -> str:
    """Return the known names nearest to ``name``, or the first of all of them if none is near."""
    names = list(known)
    rest = f" and {len(names) - most} more" if len(names) > most else ""
    return nearest(name, names) or (f"there is {', '.join(names[:most])}{rest}" if names else "there is none")
