"""One thread for NumPy's linear algebra: on matrices of some hundred rows more threads only wait for each other."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any


@cache
def _pools() -> Any:
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()  # of the libraries that are loaded by now: NumPy's


@contextmanager
def one_thread() -> Iterator[None]:
    """Within this context, and within functions that it decorates, BLAS computes in one thread."""
    with _pools().limit(limits=1, user_api="blas"):
        yield
