"""The energy audit of a run: what went in, where it was lost, what came out, what stayed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from itertools import chain
from typing import TYPE_CHECKING, Any

import numpy as np

from arthur_acausal.errors import ResultError

if TYPE_CHECKING:
    from arthur_acausal.result.solution import Solution


@dataclass(frozen=True, slots=True)
class Energy:
    """Energies of one run, J.

    Attributes
    ----------
    input_J : what was put in.
    losses_J : what was turned into heat, by cause.
    work_J : what was delivered to the loads.
    stored_J : by how much the energy inside grew.
    closure : (input - losses - work - stored) / input, 0 where the model conserves energy and the run is
        exact. Without input, relative to the sum of all terms' magnitudes.
    """

    input_J: float
    losses_J: Mapping[str, float]
    work_J: float
    stored_J: float
    closure: float

    def as_dict(self) -> dict[str, Any]:
        """All terms by name, ready for JSON."""
        return asdict(self)


def audit(solution: Solution) -> Energy:
    """Add up the terms that the model names.

    ``solution.run.audit`` maps "input", "work" and "stored" to lists of paths and "losses" to a mapping of
    causes to such lists. A path is of an energy in J, of which the growth counts, or of a power in W, which
    is integrated over the stored times; a minus sign before it turns its sign. Patterns such as
    ``valves[*].E`` are allowed.
    """
    terms = solution.run.audit
    lists = [
        *terms.get("losses", {}).values(),
        *(terms.get(name, ()) for name in ("input", "work", "stored")),
    ]
    solution.values(_paths(solution, chain.from_iterable(map(_listed, lists))))  # at once: that is faster
    losses = {cause: total(solution, paths) for cause, paths in terms.get("losses", {}).items()}
    put_in, work, stored = (total(solution, terms.get(name, ())) for name in ("input", "work", "stored"))
    rest = put_in - sum(losses.values()) - work - stored
    scale = abs(put_in) or sum(map(abs, [*losses.values(), work, stored])) or 1.0
    return Energy(put_in, losses, work, stored, rest / scale)


def total(solution: Solution, terms: str | Iterable[str]) -> float:
    """Sum of energies over the run, J."""
    amount = 0.0
    for term in _listed(terms):
        sign = -1.0 if term.startswith("-") else 1.0
        for path in _paths(solution, [term]):
            amount += sign * gain(solution, path)
    return amount


def _listed(terms: str | Iterable[str]) -> Iterable[str]:
    return [terms] if isinstance(terms, str) else terms


def _paths(solution: Solution, terms: Iterable[str]) -> list[str]:
    return [path for term in terms for path in solution.select(term.removeprefix("-"))]


def gain(solution: Solution, path: str) -> float:
    """Growth of an energy over the run, or the integral of a power, J."""
    unit, values = solution.unit(path), solution[path]
    if unit == "J":
        return float(values[-1] - values[0])
    if unit == "W":
        return float(np.trapezoid(values, solution.t))
    raise ResultError(
        f"{path} in the energy audit is in {unit}", remedy="name an energy in J or a power in W"
    )
