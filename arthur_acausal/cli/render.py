"""`arthur render`: a film of a run's rigid bodies."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from arthur_acausal.errors import UsageError


def render(
    file: Path,
    output: Path,
    *,
    body: str,
    camera: str,
    size: str,
    fps: float,
    speed: float,
    frames: int,
    shown: Sequence[str] | None,
) -> str:
    """Carry out ``arthur render``."""
    from arthur_acausal.render import View
    from arthur_acausal.render import render as carry_out
    from arthur_acausal.result.stored import load

    parts = re.fullmatch(r"(\d+)x(\d+)", size)
    if parts is None:
        raise UsageError(f"the size is {size!r}", remedy="give width and height in pixels: 640x480")
    pixels = int(parts[1]), int(parts[2])
    view = View(body, camera, pixels, fps, speed, frames, shown or None)
    carry_out(load(file), output, view)
    return f"wrote {output}"
