"""Shards of one sweep, run apart, put together into one directory."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from pathlib import Path

from arthur_acausal.errors import UsageError
from arthur_acausal.sweep import store as stores
from arthur_acausal.sweep.lock import Lock
from arthur_acausal.sweep.specification import differences
from arthur_acausal.sweep.store import Store

OF_THE_MACHINE = ("attempts", "wall_s", "cpu_s")


def merge(folders: Sequence[Path], target: Path) -> int:
    """Copy the runs of several directories of the same specification into ``target``; return how many it has then.

    Raises UsageError where the specifications differ, or a run is there twice with different results.
    """
    abouts = [stores.read_about(folder) for folder in folders]
    for folder, about in zip(folders[1:], abouts[1:], strict=True):
        found = differences(abouts[0]["specification"], about["specification"])
        if found:
            raise UsageError(
                f"{folder} is no shard of the same sweep as {folders[0]}", cause="; ".join(found)
            )
    stores.make_folder(target)
    with Lock(target):
        fresh = not (target / stores.ABOUT).exists()
        store = Store.create(target, abouts[0]) if fresh else Store.existing(target)
        found = differences(store.about["specification"], abouts[0]["specification"])
        if found:
            raise UsageError(f"{target} holds another sweep", cause="; ".join(found))
        with closing(store):
            for folder, about in zip(folders, abouts, strict=True):
                _copy(folder, about, store)
            store.fold()
        return len(stores.done(target))


def _copy(folder: Path, about: dict[str, object], store: Store) -> None:
    present = {int(row["run"]): row for row in _rows(store.folder)}
    has_trajectories = (folder / stores.TRAJECTORIES).exists()
    array = stores.open_trajectories(folder, about) if has_trajectories else None
    for row in _rows(folder):
        number = int(row["run"])
        if number in present:
            if changed := _different(present[number], row):
                raise UsageError(
                    f"run {number} of {folder} has other results than the one that is in {store.folder} already",
                    cause=f"{', '.join(changed)} differ",
                    remedy="run both with the same versions on the same platform",
                )
            continue
        trajectory = None if array is None or row["status"] == "crashed" else array[number].T
        store.add(row, trajectory, number)


def _rows(folder: Path) -> list[stores.Row]:
    frame = stores.table(folder)
    rows = [] if frame is None else frame.to_dict("records")
    return [{str(name): value for name, value in row.items()} for row in rows]


def _different(one: stores.Row, other: stores.Row) -> list[str]:
    """Return the columns in which two rows of one run differ, apart from what the machine's load makes of them."""
    names = [name for name in {**one, **other} if name not in OF_THE_MACHINE]
    return [name for name in names if not _same(one.get(name), other.get(name))]


def _same(a: object, b: object) -> bool:
    return a == b or (_missing(a) and _missing(b))


def _missing(value: object) -> bool:
    return value is None or value != value  # NaN
