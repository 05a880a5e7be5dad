"""Writing solutions to NetCDF files that every NetCDF tool reads.

The format is NetCDF classic with 64-bit offsets, one variable a path with its units. NetCDF-4 would be a
hundred times slower, since each of its variables is an HDF5 object linked to the time axis (for 1,500
variables of 1,000 times 7 to 15 s, not 0.1 s). The content is made in memory and put in place by one rename,
so that a full disk cannot leave half a file.
"""

from __future__ import annotations

import io
import os
import zlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from arthur_acausal.errors import ResultError
from arthur_acausal.result.atomic import write_atomically
from arthur_acausal.result.interpolate import FloatArray
from arthur_acausal.result.run import to_json
from arthur_acausal.result.variable import TIME, Variable, dataset_name

if TYPE_CHECKING:
    from scipy.io import netcdf_file

    from arthur_acausal.result.solution import Solution

FORMAT = "arthur-acausal solution 1"
VARIABLE, DERIVATIVE = "variable", "derivative"  # roles: of the model, or a state's dx/dt for interpolation
RELATIONS, RELATION = "truth of relations", "relation"  # a variable and its second axis
TEXT_ATTRIBUTES = ("model", "description", "status", "message")
LATER = ("externals", "beside")  # not in every file of this format
JSON_ATTRIBUTES = ("parameters", "inputs", "start", "options", "statistics", "events", "audit", *LATER)
VERSION = "_version"

Said: TypeAlias = Mapping[str, str | float]  # attributes


def save(solution: Solution, file: str | os.PathLike[str]) -> None:
    """Write all variables and how they came about to a NetCDF file.

    Raises ResultError where the file cannot be written; what stood there before is then as it was.
    """
    write_atomically(file, to_bytes(solution))


def to_bytes(solution: Solution) -> bytes:
    """The content of the file."""
    from scipy.io import netcdf_file

    if solution.t.size == 0:
        raise ResultError("an empty solution cannot be written", remedy="simulate first")
    buffer = io.BytesIO()
    dataset = netcdf_file(buffer, "w", version=2)
    dataset.createDimension(TIME, solution.t.size)
    columns = write_columns(dataset, solution)
    columns |= write_modes(dataset, solution)
    write_run(dataset, solution, checksum(columns))
    dataset.flush()
    return buffer.getvalue()


def write_columns(dataset: netcdf_file, solution: Solution) -> dict[str, FloatArray]:
    """Put time, all variables and the states' derivatives into the dataset; return them by name."""
    columns = {TIME: solution.t}
    write_column(dataset, TIME, solution.t, {"units": "s", "long_name": TIME, "axis": "T"})
    block = solution.values(solution.paths)
    for index, (path, variable) in enumerate(solution.variables.items()):
        column = np.ascontiguousarray(block[:, index])
        columns[dataset_name(path)] = column[:1].reshape(()) if variable.fixed_in_time else column
        write_column(dataset, dataset_name(path), columns[dataset_name(path)], describe(variable, index))
        slope = solution.slope(path) if variable.kind == "state" else None
        if slope is not None:
            columns[derivative_name(path)] = slope
            about = {"units": f"({variable.unit})/s", "role": DERIVATIVE}
            write_column(dataset, derivative_name(path), slope, about)
    return columns


def write_modes(dataset: netcdf_file, solution: Solution) -> dict[str, FloatArray]:
    """Put the truth values of relations into the dataset where there are any; return them by name."""
    if not solution.modes.size:
        return {}
    dataset.createDimension(RELATION, solution.modes.shape[1])
    dataset.createVariable(RELATIONS, "i1", (TIME, RELATION)).data[...] = solution.modes
    return {RELATIONS: solution.modes}


def write_column(dataset: netcdf_file, name: str, values: FloatArray, about: Said) -> None:
    """Put one variable into the dataset: a scalar where its values have no dimension."""
    variable = dataset.createVariable(on_wire(name), "f8", (TIME,) if values.ndim else ())
    variable.data[...] = values
    for key, value in about.items():
        setattr(variable, key, value.encode() if isinstance(value, str) else np.float64(value))


def describe(variable: Variable, order: int) -> dict[str, str | float]:
    """What the file says of a variable; empty texts are left out."""
    said: dict[str, str | float] = {
        "units": variable.unit,
        "long_name": variable.description or variable.path,
        "path": variable.path,
        "role": VARIABLE,
        "kind": variable.kind,
        "order": float(order),
        "sign": variable.sign,
    }
    optional = {
        "description": variable.description,
        "display_units": variable.display,
        "state": variable.state,
    }
    return said | {key: value for key, value in optional.items() if value}


def write_run(dataset: netcdf_file, solution: Solution, digest: str) -> None:
    """Put how the solution came about into the file's own attributes."""
    run = solution.run
    said: dict[str, str | float] = {"format": FORMAT, "title": f"{run.model}: {run.description}".strip(": ")}
    said |= {name: getattr(run, name) for name in TEXT_ATTRIBUTES}
    said |= {"start_time": float(run.start_time), "stop_time": float(run.stop_time)}
    said |= {name: to_json(getattr(run, name)) for name in JSON_ATTRIBUTES}
    said |= {f"{name}{VERSION}": version for name, version in solution.versions.items()}
    said["checksum"] = digest
    for key, value in said.items():
        setattr(dataset, key, value.encode() if isinstance(value, str) else np.float64(value))


def derivative_name(state: str) -> str:
    """Name of a state's derivative in the file; no path has this form."""
    return f"derivative of {state}"


def on_wire(name: str) -> str:
    """The name as its UTF-8 bytes, each a character, which is what SciPy's writer takes."""
    return name.encode().decode("latin-1")


def checksum(columns: Mapping[str, FloatArray]) -> str:
    """CRC-32 over names and values, in the order of the names."""
    digest = 0
    for name in sorted(columns):
        digest = zlib.crc32(name.encode(), digest)
        digest = zlib.crc32(np.ascontiguousarray(columns[name], dtype="<f8").tobytes(), digest)
    return f"{digest:08x}"
