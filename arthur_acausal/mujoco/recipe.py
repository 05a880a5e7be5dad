"""What it takes to make a model's functions anew, here or elsewhere: data only."""

from __future__ import annotations

from base64 import b64decode, b64encode
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from arthur_acausal.mujoco.dynamics import Dynamics
from arthur_acausal.mujoco.engine import MjModel
from arthur_acausal.mujoco.layout import layout
from arthur_acausal.mujoco.load import Source, build, received
from arthur_acausal.mujoco.observe import ObservingDynamics, observables
from arthur_acausal.mujoco.purity import pure


@dataclass(frozen=True, slots=True)
class Recipe:
    """A model, and what is asked of it: see `MujocoBody`."""

    source: Source
    keyframe: str = ""
    wrenches: tuple[str, ...] = ()
    observe: tuple[str, ...] = ()
    contacts: tuple[str, ...] = ()

    def dynamics(self) -> Dynamics:
        """Return the model's dynamics, with buffers of their own."""
        model = _model(self.source)
        return Dynamics(model, layout(model, keyframe=self.keyframe, wrenches=self.wrenches))

    def observing(self) -> ObservingDynamics:
        """Return what observes the model, with buffers of its own."""
        model = _model(self.source)
        parts = layout(model, keyframe=self.keyframe, wrenches=self.wrenches)
        return ObservingDynamics(model, parts, observables(model, parts, self.observe, self.contacts))

    def as_data(self) -> dict[str, Any]:
        """Return the recipe in terms of JSON."""
        assets = {name: b64encode(content).decode() for name, content in self.source.assets.items()}
        return {
            "name": self.source.name,
            "text": self.source.text,
            "assets": assets,
            "keyframe": self.keyframe,
            "wrenches": list(self.wrenches),
            "observe": list(self.observe),
            "contacts": list(self.contacts),
        }

    @classmethod
    def of_data(cls, data: Mapping[str, Any]) -> Recipe:
        """Return the recipe that ``as_data`` has written."""
        assets = {str(name): b64decode(content) for name, content in data["assets"].items()}
        return cls(
            received(str(data["text"]), assets, str(data["name"])),
            str(data["keyframe"]),
            *(tuple(map(str, data[part])) for part in ("wrenches", "observe", "contacts")),
        )


@lru_cache(maxsize=32)
def _model(source: Source) -> MjModel:
    return pure(build(source), source.name)
