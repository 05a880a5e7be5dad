"""Writing pictures as films."""

from __future__ import annotations

import io
from collections.abc import Iterator
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from arthur_acausal import UsageError
from arthur_acausal.mujoco.offscreen import Image
from arthur_acausal.result.atomic import check_place, write_atomically
from arthur_acausal.result.plot import write

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FORMATS = ("mp4", "gif", "png")
GIF_TICK = 0.01  # s: durations of its frames are multiples of it


def check_writer(file: str | Path) -> str:
    """Return the format that a file's name asks for. Raises UsageError where it cannot be written here."""
    kind = Path(file).suffix.lower().removeprefix(".")
    if kind not in FORMATS:
        raise UsageError(
            f"cannot write {file}",
            cause=f"films are not written as {kind!r}" if kind else "its name has no ending",
            remedy="end the name in .mp4 or .gif (films), or .png (a film strip)",
        )
    if kind == "mp4" and find_spec("av") is None:
        raise UsageError(
            f"cannot write {file}",
            cause="the package av, which encodes films, is not installed",
            remedy='install it (pip install "arthur-acausal[video]"), or write a .gif',
        )
    check_place(file)
    return kind


def write_picture(file: str | Path, figure: Figure) -> None:
    """Write a film strip."""
    write(figure, file)


def write_movie(file: str | Path, kind: str, images: Iterator[Image], fps: float) -> None:
    """Write a film whole or not at all."""
    write_atomically(file, _mp4(images, fps) if kind == "mp4" else _gif(images, fps))


def _gif(images: Iterator[Image], fps: float) -> bytes:
    from PIL.Image import fromarray

    first, *others = (fromarray(image) for image in images)
    buffer = io.BytesIO()
    ticks = max(2, round(1.0 / fps / GIF_TICK))  # viewers slow down what is faster
    duration = round(1000 * GIF_TICK * ticks)
    first.save(buffer, format="gif", save_all=True, append_images=others, duration=duration, loop=0)
    return buffer.getvalue()


def _mp4(images: Iterator[Image], fps: float) -> bytes:
    import av

    buffer = io.BytesIO()
    with av.open(buffer, "w", format="mp4") as container:
        stream = container.add_stream("libx264", rate=Fraction(fps).limit_denominator(1001))
        stream.pix_fmt = "yuv420p"
        for image in images:
            even = image[
                : image.shape[0] // 2 * 2, : image.shape[1] // 2 * 2
            ]  # the format halves the colours
            if not stream.codec_context.is_open:
                stream.height, stream.width = even.shape[:2]
            container.mux(stream.encode(av.VideoFrame.from_ndarray(even, format="rgb24")))
        container.mux(stream.encode())
    return buffer.getvalue()
