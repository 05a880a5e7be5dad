"""MuJoCo itself, imported when it is first used. It ships no types."""

from __future__ import annotations

from typing import Any, TypeAlias

MjModel: TypeAlias = Any
MjData: TypeAlias = Any


def mujoco() -> Any:
    """Return the module ``mujoco``."""
    import mujoco as module

    return module
