"""How a worker process starts: on its own, without this one's script and with one thread for numeric libraries."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager

from arthur_acausal.request.locate import FOLDERS

_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMEXPR_NUM_THREADS")


@contextmanager
def apart() -> Iterator[None]:
    """Processes that are spawned in here do not import the main script, which thus needs no guard, and do not
    crowd the cores. What stands beside a model's file cannot hide modules that they begin with.
    """
    main = sys.modules["__main__"]
    told: dict[str, object] = {
        name: vars(main)[name] for name in ("__file__", "__spec__") if name in vars(main)
    }
    before = {name: os.environ.get(name) for name in _THREADS}
    os.environ.update(dict.fromkeys(_THREADS, "1"))
    path = sys.path[:]
    sys.path[:] = [folder for folder in path if folder not in FOLDERS]
    vars(main).pop("__file__", None)
    vars(main)["__spec__"] = None
    try:
        yield
    finally:
        sys.path[:] = path
        vars(main).update(told)
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
