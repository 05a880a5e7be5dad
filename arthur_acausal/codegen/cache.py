"""A content-addressed cache on disk, shared by all processes of a user and safe under concurrent writers.

An entry is named by a key, the hash of everything that its content depends on, so that it never changes and
never becomes stale. Files appear by renaming, complete or not at all; a checksum finds what was damaged later.
Nothing is unpickled. A cache that cannot be written only costs time: it warns once, and work goes on without.
"""

from __future__ import annotations

import contextlib
import hashlib
import logging
import os
import platform
import shutil
import sys
import tempfile
import time
import weakref
from collections.abc import Callable
from functools import cache
from importlib import metadata
from pathlib import Path

import casadi
import platformdirs

LOGGER = logging.getLogger("arthur_acausal")
LIMIT = 1 << 30  # bytes
_DIGEST = 32  # bytes of a SHA-256 checksum, which stands before the content of an entry
_ABANDONED = 3600.0  # s, after which a temporary file has no living writer
_LIBRARY = ".dll" if sys.platform == "win32" else ".so"


def make_key(*parts: bytes | str) -> str:
    """Return the key of a content that depends on ``parts``, the platform and the versions of casadi and Arthur."""
    digest = hashlib.sha256()
    for part in (*_surroundings(), *parts):
        data = part.encode() if isinstance(part, str) else part
        digest.update(len(data).to_bytes(8, "little") + data)
    return digest.hexdigest()


@cache
def _surroundings() -> tuple[str, ...]:
    try:
        version = metadata.version("arthur-acausal")
    except metadata.PackageNotFoundError:  # used from its source, not installed
        version = ""
    return version, casadi.CasadiMeta.version(), sys.platform, platform.machine(), *platform.libc_ver()


class Cache:
    """The entries below one directory.

    Parameters
    ----------
    directory
        Created when first written to.
    limit
        Size in bytes above which the entries that were not used for longest are removed.
    """

    def __init__(self, directory: Path, limit: int = LIMIT) -> None:
        self.directory = directory
        self.limit = limit
        self._warned = False
        self._written = limit  # bytes since the last pruning; the first writing prunes
        self._refuge: Path | None = None  # where libraries go if the directory cannot be written

    def get(self, key: str) -> bytes | None:
        """Return the content of an entry, None when there is none or it is damaged (then it is removed)."""
        path = self.directory / key
        try:
            data = path.read_bytes()
        except FileNotFoundError:
            return None
        except OSError as error:
            self._warn("read", error)
            return None
        content = data[_DIGEST:]
        if hashlib.sha256(content).digest() != data[:_DIGEST]:
            LOGGER.warning("cache entry %s is damaged and will be made anew", path)
            _remove(path)
            return None
        _touch(path)
        return content

    def put(self, key: str, content: bytes) -> bool:
        """Store the content of an entry; return whether that succeeded."""
        try:
            self._publish(lambda path: path.write_bytes(hashlib.sha256(content).digest() + content), key)
        except OSError as error:
            self._warn("write", error)
            return False
        return True

    def path_of_library(self, key: str, build: Callable[[Path], None]) -> Path:
        """Return the path of a shared library, for which ``build`` writes it to the path it is given if need be.

        The library is checked against its checksum before, for to load a damaged one can end the process. What
        ``build`` raises passes through. If the cache cannot be written, the library lives as long as the cache object.
        """
        digest = self.get(key)
        if digest is not None:
            path = self._library(digest)
            if path is not None:
                return path
        with tempfile.TemporaryDirectory(prefix="arthur-") as scratch:
            built = Path(scratch, "library" + _LIBRARY)
            build(built)
            content = built.read_bytes()
        digest = hashlib.sha256(content).digest()
        name = digest.hex() + _LIBRARY
        try:
            self._publish(lambda path: path.write_bytes(content), name)
            if self.put(key, digest):
                return self.directory / name
        except OSError as error:
            self._warn("write", error)
        if self._refuge is None:
            self._refuge = Path(tempfile.mkdtemp(prefix="arthur-"))
            weakref.finalize(self, shutil.rmtree, self._refuge, ignore_errors=True)
        path = self._refuge / name
        path.write_bytes(content)
        return path

    def _library(self, digest: bytes) -> Path | None:
        """Return the path of the library with this checksum, None if it is absent or damaged."""
        path = self.directory / (digest.hex() + _LIBRARY)
        try:
            damaged = hashlib.sha256(path.read_bytes()).digest() != digest
        except OSError:
            return None
        if damaged:
            LOGGER.warning("cached library %s is damaged and will be built anew", path)
            _remove(path)
            return None
        _touch(path)
        return path

    def _publish(self, write: Callable[[Path], object], name: str) -> None:
        """Let ``write`` fill a temporary file and give it its name, in one step for whoever looks."""
        self.directory.mkdir(mode=0o700, parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(prefix=".new-", dir=self.directory)
        os.close(handle)
        try:
            write(Path(temporary))
            size = os.path.getsize(temporary)
            os.replace(temporary, self.directory / name)
        except BaseException:
            _remove(Path(temporary))
            raise
        self._written += size
        if self._written > self.limit // 16:
            self._written = 0
            self.prune()

    def prune(self) -> None:
        """Remove what was not used for longest until the size is within the limit, and abandoned files."""
        entries = []
        now = time.time()
        with os.scandir(self.directory) as files:
            for file in files:
                try:
                    status = file.stat(follow_symlinks=False)
                except OSError:  # another process removed it
                    continue
                if not file.name.startswith(".new-"):
                    entries.append((status.st_mtime, status.st_size, file.path))
                elif now - status.st_mtime > _ABANDONED:
                    _remove(Path(file.path))
        excess = sum(size for _, size, _ in entries) - self.limit
        for _, size, path in sorted(entries)[:-1]:  # the newest one stays, however large
            if excess <= 0:
                break
            _remove(Path(path))
            excess -= size

    def _warn(self, action: str, error: OSError) -> None:
        if not self._warned:
            self._warned = True
            LOGGER.warning("cannot %s the cache (%s); going on without it", action, str(error))


@cache
def _cache_at(directory: str) -> Cache:
    return Cache(Path(directory))


def default_cache() -> Cache:
    """Return the cache of this user; the environment variable ARTHUR_CACHE_DIR moves it."""
    return _cache_at(
        os.environ.get("ARTHUR_CACHE_DIR") or platformdirs.user_cache_dir("arthur-acausal", False)
    )


def _touch(path: Path) -> None:
    """Mark an entry as used now."""
    with contextlib.suppress(OSError):  # a cache that is read only is never pruned by us
        os.utime(path)


def _remove(path: Path) -> None:
    with contextlib.suppress(OSError):  # it is gone, in use (Windows), or the directory is read only
        path.unlink()
