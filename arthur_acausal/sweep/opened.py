"""The results of a sweep: a table, and an xarray Dataset of the trajectories over run and time."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from arthur_acausal.sweep import store
from arthur_acausal.sweep.specification import Specification, from_mapping

if TYPE_CHECKING:
    import pandas
    import xarray


@dataclass(frozen=True)
class Sweep:
    """What is in a sweep's directory.

    Attributes
    ----------
    folder : the directory.
    """

    folder: Path

    @cached_property
    def about(self) -> dict[str, Any]:
        """What `sweep.json` says."""
        return store.read_about(self.folder)

    @cached_property
    def specification(self) -> Specification:
        """What was asked for."""
        return from_mapping(self.about["specification"], store.ABOUT)

    @cached_property
    def table(self) -> pandas.DataFrame:
        """One row a run: what varies, status, reductions, statistics, error; by the number of the run."""
        import pandas as pd

        found = store.table(self.folder)
        return pd.DataFrame({"run": [], "status": []}) if found is None else found

    @property
    def factors(self) -> list[str]:
        """Columns of what varies."""
        return [name for name in self.about["factors"] if name in self.table]

    @property
    def reductions(self) -> list[str]:
        """Columns of reductions."""
        names = [name for name in self.table.columns if name not in store.LAST]
        return names[names.index(store.BEFORE) + 1 :] if store.BEFORE in names else []

    @cached_property
    def dataset(self) -> xarray.Dataset:
        """The trajectories (run, time) by path, read when they are used, and the table's columns over ``run``."""
        import xarray as xr

        frame = self.table
        numbers = frame["run"].to_numpy(dtype=np.int64)
        columns = {
            name: ("run", frame[name].to_numpy(), {"units": self.about["units"].get(name, "")})
            for name in frame.columns
            if name != "run"
        }
        kept = self.about["trajectories"]
        dataset = xr.Dataset(coords={"run": numbers, "time": ("time", kept["time"], {"units": "s"})})
        if kept["variables"] and (self.folder / store.TRAJECTORIES).exists():
            whole = xr.open_zarr(self.folder / store.TRAJECTORIES, consolidated=False, chunks=None)
            array = whole["trajectory"].isel(run=numbers)
            for k, (path, unit) in enumerate(zip(kept["variables"], kept["units"], strict=True)):
                dataset[path] = array.isel(variable=k, drop=True).assign_attrs(units=unit)
        names = {name: column for name, column in columns.items() if name not in dataset}
        return dataset.assign_coords({name: names[name] for name in self.factors if name in names}).assign(
            {name: column for name, column in names.items() if name not in self.factors}
        )


def open_sweep(folder: str | os.PathLike[str]) -> Sweep:
    """Open a sweep's directory, also while it is being filled. Raises ResultError where there is none."""
    sweep = Sweep(Path(folder))
    _ = sweep.about
    return sweep
