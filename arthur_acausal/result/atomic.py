"""Writing a file whole or not at all."""

from __future__ import annotations

import contextlib
import os
import secrets
from pathlib import Path

from arthur_acausal.errors import ResultError


def write_atomically(file: str | os.PathLike[str], content: bytes) -> None:
    """Write a file beside its place and move it there: it is the old one or the new one, never a part.

    Raises ResultError where that fails; what stood there before is then as it was.
    """
    path = check_place(file)
    temporary = path.with_name(f".{path.name[:100]}.{secrets.token_hex(6)}.part")
    try:
        with open(temporary, "xb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        if path.exists():
            os.chmod(temporary, path.stat().st_mode & 0o777)
        os.replace(temporary, path)
    except OSError as error:
        raise ResultError(
            f"cannot write {file} ({len(content) / 1e6:.1f} MB)",
            cause=error.strerror or str(error),
            remedy="nothing was changed there; free space or name another place",
        ) from error
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink()


def check_place(file: str | os.PathLike[str]) -> Path:
    """Return where a file would be written, through a link: the file that it means.

    Raises ResultError where it cannot be a file: a folder, a device, or in a folder that is none.
    """
    path = Path(os.path.realpath(file))
    if path.exists() and not path.is_file():
        what = "a folder" if path.is_dir() else "not a regular file"
        raise ResultError(f"cannot write {file}", cause=f"it is {what}", remedy="name a file")
    if not path.parent.is_dir():
        raise ResultError(
            f"cannot write {file}", cause=f"there is no folder {path.parent}", remedy="make it first"
        )
    return path
