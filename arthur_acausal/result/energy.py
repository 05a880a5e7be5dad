"""The energy audit of a run: what went in, where it was lost, what came out, what stayed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
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
    causes = terms.get("losses", {})
    parts = {name: signed(solution, terms.get(name, ())) for name in ("input", "work", "stored")}
    lost = {cause: signed(solution, paths) for cause, paths in causes.items()}
    growth = gains(solution, {path for part in (*parts.values(), *lost.values()) for _, path in part})

    def total(part: list[tuple[float, str]]) -> float:
        return sum((sign * growth[path] for sign, path in part), 0.0)

    losses = {cause: total(part) for cause, part in lost.items()}
    put_in, work, stored = map(total, parts.values())
    rest = put_in - sum(losses.values()) - work - stored
    scale = abs(put_in) or sum(map(abs, [*losses.values(), work, stored])) or 1.0
    return Energy(put_in, losses, work, stored, rest / scale)


def signed(solution: Solution, terms: str | Iterable[str]) -> list[tuple[float, str]]:
    """Return sign and path of all that the terms name."""
    return [
        (-1.0 if term.startswith("-") else 1.0, path)
        for term in ([terms] if isinstance(terms, str) else terms)
        for path in solution.select(term.removeprefix("-"))
    ]


def gains(solution: Solution, paths: Iterable[str]) -> dict[str, float]:
    """Return the growth of each energy over the run, or the integral of a power, J."""
    units = {path: solution.unit(path) for path in paths}
    for path, unit in units.items():
        if unit not in ("J", "W"):
            raise ResultError(
                f"{path} in the energy audit is in {unit}", remedy="name an energy in J or a power in W"
            )
    energies = [path for path, unit in units.items() if unit == "J"]
    powers = [path for path, unit in units.items() if unit == "W"]
    growth = np.diff(solution.ends(energies), axis=0).ravel()
    worked = np.trapezoid(solution.values(powers), solution.t, axis=0)
    return dict(zip([*energies, *powers], [*growth.tolist(), *np.atleast_1d(worked).tolist()], strict=True))
