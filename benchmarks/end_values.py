"""End values of problems given as text: tolerances are tightened until what is scored stands still.

A problem as text says nothing of its variables' magnitudes, nor how hard it is. So it is solved several times, each
time with the magnitudes found before, until two runs agree to a tenth of what is required. The reference has no part
in it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from arthur_acausal import ArthurError, Solution, SolverOptions, translate
from benchmarks.text_problem import attributes, problem, starts

LEVELS = (1e-5, 1e-8, 1e-10, 1e-11, 1e-12, 1e-13)  # relative tolerances
MOST = 500_000  # steps of the first run
FEW, GROWTH = 10_000, 5  # each other may take this many steps, and so many times those of the run before
UNKNOWN = (1.0, 1e-6, 1e-12)  # magnitudes to try for a variable that starts at zero
LOST = 1e-14  # of its largest value: what is left of a variable below this is of no account
AGREE = 0.1  # of what is required
NUMBERS = ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")


@dataclass(frozen=True, slots=True)
class Measure:
    """How end values are scored: the variables, and the size below which an error is no more relative.

    ``floor`` is a number, or a share of the largest reference where ``share`` is set. A reference of zero without
    such a size, or an absolute measure, compares values as they are.
    """

    names: list[str]
    floor: float = 0.0
    share: bool = False
    absolute: bool = False

    @classmethod
    def of(cls, case: Mapping[str, Any]) -> Measure:
        """Read what ``required`` says."""
        text: str = case["required"]["measure"]
        names = list(case["reference"]["values"])
        count = re.search(rf"\b({'|'.join(NUMBERS)}) (positions|components|values)", text)
        if "scored" in case["reference"]:
            names = list(case["reference"]["scored"])
        elif count:
            names = names[: NUMBERS.index(count[1]) + 1]
        elif "positions" in text:
            names = [n for n in names if not re.match("lam|mu", n)]
        floor = re.search(r"max\([^,]*,\s*([-+.\deE]+)( of the largest)?", text)
        return cls(
            names, float(floor[1]) if floor else 0.0, bool(floor and floor[2]), text.startswith("absolute")
        )

    def error(self, values: Mapping[str, float], reference: Mapping[str, float]) -> tuple[float, str]:
        """Return the largest error and whose it is."""
        largest = max(abs(v) for v in reference.values()) if self.share else 1.0
        errors = {}
        for name in self.names:
            size = max(abs(reference[name]), self.floor * largest) or 1.0
            errors[name] = abs(values[name] - reference[name]) / (1.0 if self.absolute else size)
        worst = max(errors, key=errors.__getitem__)
        return errors[worst], worst


def end_values(case: Mapping[str, Any], folder: Path) -> tuple[float, str]:
    """Solve a problem given as text; the error of its end values as its measure says."""
    measure, required = Measure.of(case), float(case["required"]["value"])
    values, rtol = solve(case, measure, required)
    error, worst = measure.error(values, case["reference"]["values"])
    return error, f"worst: {worst} (rtol {rtol:.0e})"


def solve(case: Mapping[str, Any], measure: Measure, required: float) -> tuple[dict[str, float], float]:
    """Return the end values and the relative tolerance that they were found with.

    Raises the ArthurError of the first run if none succeeds.
    """
    paths, first = attributes(case), starts(case)
    names = list(dict.fromkeys([*measure.names, *case["reference"]["values"]]))
    nominals = guesses = [{name: abs(v) or unknown for name, v in first.items()} for unknown in UNKNOWN]
    options = SolverOptions(max_steps=MOST)
    found: tuple[dict[str, float], float] | None = None
    failure: ArthurError | None = None
    failed = 0  # levels in a row
    for rtol in LEVELS:
        try:
            solution = _first_success(case, nominals, options.replace(rtol=rtol))
        except ArthurError as error:
            failure, failed = failure or error, failed + 1
            if found and failed > 1:
                break  # tighter still is no better
            continue
        values = {name: at_end(solution, paths[name]) for name in names}
        if found and measure.error(found[0], values)[0] < AGREE * required:
            return values, rtol
        found = values, rtol
        nominals, failed = [magnitudes(solution, paths), guesses[0]], 0
        options = options.replace(max_steps=FEW + GROWTH * solution.statistics.steps)
    if found is None:
        assert failure is not None
        raise failure
    return found


def _first_success(
    case: Mapping[str, Any], nominals: Sequence[Mapping[str, float]], options: SolverOptions
) -> Solution:
    """Return the run with the first of the given magnitudes that succeeds; raise the first failure if none does."""
    failure: ArthurError | None = None
    for nominal in nominals:
        try:
            model = translate(problem(case, nominal), check_units=False)
            return model.simulate(float(case["t_end"]), start_time=float(case["t0"]), options=options)
        except ArthurError as error:
            failure = failure or error
    assert failure is not None
    raise failure


def magnitudes(solution: Solution, paths: Mapping[str, str]) -> dict[str, float]:
    """Return the variables' magnitudes in a run.

    Of a variable that keeps its sign that at the end, since it may decay over decades; else the largest.
    """
    found: dict[str, float] = {}
    for name, path in paths.items():
        values = np.asarray(solution[path])[1:]
        largest = float(np.max(np.abs(values)))
        keeps = bool(np.all(values > 0.0) or np.all(values < 0.0))
        size = max(abs(float(values[-1])), LOST * largest) if keeps else largest
        found |= {name: size} if size > 0.0 else {}
    return found


def at_end(solution: Solution, path: str) -> float:
    """Return the value at the end, before what an event right there would change."""
    t = np.asarray(solution.t)
    return float(np.asarray(solution[path])[np.searchsorted(t, t[-1])])
