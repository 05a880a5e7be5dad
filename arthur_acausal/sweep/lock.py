"""One sweep at a time in a directory, told by a file that only one process can make; no locks of the file system."""

from __future__ import annotations

import contextlib
import json
import os
import secrets
import socket
import threading
from pathlib import Path
from types import TracebackType

from arthur_acausal.errors import ResultError, UsageError

NAME = "lock.json"
HEARTBEAT = 5.0  # s between signs of life
SILENCE = 60.0  # s without one after which a process on another machine counts as dead


class Lock:
    """Held while in the ``with`` block. Raises UsageError where another sweep is at work there.

    A lock whose process is gone is taken over: on the same machine by its number and time of start, from another
    machine after `SILENCE`. Creating a file exclusively is atomic on every file system, those of networks included.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / NAME
        self._token = secrets.token_hex(8)
        self._done = threading.Event()

    def __enter__(self) -> Lock:
        for _ in range(3):  # another process may take over at the same moment
            if self._create():
                threading.Thread(target=self._beat, daemon=True).start()
                return self
            owner = self._owner()
            if owner is not None and self._alive(owner):
                raise UsageError(
                    f"another sweep is at work in {self._path.parent}",
                    cause=f"process {owner.get('pid')} on {owner.get('host')}",
                    remedy="wait for it, or name another directory",
                )
            self._remove_dead(owner)
        raise UsageError(
            f"another sweep has just begun in {self._path.parent}", remedy="name another directory"
        )

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._done.set()
        owner = self._owner()
        if owner is not None and owner.get("token") == self._token:
            with contextlib.suppress(OSError):
                self._path.unlink()

    def _create(self) -> bool:
        content = {
            "host": socket.gethostname(),
            "pid": os.getpid(),
            "born": _born(os.getpid()),
            "token": self._token,
        }
        try:
            with self._path.open("x", encoding="utf-8") as stream:
                json.dump(content, stream)
                stream.flush()
                os.fsync(stream.fileno())
        except FileExistsError:
            return False
        except OSError as error:
            with contextlib.suppress(OSError):
                self._path.unlink()
            raise ResultError(f"cannot write in {self._path.parent}", cause=error.strerror or "") from None
        return True

    def _owner(self) -> dict[str, object] | None:
        """Return what the lock says; an empty one is being written, or was left by a process that died meanwhile."""
        try:
            found = json.loads(self._path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            return None
        except (OSError, ValueError):
            return {}
        return found if isinstance(found, dict) else {}

    def _alive(self, owner: dict[str, object]) -> bool:
        if owner.get("host") == socket.gethostname():
            born = _born(int(str(owner.get("pid", -1))))
            return born is not None and born == owner.get("born")
        return self._age() < (SILENCE if owner else HEARTBEAT)

    def _age(self) -> float:
        """Return how long ago the lock was touched [s], by the clock of the file system itself."""
        probe = self._path.with_name(f".{secrets.token_hex(6)}.clock")
        try:
            probe.touch()
            return probe.stat().st_mtime - self._path.stat().st_mtime
        except OSError:
            return 0.0
        finally:
            with contextlib.suppress(OSError):
                probe.unlink()

    def _remove_dead(self, owner: dict[str, object] | None) -> None:
        """Move the dead lock away under a name of our own: of two processes only one succeeds with the same file."""
        if owner is None:
            return
        aside = self._path.with_name(f".{self._token}.dead")
        with contextlib.suppress(OSError):
            os.rename(self._path, aside)
            moved = json.loads(aside.read_text(encoding="utf-8") or "{}")
            if moved != owner and self._alive(moved):  # it was renewed between reading and renaming
                os.link(aside, self._path)
        with contextlib.suppress(OSError, ValueError):
            aside.unlink()

    def _beat(self) -> None:
        while not self._done.wait(HEARTBEAT):
            with contextlib.suppress(OSError):
                os.utime(self._path)


def _born(pid: int) -> float | None:
    """Return when a process started, so that a number used again is not taken for it; None if there is none."""
    import psutil

    try:
        return float(psutil.Process(pid).create_time())
    except (psutil.NoSuchProcess, ValueError):
        return None  # what is there but cannot be asked raises: it is no dead process
