"""A run of a MuJoCo body as pictures: the body, and beside it what the run says over time.

All that it takes is in the result: the body's model, which the run keeps as data, and the trajectories of its states.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from arthur_acausal import Solution, UsageError
from arthur_acausal.mujoco.acting import Acting
from arthur_acausal.mujoco.dynamics import FloatArray
from arthur_acausal.mujoco.offscreen import Image, canvas
from arthur_acausal.render.beside import Beside, Curves, Shown, strip
from arthur_acausal.render.movie import check_writer, write_movie, write_picture


@dataclass(frozen=True, slots=True)
class View:
    """How a film looks.

    Attributes
    ----------
    body : path of the body in the model, where there are several. camera : of the MJCF; default: one that follows.
    size : of the body's picture, pixels. fps : frames a second. speed : simulated over shown time; 0.2 is slow motion.
    frames : pictures of a film strip. shown : what is drawn beside the body, as for `Solution.plot`; default: what
        the model chooses. Contact forces are drawn in any case.
    """

    body: str = ""
    camera: str = ""
    size: tuple[int, int] = (640, 480)
    fps: float = 25.0
    speed: float = 1.0
    frames: int = 8
    shown: Shown | None = None

    def __post_init__(self) -> None:
        if min(*self.size, self.fps, self.speed, self.frames) <= 0:
            raise UsageError("size, fps, speed and frames of a film must be positive")


def render(solution: Solution, file: str | Path, view: View | None = None) -> None:
    """Write a film (.mp4, .gif) or a film strip (.png) of a run.

    Raises UsageError where this machine cannot draw or write it, ResultError where the run has no MuJoCo body.
    """
    view = View() if view is None else view
    kind = check_writer(file)
    acting = Acting(solution, view.body)
    begin, end = float(solution.t[0]), float(solution.t[-1])
    count = view.frames if kind == "png" else max(1, round((end - begin) * view.fps / view.speed))
    times = np.linspace(begin, end, count)
    curves = Curves(solution, solution.run.beside if view.shown is None else view.shown, *acting.forces())
    with canvas(acting.dynamics.model, view.size, view.camera) as drawing:
        images = (drawing.draw(acting.dynamics.data) for _ in acting.at(times))
        if kind == "png":
            write_picture(file, strip(list(images), times, curves))
        else:
            write_movie(file, kind, _side_by_side(images, times, curves, view), view.fps)


def _side_by_side(images: Iterator[Image], times: FloatArray, curves: Curves, view: View) -> Iterator[Image]:
    beside = Beside(curves, view.size[1]) if curves else None
    for image, t in zip(images, times.tolist(), strict=True):
        yield image if beside is None else np.concatenate([image, beside.at(t)], axis=1)
