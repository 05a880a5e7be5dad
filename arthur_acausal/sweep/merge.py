"""Shards of one sweep, run apart, put together into one directory."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from arthur_acausal.errors import UsageError
from arthur_acausal.sweep import store as stores
from arthur_acausal.sweep.lock import Lock
from arthur_acausal.sweep.specification import differences
from arthur_acausal.sweep.store import Store


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
        for folder, about in zip(folders, abouts, strict=True):
            _copy(folder, about, store)
        store.fold()
        store.close()
        return len(stores.done(target))


def _copy(folder: Path, about: dict[str, object], store: Store) -> None:
    frame = stores.table(folder)
    if frame is None:
        return
    present = stores.done(store.folder)
    has_trajectories = (folder / stores.TRAJECTORIES).exists()
    array = stores.open_trajectories(folder, about) if has_trajectories else None
    for row in frame.to_dict("records"):
        number = int(row["run"])
        if number in present:
            continue
        trajectory = None if array is None or row["status"] == "crashed" else array[number].T
        store.add({str(name): value for name, value in row.items()}, trajectory, number)
