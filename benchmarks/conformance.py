"""Reference cases of others, solved by IDA: ``python -m benchmarks.conformance --cases DIR [--json]``.

Each folder of DIR holds a case.json, which says what is required; it is read here, never chosen. Problems given as
text are read by a whitelist; examples of the Modelica Standard Library are the models of
``arthur_acausal.models.conformance``, built from the library by ``connect``. A case without a model has failed.
"""

from __future__ import annotations

import argparse
import csv
import json
import re
import sys
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import ArthurError, SimulationError, SolverOptions, translate
from arthur_acausal.models.conformance.case import Case
from arthur_acausal.models.conformance.hopsan import Assembly, Reader
from benchmarks.chains import cascaded_first_order, harmonic_oscillator, many_events
from benchmarks.end_values import end_values
from benchmarks.hydraulics import SOLVERS as HYDRAULIC
from benchmarks.mujoco_cases import double_pendulum, free_rigid_body
from benchmarks.text_problem import TextError

FloatArray = NDArray[np.float64]

VALUE_TUBE, TIME_TUBE = 1e-3, 2e-3  # shares of a signal's range and of the time span
LIBRARY = (
    "blocks",
    "circuits",
    "drives",
    "electrical",
    "losses",
    "mechanics",
    "resonance",
    "rotational",
    "semiconductors",
    "thermal",
    "translational",
)
NOT_BUILT = "not built"
Tube = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Outcome:
    """One case: ``error`` in the measure of its case.json; None where there is none."""

    name: str
    error: float | None
    required: float
    passed: bool
    why: str

    def as_object(self) -> dict[str, Any]:
        """Return what --json prints."""
        found = asdict(self)
        found["pass"] = found.pop("passed")
        return found


def tube(case: Mapping[str, Any], folder: Path) -> tuple[float, str]:
    """Simulate an example of the Modelica Standard Library; the largest share of samples out of the tube."""
    model = library_cases()[case["name"]]
    times, columns = read_reference(folder / case["reference"]["file"])
    solution = translate(model.model()).simulate(float(times[-1]), options=model.options)
    shares = {}
    for signal, values in columns.items():
        path = model.path(signal, solution)
        if path is None:
            return 1.0, f"no variable for the signal {signal}"
        own = np.asarray(solution[path])
        shares[signal] = out_of_tube(times, values, np.asarray(solution.t), own)
    worst = max(shares, key=shares.__getitem__)
    return shares[worst], f"worst: {worst}" if shares[worst] else model.note


def out_of_tube(
    times: FloatArray,
    values: FloatArray,
    t: FloatArray,
    own: FloatArray,
    tube: Tube = (VALUE_TUBE, TIME_TUBE),
) -> float:
    """Return the share of the reference's samples that our curve, within the time tube, does not come near."""
    span = tube[1] * (times[-1] - times[0])
    room = tube[0] * max(float(np.ptp(values)), np.finfo(float).tiny)
    near = max(room, 1e-12 * float(np.max(np.abs(values), initial=0.0)))
    first, last = np.searchsorted(t, times - span), np.searchsorted(t, times + span, side="right")
    outside = 0
    for k, value in enumerate(values.tolist()):
        ends = np.interp([times[k] - span, times[k], times[k] + span], t, own)
        part = np.concatenate([ends, own[first[k] : last[k]]])
        outside += not (part.min() - near <= value <= part.max() + near)
    return outside / len(values)


def hopsan(case: Mapping[str, Any], folder: Path) -> tuple[float, str]:
    """Simulate components of Hopsan, connected as the case says; the largest share of samples out of the tube.

    Hopsan's first samples are the start values of the case, whether they fit the equations or not. They precede ours,
    so that the step to what fits is an edge like any other, which the time tube forgives.
    """
    reader = Reader(case)
    begin, end = (float(case["simulation"][key]) for key in ("start", "stop"))
    table = np.loadtxt(folder / case["reference"]["file"], delimiter=",", ndmin=2)
    if table.shape[0] < table.shape[1]:
        table = table.T  # one line a signal
    options = SolverOptions(rtol=1e-7, intervals=2000)
    solution = translate(Assembly(plan=reader.plan)).simulate(end, start_time=begin, options=options)
    shares = {}
    for signal in case["reference"]["signals"]:
        path, sign = reader.path(signal["name"])
        times, values = table[:, signal["timecolumn"]], table[:, signal["column"]]
        own, t = sign * np.asarray(solution[path]), np.asarray(solution.t)
        before = reader.before(signal["name"])
        if before is not None:  # an edge at the start
            own, t = np.insert(own, 0, before), np.insert(t, 0, t[0])
        shares[signal["name"]] = out_of_tube(times, values, t, own, tube_of(case))
    worst = max(shares, key=shares.__getitem__)
    return shares[worst], f"worst: {worst}" if shares[worst] else reader.notes()


