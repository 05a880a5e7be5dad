"""The directory of a sweep: a table with a row for each run (Parquet), trajectories (Zarr), and what was asked for.

    DIR/sweep.json            the specification, versions, columns and units
    DIR/runs.parquet          one row a run
    DIR/journal.jsonl         rows that are not in the table yet, one a line with its checksum
    DIR/trajectories.zarr     array (run, variable, time), one chunk a run

A run counts when its line in the journal is whole. Its trajectory was written before; files are replaced by renaming.
So whatever moment a process is killed at, or a disk fills up, what was there stays whole.
"""

from __future__ import annotations

import io
import itertools
import json
import math
import os
import zlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.errors import ResultError, UsageError
from arthur_acausal.result.atomic import write_atomically
from arthur_acausal.sweep.execute import COUNTS

if TYPE_CHECKING:
    import pandas

ABOUT, TABLE, JOURNAL, TRAJECTORIES = "sweep.json", "runs.parquet", "journal.jsonl", "trajectories.zarr"
FOLD_AT = 20_000  # rows in the journal after which it is folded into the table
AT_A_TIME = 500  # rows that are made part of a table at once: as dictionaries they take ten times the memory
Row = dict[str, Any]
BEFORE = "end_time"  # the column behind which reductions stand
# Columns behind the reductions, which a failed run has none of.
LAST = (*COUNTS, "notes", "attempts", "wall_s", "cpu_s", "engine", "platform")


class Store:
    """The results of one sweep, for one writing process, which holds the directory's lock.

    Attributes
    ----------
    folder : the directory.
    about : what `sweep.json` says.
    """

    def __init__(self, folder: Path, about: Mapping[str, Any]) -> None:
        self.folder, self.about = folder, about
        self._journal: io.BufferedWriter | None = None
        self._rows_in_journal = 0
        self._array: Any = None

    # --- beginning

    @classmethod
    def create(cls, folder: Path, about: Mapping[str, Any]) -> Store:
        """Make a directory, which must be new or empty but for a lock."""
        make_folder(folder)
        if any(name for name in os.listdir(folder) if not name.startswith((".", "lock"))):
            raise UsageError(
                f"{folder} is not empty", remedy="--resume goes on with a sweep; else name another directory"
            )
        write_atomically(folder / ABOUT, _json(about))
        return cls(folder, about)

    @classmethod
    def existing(cls, folder: Path) -> Store:
        """Open a directory for reading, or to go on with it."""
        return cls(folder, read_about(folder))

    def describe(self, about: Mapping[str, Any]) -> None:
        """Replace what `sweep.json` says."""
        write_atomically(self.folder / ABOUT, _json(about))
        self.about = about

    # --- writing

    def add(self, row: Row, trajectory: NDArray[np.float64] | None, number: int) -> None:
        """Keep one run: its trajectory (times, variables) first, then its row, which makes it count.

        Raises ResultError where that cannot be written; what is there stays whole.
        """
        try:
            if trajectory is not None:
                self._trajectories()[number] = trajectory.T
            self._append(row)
        except OSError as error:
            raise self._cannot(error) from error
        if self._rows_in_journal >= FOLD_AT:
            self.fold()

    def _append(self, row: Row) -> None:
        """Add a line; where it cannot be written whole, remove the part again."""
        if self._journal is None:
            path = self.folder / JOURNAL
            _cut_torn_line(path)
            self._journal = path.open("ab", buffering=0)  # type: ignore[assignment]
        assert self._journal is not None
        text = json.dumps(_plain(row), ensure_ascii=False).encode()
        line = b"%08x %s\n" % (zlib.crc32(text), text)
        before = os.fstat(self._journal.fileno()).st_size
        try:
            if self._journal.write(line) != len(line):
                raise OSError(28, "No space left on device")
        except OSError:
            os.ftruncate(self._journal.fileno(), before)
            raise
        self._rows_in_journal += 1

    def fold(self) -> None:
        """Put the journal's rows into the table, and empty it."""
        frame = table(self.folder)
        if frame is None or not (self.folder / JOURNAL).exists():
            return
        write_table(self.folder, frame)
        self.close()
        try:
            (self.folder / JOURNAL).unlink()
        except OSError as error:
            raise self._cannot(error) from error
        self._rows_in_journal = 0

    def close(self) -> None:
        """Close the journal."""
        if self._journal is not None:
            self._journal.close()
            self._journal = None

    def _trajectories(self) -> Any:
        if self._array is None:
            self._array = open_trajectories(self.folder, self.about, write=True)
        return self._array

    def _cannot(self, error: OSError) -> ResultError:
        return ResultError(
            f"cannot write in {self.folder}",
            cause=error.strerror or str(error),
            remedy="the runs so far are kept; free space and go on with --resume",
        )


