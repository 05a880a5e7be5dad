"""MuJoCo itself, imported when it is first used. It ships no types."""

from __future__ import annotations

import logging
from functools import cache
from importlib import import_module
from typing import Any, TypeAlias

MjModel: TypeAlias = Any
MjData: TypeAlias = Any


@cache
def mujoco() -> Any:
    """Return the module ``mujoco``.

    Its warnings go to the logger "mujoco", unless the program has a handler of its own: MuJoCo would write them into
    a file in the working folder. What they mean for a run is taken from its counters.
    """
    module: Any = import_module("mujoco")
    if module.get_mju_user_warning() is None:
        module.set_mju_user_warning(logging.getLogger("mujoco").info)
    return module