def tube_of(case: Mapping[str, Any]) -> Tube:
    """Return the tube that a case's measure names."""
    found = re.search(r"tube of (\S+) of the range and (\S+) of the time span", case["required"]["measure"])
    if found is None:
        raise TextError(f"no tube in the measure: {case['required']['measure']}")
    return float(found[1]), float(found[2])


def read_reference(file: Path) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Return the times and the columns of a reference's CSV."""
    with file.open(newline="", encoding="utf-8") as lines:
        rows = csv.reader(lines)
        header = next(rows)
        table = np.array([[float(x) for x in row] for row in rows])
    return table[:, 0], {name: table[:, k] for k, name in enumerate(header) if k}


def library_cases() -> dict[str, Case]:
    """Return all cases that are built from the component library."""
    found: dict[str, Case] = {}
    for name in LIBRARY:
        found |= import_module(f"arthur_acausal.models.conformance.msl_{name}").CASES
    return found


def bounces(case: Mapping[str, Any], folder: Path) -> tuple[float, str]:
    """Let the ball bounce; the largest error of its impact times [s]."""
    from arthur_acausal.models.examples.bouncing_ball import BouncingBall

    given = case["parameters"]
    try:
        solution = translate(BouncingBall()).simulate(
            1.05 * case["reference"]["zeno_time"],
            options=SolverOptions(rtol=1e-9),
            parameters={"e": given["e"], "g": given["g"], "h_0": given["h0"]},
        )
        ended = "the end was not found"
    except SimulationError as error:
        solution, ended = error.solution, error.message.split(";")[0]
    times = [e.time for e in solution.events if e.kind == "state"]
    reference = case["reference"]["bounce_times"]
    return max(abs(a - b) for a, b in zip(times, reference, strict=False)), ended


SOLVERS: dict[str, Callable[[Mapping[str, Any], Path], tuple[float, str]]] = {
    "ev_bouncing_ball": bounces,
    "mj_double_pendulum": double_pendulum,
    "mj_free_rigid_body": free_rigid_body,
    "scal_CascadedFirstOrder": cascaded_first_order,
    "scal_HarmonicOscillator": harmonic_oscillator,
    "scal_ManyEvents": many_events,
}


def solver_of(case: Mapping[str, Any]) -> Callable[[Mapping[str, Any], Path], tuple[float, str]] | None:
    """Return what solves a case; None if no model was built."""
    if case["name"] in SOLVERS:
        return SOLVERS[case["name"]]
    if str(case.get("format", "")).startswith("eqjson-1"):
        return end_values
    for beginning, solve in HYDRAULIC.items():
        if case["name"].startswith(beginning):
            return solve
    if case["name"].startswith("hopsan_"):
        return hopsan
    return tube if case["name"] in library_cases() else None


def _told(failure: Exception) -> str:
    """Return a failure's first line; its kind, too, where it is none of ours: a case that is not as expected."""
    text = str(failure).partition("\n")[0]
    return text if isinstance(failure, ArthurError | TextError) else f"{type(failure).__name__}: {text}"


def run(folder: Path) -> Outcome:
    """Solve the case in a folder."""
    case = json.loads((folder / "case.json").read_text(encoding="utf-8"))
    required = float(case["required"]["value"])
    solve = solver_of(case)
    if solve is None:
        return Outcome(case["name"], None, required, False, NOT_BUILT)
    try:
        error, why = solve(case, folder)
    except (ArthurError, ArithmeticError, LookupError, TypeError, ValueError) as failure:
        return Outcome(case["name"], None, required, False, _told(failure))
    return Outcome(case["name"], error, required, bool(error <= required), why)


def main() -> None:
    """Run all cases and print a table, or one JSON object."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.conformance", description=__doc__)
    parser.add_argument("--cases", type=Path, required=True, help="folder with one folder a case")
    parser.add_argument("--only", default="", help="run the cases whose name contains this")
    parser.add_argument("--json", action="store_true", help="print one JSON object and nothing else")
    given = parser.parse_args()
    folders = sorted(f.parent for f in given.cases.glob("*/case.json") if given.only in f.parent.name)
    if not folders:
        sys.exit(f"there is no case in {given.cases}")
    outcomes = []
    for folder in folders:
        outcome = run(folder)
        outcomes.append(outcome)
        if not given.json:
            error = "-" if outcome.error is None else f"{outcome.error:.2e}"
            mark = "pass" if outcome.passed else "FAIL"
            print(f"{outcome.name:46} {error:>9} {outcome.required:>8.0e}  {mark}  {outcome.why}", flush=True)
    passed = sum(o.passed for o in outcomes)
    if given.json:
        print(
            json.dumps({"cases": [o.as_object() for o in outcomes], "passed": passed, "total": len(outcomes)})
        )
    else:
        print(f"{passed} of {len(outcomes)} pass")


if __name__ == "__main__":
    main()
