"""A solution as an xarray Dataset or a pandas DataFrame."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from arthur_acausal.result.variable import TIME, dataset_name

if TYPE_CHECKING:
    import pandas
    import xarray

    from arthur_acausal.result.solution import Solution


def to_xarray(solution: Solution, patterns: str | Iterable[str] | None = None) -> xarray.Dataset:
    """A Dataset over ``time``: each variable by path with units and long_name, parameters as scalars."""
    import xarray

    paths = solution.paths if patterns is None else solution.select(patterns)
    block = solution.values(paths)
    data = {}
    for index, path in enumerate(paths):
        variable = solution.variable(path)
        attributes = {"units": variable.unit, "long_name": variable.description or path}
        if variable.fixed_in_time:
            data[dataset_name(path)] = xarray.Variable((), block[0, index], attributes)
        else:
            data[dataset_name(path)] = xarray.Variable((TIME,), block[:, index], attributes)
    time = xarray.Variable((TIME,), solution.t, {"units": "s", "long_name": TIME})
    return xarray.Dataset(data, coords={TIME: time}, attrs={"model": solution.model})


def to_pandas(solution: Solution, patterns: str | Iterable[str] | None = None) -> pandas.DataFrame:
    """A DataFrame with index ``time`` and one column a path; ``frame.attrs["units"]`` has the units."""
    import pandas

    if patterns is None:
        paths = [path for path, variable in solution.variables.items() if not variable.fixed_in_time]
    else:
        paths = solution.select(patterns)
    index = pandas.Index(solution.t, name=TIME)
    frame = pandas.DataFrame(solution.values(paths), index=index, columns=pandas.Index(paths))
    frame.attrs["units"] = {path: solution.unit(path) for path in paths}
    return frame
