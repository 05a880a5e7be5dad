"""The MuJoCo bodies of a stored run: what the run keeps of them is all that it takes to bring them into its states."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from arthur_acausal import ResultError, Solution, UsageError
from arthur_acausal.mujoco import quantities
from arthur_acausal.mujoco.dynamics import Dynamics, FloatArray
from arthur_acausal.mujoco.function import BodyFunction
from arthur_acausal.mujoco.observe import contact_forces, movable_geoms
from arthur_acausal.mujoco.recipe import Recipe

FORCE_TIMES = 400  # of the curves of contact forces


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
