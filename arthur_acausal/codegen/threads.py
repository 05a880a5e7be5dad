"""One thread for the linear algebra of NumPy and SciPy: on some hundred rows more threads only wait for each other."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from importlib import import_module
from typing import Any


@cache
def _pools(scipy: bool) -> Any:
    """Return the libraries that are loaded by now: NumPy's, and SciPy's, which has one of its own."""
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()


@contextmanager
def one_thread(*, scipy: bool = False) -> Iterator[None]:
    """Within this context, and within functions that it decorates, BLAS computes in one thread.

    ``scipy`` : SciPy's, too, even if it is not loaded yet.
    """
    if scipy:
        import_module("scipy.linalg")
    with _pools("scipy.linalg" in sys.modules).limit(limits=1, user_api="blas"):
        yield
