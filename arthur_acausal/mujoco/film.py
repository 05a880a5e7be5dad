"""A run of a MuJoCo body as pictures: the body, and beside it what the run says over time.

All that it takes is in the result: the body's model, which the run keeps as data, and the trajectories of its states.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from arthur_acausal import ResultError, Solution, UsageError
from arthur_acausal.mujoco import quantities
from arthur_acausal.mujoco.beside import Beside, Curves, Shown, strip
from arthur_acausal.mujoco.dynamics import Dynamics, FloatArray
from arthur_acausal.mujoco.function import BodyFunction
from arthur_acausal.mujoco.movie import check_writer, write_movie, write_picture
from arthur_acausal.mujoco.observe import contact_forces, movable_geoms
from arthur_acausal.mujoco.offscreen import Image, canvas
from arthur_acausal.mujoco.recipe import Recipe


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


class Acting:
    """A body that goes through the states of a run."""

    def __init__(self, solution: Solution, path: str = "") -> None:
        found = bodies(solution)
        if path not in found and (path or len(found) != 1):
            raise UsageError(
                f"the run has no MuJoCo body {path!r}" if path else f"the run has {len(found)} MuJoCo bodies",
                remedy=f"choose one of {', '.join(map(repr, found))}",
            )
        self._path = path if path in found else next(iter(found))
        self._solution = solution
        self.dynamics: Dynamics = found[self._path].dynamics()

    def at(self, times: FloatArray) -> Iterator[float]:
        """Bring the body into its state at each of these times, which are yielded."""
        prefix = f"{self._path}." if self._path else ""
        names = quantities.inputs(self.dynamics.layout)
        inputs = np.stack([self._solution.at(times, prefix + name) for name in names], axis=1)
        for row, t in zip(inputs, times.tolist(), strict=True):
            if not self.dynamics.compute(np.ascontiguousarray(row)):
                raise ResultError(f"MuJoCo has no result at t = {t:g} s", cause=self.dynamics.failure)
            yield t

    def forces(self) -> tuple[FloatArray, dict[str, FloatArray]]:
        """Return times, and the normal force [N] on each geom that moves and is touched at any of them, by name."""
        times = np.linspace(self._solution.t[0], self._solution.t[-1], FORCE_TIMES)
        geoms = movable_geoms(self.dynamics.model)
        found = {name: np.zeros(times.size) for name in geoms.values()}
        for row, _ in enumerate(self.at(times)):
            for geom, name in geoms.items():
                pushes = contact_forces(self.dynamics.model, self.dynamics.data, frozenset((geom,)))
                found[name][row] = sum(normal for *_, normal in pushes)
        return times, {name: force for name, force in found.items() if force.any()}


FORCE_TIMES = 400  # of the curves of contact forces


def bodies(solution: Solution) -> dict[str, Recipe]:
    """Return the MuJoCo bodies of a run by their paths, from what the run keeps of them."""
    name = f"{BodyFunction.__module__}:{BodyFunction.__qualname__}"
    mine = [kept for kept in solution.run.externals if kept["function"] == name]
    if not mine:
        raise ResultError(
            "the result has no MuJoCo body to draw",
            remedy="simulate a model with a MujocoBody, with this version of Arthur, and keep it with -o",
        )
    return {str(kept["path"]): Recipe.of_data(kept["data"]["recipe"]) for kept in mine}