def make_folder(folder: Path) -> None:
    """Make a directory unless it is there. Raises ResultError where that fails."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ResultError(f"cannot make {folder}", cause=error.strerror or str(error)) from None


def read_about(folder: Path) -> dict[str, Any]:
    """Return what a sweep's directory says of itself. Raises ResultError where there is none."""
    path = folder / ABOUT
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise ResultError(f"{folder} holds no sweep", cause=f"there is no {ABOUT}") from None
    except (OSError, ValueError) as error:
        raise ResultError(f"{path} cannot be read", cause=str(error)) from None
    if not isinstance(found, dict) or "specification" not in found:
        raise ResultError(f"{path} is no sweep's")
    return found


def journal(folder: Path) -> Iterator[Row]:
    """Yield the journal's rows, without lines that are torn or damaged."""
    try:
        with (folder / JOURNAL).open("rb") as lines:
            yield from (
                row for line in lines if line[-1:] == b"\n" and (row := _read_line(line[:-1])) is not None
            )
    except FileNotFoundError:
        return


def table(folder: Path) -> pandas.DataFrame | None:
    """Return the rows of all runs so far in the order of their numbers, None where there is none; the latest counts."""
    import pandas as pd

    path = folder / TABLE
    parts = []
    if path.exists():
        try:
            parts.append(pd.read_parquet(path))
        except Exception as error:  # pyarrow has its own classes for damaged files
            raise ResultError(f"{path} cannot be read", cause=str(error)) from None
    rows = journal(folder)
    while some := list(itertools.islice(rows, AT_A_TIME)):
        parts.append(pd.DataFrame(some))
    if not parts:
        return None
    frame: Any = parts[0] if len(parts) == 1 else pd.concat(parts, ignore_index=True)
    frame = frame.drop_duplicates("run", keep="last").sort_values("run", kind="stable")
    last = [name for name in LAST if name in frame]
    return frame[[*(name for name in frame if name not in last), *last]].reset_index(drop=True)


def write_table(folder: Path, frame: pandas.DataFrame) -> None:
    """Write the table whole."""
    buffer = io.BytesIO()
    frame.to_parquet(buffer, index=False)
    write_atomically(folder / TABLE, buffer.getvalue())


def open_trajectories(folder: Path, about: Mapping[str, Any], *, write: bool = False) -> Any:
    """Return the Zarr array (run, variable, time), made or made larger where it is to be written."""
    import zarr

    path, part = folder / TRAJECTORIES, folder / f".{TRAJECTORIES}.part"
    kept: Mapping[str, Any] = about["trajectories"]
    shape = (int(about["runs"]), len(kept["variables"]), len(kept["time"]))
    if not path.exists():
        if not write:
            raise ResultError(f"{folder} holds no trajectories")
        group = zarr.open_group(part, mode="w")
        group.create_array(
            "time", data=np.array(kept["time"]), dimension_names=("time",), attributes={"units": "s"}
        )
        group.create_array(
            "trajectory",
            shape=shape,
            chunks=(1, *(max(1, n) for n in shape[1:])),
            chunk_key_encoding={"name": "default", "separator": "."},  # a file a run, and no folders of it
            dtype="float64",
            fill_value=math.nan,
            dimension_names=("run", "variable", "time"),
            attributes={"variables": list(kept["variables"]), "units": list(kept["units"])},
        )
        os.rename(part, path)  # it is there whole or not at all
    array: Any = zarr.open_group(path, mode="r+" if write else "r")["trajectory"]
    if write and array.shape[0] < shape[0]:
        array.resize(shape)
    return array


def done(folder: Path) -> dict[int, str]:
    """Return the status of each run that counts, by its number."""
    frame = table(folder)
    if frame is None:
        return {}
    return dict(zip(frame["run"].astype(int).tolist(), frame["status"].tolist(), strict=True))


def _cut_torn_line(path: Path) -> None:
    """Remove what a killed process left behind the last whole line."""
    if not path.exists():
        return
    content = path.read_bytes()
    whole = content.rfind(b"\n") + 1
    if whole < len(content):
        os.truncate(path, whole)


def _read_line(line: bytes) -> Row | None:
    checksum, _, text = line.partition(b" ")
    try:
        if int(checksum, 16) != zlib.crc32(text):
            return None
        row = json.loads(text)
    except ValueError:
        return None
    return row if isinstance(row, dict) else None


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, np.generic):
        return value.item()
    return value


def _json(value: Mapping[str, Any]) -> bytes:
    return json.dumps(value, indent=1, ensure_ascii=False).encode()
