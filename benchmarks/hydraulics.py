"""Hydraulic cases with closed forms (``hyd_*``): what is required of each, measured on a run by IDA."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from math import pi, sin
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import Solution, SolverOptions, translate
from arthur_acausal.models.conformance import hydraulic

FloatArray = NDArray[np.float64]
Found = tuple[float, str]

PRECISE = SolverOptions(rtol=1e-10, intervals=1000)
TURNS = 20
"""Periods over which a frequency is measured."""
CELLS = 20
"""Cells of the line whose first mode is looked at."""
PLATEAU = 1e-2
"""Error of the pressure of water hammer that its measure allows, over the rise."""


def worst(errors: Mapping[str, float]) -> Found:
    """Return the largest of some errors, and which it is."""
    name = max(errors, key=errors.__getitem__)
    return errors[name], f"worst: {name}"


def relative(found: float, expected: float) -> float:
    """Return the relative error."""
    return abs(found - expected) / abs(expected)


def orifice_divider(case: Mapping[str, Any], folder: Path) -> Found:
    """Pressure between two orifices, and the flow through both."""
    solution = translate(hydraulic.divider(case["parameters"])).simulate(1.0, options=PRECISE)
    found = {"p_mid": solution.final("first.port_b.p"), "q": solution.final("first.q")}
    return worst({name: relative(value, case["reference"][name]) for name, value in found.items()})


def orifice_blowdown(case: Mapping[str, Any], folder: Path) -> Found:
    """Pressure of an emptying volume at 0.5 and 0.9 of the time that it takes: a quarter and a hundredth."""
    empty, p0 = case["reference"]["t_empty"], case["parameters"]["p0"]
    solution = translate(hydraulic.blow_down(case["parameters"])).simulate(empty, options=PRECISE)
    expected = {share: p0 * (1 - share) ** 2 for share in (0.5, 0.9)}
    expected[0.5] = case["reference"]["p_at_half"]
    return worst(
        {
            f"p at {share} t_empty": relative(float(solution.at(share * empty, "volume.p")), p)
            for share, p in expected.items()
        }
    )


def keyed(values: Mapping[str, float]) -> Iterator[tuple[str, float, float]]:
    """Yield label, argument and value of reference values whose keys read ``name=number``."""
    for label, value in values.items():
        yield label, float(label.partition("=")[2]), value


def trapped_volume(case: Mapping[str, Any], folder: Path) -> Found:
    """Pressure of a volume that is compressed to each of the reference's."""
    errors = {}
    for label, V_end, pressure in keyed(case["reference"]["values"]):
        solution = translate(hydraulic.trapped_volume(case["parameters"], V_end)).simulate(
            1.0, options=PRECISE
        )
        errors[label] = relative(solution.final("ram.p"), pressure)
    return worst(errors)


def accumulator(case: Mapping[str, Any], folder: Path) -> Found:
    """Pressure and stored work of an accumulator after it has taken what the reference says."""
    given, reference, errors = case["parameters"], case["reference"], {}
    for n, kind in ((1.0, "isothermal"), (given["n"], "polytropic")):
        for quantity, path in ((f"{kind}_p", "p"), (f"stored_work_{kind}_J", "E_stored")):
            for label, taken, value in keyed(reference.get(quantity, {})):
                rig = translate(hydraulic.charging(given, n))
                solution = rig.simulate(taken / given["V0"], options=PRECISE)
                found = solution.final(f"accumulator.{path}") - (path == "E_stored") * solution.initial(
                    f"accumulator.{path}"
                )
                errors[f"{quantity} at {label}"] = relative(found, value)
    return worst(errors)


def cylinder(case: Mapping[str, Any], folder: Path) -> Found:
    """Angular frequency of a mass on a locked cylinder."""
    given, omega = case["parameters"], case["reference"]["omega"]
    options = SolverOptions(rtol=1e-9, intervals=100 * TURNS)
    solution = translate(hydraulic.locked_cylinder(given)).simulate(TURNS * 2 * pi / omega, options=options)
    return worst({"omega": relative(frequency(solution.t, solution["mass.v"]), omega)})


def frequency(t: FloatArray, x: FloatArray) -> float:
    """Return the mean angular frequency [rad/s] of ``x``, from its rising zero crossings."""
    rising = np.flatnonzero((x[:-1] < 0) & (x[1:] >= 0))
    times = t[rising] - x[rising] * (t[rising + 1] - t[rising]) / (x[rising + 1] - x[rising])
    return float(2 * pi * (len(times) - 1) / (times[-1] - times[0]))


def water_hammer(case: Mapping[str, Any], folder: Path) -> Found:
    """Frequency of the first mode of a line of cells; and, by the characteristics, the plateaus at the valve."""
    given, reference = case["parameters"], case["reference"]
    plateau = plateau_error(translate(hydraulic.shut_line(given)).simulate(1.9 * reference["period"]), case)
    theta = pi / (2 * CELLS)
    expected = 2 * CELLS * given["a"] / given["L"] * sin(theta / 2)
    shape = np.sin(theta * (np.arange(CELLS) + 0.5))
    begin = {
        f"line.cells[{k}].p": given["p0"] + 1e-3 * reference["dp"] * s for k, s in enumerate(shape.tolist())
    }
    options = SolverOptions(rtol=1e-8, intervals=100 * TURNS)
    rig = translate(hydraulic.shut_cells(given, CELLS))
    solution = rig.simulate(TURNS * 2 * pi / expected, start=begin, options=options)
    measured = frequency(solution.t, solution[f"line.cells[{CELLS - 1}].p"] - given["p0"])
    error = relative(measured, expected)
    note = f"{CELLS} cells; plateaus within {plateau:.1e} of dp"
    return (error, note) if plateau <= PLATEAU else (1.0, note)


def plateau_error(solution: Solution, case: Mapping[str, Any]) -> float:
    """Return the largest error of the valve's pressure on its first three plateaus, over the rise ``dp``."""
    p0, dp, half = case["parameters"]["p0"], case["reference"]["dp"], case["reference"]["period"] / 2
    plateaus = np.repeat(np.arange(3), 3)
    times = half * (plateaus + np.tile([0.05, 0.5, 0.95], 3))
    rise = solution.at(times, "line.port_b.p") - p0
    return float(np.max(np.abs(rise / dp - (-1.0) ** plateaus)))


SOLVERS: dict[str, Callable[[Mapping[str, Any], Path], Found]] = {
    "hyd_accumulator_polytropic": accumulator,
    "hyd_cylinder_natural_frequency": cylinder,
    "hyd_orifice_blowdown": orifice_blowdown,
    "hyd_orifice_divider": orifice_divider,
    "hyd_trapped_volume": trapped_volume,
    "hyd_water_hammer": water_hammer,
}
"""By the beginning of the case's name: a case of the same circuit with other numbers has the name and a suffix."""
