"""IDA's messages, which its Python binding prints on standard output, kept from there."""

from __future__ import annotations

import io
import re
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TextIO

_MESSAGE = re.compile(r"\n?\[(IDA|SUN)")


class _Filter(io.TextIOBase):
    """Stands for standard output while a thread integrates; keeps IDA's messages and lets everything else through."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._users = 0
        self._before: TextIO = sys.stdout
        self._local = threading.local()

    def enter(self) -> list[str]:
        """Collect this thread's messages from now on."""
        with self._lock:
            if not self._users:
                self._before, sys.stdout = sys.stdout, self
            self._users += 1
        self._local.parts = []
        self._local.open = False
        return self._local.parts  # type: ignore[no-any-return]

    def leave(self) -> None:
        """This thread is done; the last one gives standard output back."""
        self._local.parts = None
        with self._lock:
            self._users -= 1
            if not self._users and sys.stdout is self:
                sys.stdout = self._before

    def write(self, text: str) -> int:
        parts = getattr(self._local, "parts", None)
        if parts is not None and (_MESSAGE.match(text) or (self._local.open and text == "\n")):
            self._local.open = text != "\n"  # print writes the end of its line separately
            parts.append(text)
            return len(text)
        return self._before.write(text)

    def flush(self) -> None:
        self._before.flush()


_FILTER = _Filter()


@contextmanager
def captured() -> Iterator[list[str]]:
    """Collect what IDA prints in this thread."""
    parts = _FILTER.enter()
    try:
        yield parts
    finally:
        _FILTER.leave()


def text_of(parts: list[str]) -> str:
    """The messages as one line."""
    return " ".join("".join(parts).split())
