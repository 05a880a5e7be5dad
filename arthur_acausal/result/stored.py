"""Reading solutions back from NetCDF files, without the model."""

from __future__ import annotations

import io
import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, cast, get_args

import numpy as np

from arthur_acausal.errors import ResultError
from arthur_acausal.result.interpolate import FloatArray
from arthur_acausal.result.run import Run
from arthur_acausal.result.solution import Solution
from arthur_acausal.result.store import (
    FORMAT,
    RELATIONS,
    TEXT_ATTRIBUTES,
    VARIABLE,
    VERSION,
    checksum,
    derivative_name,
)
from arthur_acausal.result.variable import TIME, Kind, Variable, dataset_name
from arthur_acausal.solve.trajectory import Event

if TYPE_CHECKING:
    from scipy.io import netcdf_file


REMEDY = "name a file that `arthur simulate -o` or Solution.save wrote"


class StoredValues:
    """Values out of a file, all in memory, by their names there; see `Values`."""

    def __init__(self, columns: Mapping[str, FloatArray], variables: Mapping[str, Variable]) -> None:
        self._columns = columns
        self.variables = variables
        self.t: FloatArray = columns[TIME]
        self.modes: FloatArray = columns.get(RELATIONS, np.empty((self.t.size, 0)))

    def observe(self, paths: Sequence[str]) -> FloatArray:
        """Values (nt, len(paths)); what is fixed in time is repeated."""
        block = np.empty((self.t.size, len(paths)))
        for index, path in enumerate(paths):
            block[:, index] = self._columns[dataset_name(path)]
        return block

    def slope(self, state: str) -> FloatArray | None:
        """dx/dt (nt,) of a state where the file has it."""
        return self._columns.get(derivative_name(state))


def load(file: str | os.PathLike[str]) -> Solution:
    """Read a solution that `save` wrote.

    Raises ResultError where the file is missing, is damaged, or is not such a file.
    """
    path = Path(file)
    try:
        content = path.read_bytes()
    except OSError as error:
        raise ResultError(f"cannot read {path}", cause=error.strerror or str(error)) from error
    dataset = parse(path, content)
    try:
        columns = {from_wire(name): native(variable.data) for name, variable in dataset.variables.items()}
        values = StoredValues(columns, read_variables(dataset))
        run = read_run(dataset)
        stated = text(dataset, "checksum")
    except (KeyError, ValueError, TypeError, AttributeError) as error:
        raise damaged(path, f"{type(error).__name__}: {error}") from error
    if checksum(columns) != stated:
        raise damaged(path, "its values do not have the checksum that they were written with")
    return Solution(values, run)


def parse(path: Path, content: bytes) -> netcdf_file:
    """Read the NetCDF structure and see that it is one of ours."""
    from scipy.io import netcdf_file

    if content[:3] != b"CDF":
        what = "an HDF5 or NetCDF-4 file" if content[1:4] == b"HDF" else "not a NetCDF file"
        raise ResultError(f"{path} is no solution: it is {what}", remedy=REMEDY)
    try:
        dataset = netcdf_file(io.BytesIO(content), "r", mmap=False)
        found = text(dataset, "format") if hasattr(dataset, "format") else ""
    except Exception as error:  # SciPy's reader checks nothing: a damaged header raises whatever it runs into
        raise damaged(path, f"{type(error).__name__}: {error}") from error
    if found != FORMAT:
        raise ResultError(
            f"{path} is a NetCDF file, but no solution of this version",
            cause=f"its format is {found!r}, not {FORMAT!r}",
            remedy=REMEDY,
        )
    return dataset


def damaged(path: Path, cause: str) -> ResultError:
    """The error for a file that cannot be trusted."""
    return ResultError(f"{path} is damaged", cause=cause, remedy="simulate again, or take a copy of the file")


def read_variables(dataset: Any) -> dict[str, Variable]:
    """What the file says of the model's variables, by path, in the model's order."""
    ours = [v for v in dataset.variables.values() if getattr(v, "role", b"") == VARIABLE.encode()]
    found = [read_variable(variable) for variable in sorted(ours, key=lambda variable: float(variable.order))]
    return {variable.path: variable for variable in found}


def read_variable(stored: Any) -> Variable:
    """What the file says of one variable."""
    kind = text(stored, "kind")
    if kind not in get_args(Kind):
        raise ValueError(f"unknown kind {kind!r}")
    return Variable(
        path=text(stored, "path"),
        unit=text(stored, "units"),
        kind=cast(Kind, kind),
        description=text(stored, "description", ""),
        display=text(stored, "display_units", ""),
        state=text(stored, "state", ""),
        sign=float(stored.sign),
    )


def read_run(dataset: Any) -> Run:
    """How the solution came about."""
    written = {name: text(dataset, name) for name in TEXT_ATTRIBUTES}
    attributes = [name for name in vars(dataset) if name.endswith(VERSION)]
    return Run(
        **written,
        start_time=float(dataset.start_time),
        stop_time=float(dataset.stop_time),
        parameters=json.loads(text(dataset, "parameters")),
        inputs=json.loads(text(dataset, "inputs")),
        start=json.loads(text(dataset, "start")),
        options=namespace(json.loads(text(dataset, "options"))),
        statistics=namespace(json.loads(text(dataset, "statistics"))),
        events=tuple(Event(**event) for event in json.loads(text(dataset, "events"))),
        audit=json.loads(text(dataset, "audit")),
        externals=json.loads(text(dataset, "externals", "[]")),
        beside=json.loads(text(dataset, "beside", "{}")),
        versions={name.removesuffix(VERSION): text(dataset, name) for name in attributes},
    )


def text(holder: Any, name: str, default: str | None = None) -> str:
    """A text attribute of the file or of a variable in it."""
    value = getattr(holder, name) if default is None else getattr(holder, name, default)
    return value.decode() if isinstance(value, bytes) else str(value)


def native(data: Any) -> FloatArray:
    """Big-endian file data as an ordinary array."""
    return np.ascontiguousarray(data, dtype=np.float64).reshape(np.shape(data))


def from_wire(name: str) -> str:
    """A name as people write it, from its UTF-8 bytes."""
    return name.encode("latin-1").decode()


def namespace(value: Any) -> Any:
    """A dictionary from a file with its entries as attributes, as the dataclass had that was written."""
    return SimpleNamespace(**value) if isinstance(value, dict) else value
