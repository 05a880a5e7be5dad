"""What MuJoCo can tell of a finished run: Jacobians, contacts, anything, from the states that were stored."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from arthur_acausal import ResultError, Solution, UsageError
from arthur_acausal.mujoco import quantities
from arthur_acausal.mujoco.body import MujocoBody
from arthur_acausal.mujoco.dynamics import FloatArray
from arthur_acausal.mujoco.engine import MjData, MjModel, mujoco
from arthur_acausal.mujoco.observe import contact_forces, contact_geoms

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True, slots=True)
class Contact:
    """One contact at one time: its geoms, where it is [m], and the force [N] in the world on the geom asked for."""

    time: float
    geoms: tuple[str, str]
    position: FloatArray
    distance: float
    force: FloatArray
    normal: float


class Replay:
    """A run of a model with a MuJoCo body, state by state.

    Parameters
    ----------
    solution : of the run.
    body : a body like the one of the model: of the same MJCF, with the same ``wrenches``.
    path : where the body stands in the model; empty if it is the model.

    Attributes
    ----------
    t : times (nt,), s.
    model : MuJoCo's model, with the options that were forced.
    """

    def __init__(self, solution: Solution, body: MujocoBody, path: str = "") -> None:
        self._dynamics = body.recipe.dynamics()
        self._dynamics.senses = True
        self.model: MjModel = self._dynamics.model
        self.t = solution.t
        prefix = f"{path}." if path else ""
        names = [prefix + name for name in quantities.inputs(self._dynamics.layout)]
        if missing := [name for name in names if name not in solution]:
            raise ResultError(
                f"the result has no {missing[0]!r}",
                remedy="give the path of the body in the model, and a body of the same MJCF and wrenches",
            )
        self._inputs = solution.values(names)

    def states(self) -> Iterator[MjData]:
        """Yield MuJoCo's data of each time, with everything computed; it is always the same object."""
        for k in range(self.t.size):
            yield self.state(k)

    def state(self, k: int) -> MjData:
        """Return MuJoCo's data of the time ``t[k]``, with everything computed, until the next call."""
        if not self._dynamics.compute(np.ascontiguousarray(self._inputs[k])):
            raise ResultError(f"MuJoCo has no result at t = {self.t[k]:g} s", cause=self._dynamics.failure)
        self._dynamics.data.time = self.t[k]
        return self._dynamics.data

    def jacobian(self, site: str) -> xarray.DataArray:
        """Return d (velocity, angular velocity) / d qvel of a site over time: (time, motion, dof), in the world."""
        import xarray

        if site not in (sites := {self.model.site(k).name: k for k in range(self.model.nsite)}):
            raise UsageError(f"the model has no site {site!r}", remedy=f"it has {', '.join(sites) or 'none'}")
        found = np.zeros((self.t.size, 6, self.model.nv))
        for row, data in zip(found, self.states(), strict=True):
            mujoco().mj_jacSite(self.model, data, row[:3], row[3:], sites[site])
        motion = [*(f"v_{a}" for a in "xyz"), *(f"w_{a}" for a in "xyz")]
        dofs = quantities.speeds(self._dynamics.layout)
        coordinates = {"time": self.t, "motion": motion, "dof": dofs}
        return xarray.DataArray(found, coordinates, ("time", "motion", "dof"), name=f"jacobian of {site}")

    def contacts(self, name: str) -> list[Contact]:
        """Return all contacts of a geom, or of a body's geoms, over the run."""
        geoms = contact_geoms(self.model, name)
        found = []
        for data in self.states():
            mine = [
                k for k, pair in enumerate(data.contact.geom.tolist()) if len(geoms.intersection(pair)) == 1
            ]
            for k, (force, _, normal) in zip(mine, contact_forces(self.model, data, geoms), strict=True):
                one, two = (self.model.geom(g).name for g in data.contact.geom[k].tolist())
                found.append(
                    Contact(
                        float(data.time),
                        (one, two),
                        data.contact.pos[k].copy(),
                        float(data.contact.dist[k]),
                        force,
                        normal,
                    )
                )
        return found
