"""Parameters and start values of a compiled model: numbers by path, dependent ones computed anew for every run."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from arthur_acausal.errors import ArthurError, ParameterError, nearest_or_all
from arthur_acausal.units import to_si


@dataclass(frozen=True, slots=True)
class ParameterInfo:
    """One entry of the vector p: ``dependent``: its value follows from others unless it is given."""

    path: str
    unit: str
    default: float
    dependent: bool
    min: float | None
    max: float | None
    description: str
    display: str | None = None


@dataclass(frozen=True, slots=True)
class ParameterTable:
    """All entries of p, and ``evaluate(values, given) -> p``, which fills in the dependent ones.

    ``alias`` maps the path of a shared parameter to the path that it stands for.
    """

    infos: list[ParameterInfo]
    alias: dict[str, str]
    evaluate: ca.Function | None
    number: dict[str, int]

    def vector(self, overrides: Mapping[str, Any] | None = None) -> NDArray[np.float64]:
        """Return p for the given values (SI numbers, text with a unit, or pint quantities), by path.

        Raises ParameterError for an unknown path, a value out of bounds or one that is not finite.
        """
        values = np.array([info.default for info in self.infos], dtype=float)
        given = np.zeros(len(values))
        for path, value in (overrides or {}).items():
            k = self.find(path)
            values[k] = self._number(self.infos[k], value)
            given[k] = 1.0
        if self.evaluate is not None:
            values = np.asarray(self.evaluate(values, given), dtype=float).reshape(-1)
        self._check(values)
        return values

    def find(self, path: str) -> int:
        """Return the number of a parameter; ParameterError with the nearest paths if there is none."""
        path = self.alias.get(path, path)
        if path not in self.number:
            raise ParameterError(
                f"there is no parameter {path!r}",
                path=path,
                remedy=nearest_or_all(path, [*self.number, *self.alias]),
            )
        return self.number[path]

    @staticmethod
    def _number(info: ParameterInfo, value: Any) -> float:
        try:
            return to_si(value, info.unit, path=info.path)
        except ArthurError:
            raise
        except (TypeError, ValueError) as error:
            raise ParameterError(
                f"{value!r} is no value in {info.unit}", path=info.path, cause=str(error)
            ) from None

    def _check(self, values: NDArray[np.float64]) -> None:
        for info, value in zip(self.infos, values.tolist(), strict=True):
            low = -math.inf if info.min is None else info.min
            high = math.inf if info.max is None else info.max
            if not low <= value <= high:
                raise ParameterError(
                    f"{value:g} {info.unit} is outside of [{low:g}, {high:g}]",
                    path=info.path,
                    cause=f"it is: {info.description}" if info.description else "",
                    remedy="choose a value within the bounds that the component declares",
                )
