"""The locomotion controller as the quadruped's: torques of the joints become forces of the cylinders."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.models.arthur.locomotion.actuation import actuator_forces
from arthur_acausal.models.arthur.locomotion.controller import Configuration, Controller
from arthur_acausal.models.arthur.locomotion.portable import as_data, of_data
from arthur_acausal.models.arthur.locomotion.sensors import FIELDS, N_INPUTS

FloatArray = NDArray[np.float64]


class Walking:
    """The function of the quadruped's sampled block: see Quadruped.sensors and Quadruped.asked."""

    def __init__(self, configuration: Configuration) -> None:
        self._controller = Controller(configuration)
        self._before: FloatArray | None = None
        start = 0
        for name, length in FIELDS.items():
            if name == "angles":
                self._angles = slice(start, start + length)
            start += length

    def fresh(self) -> Walking:
        """Return a controller of the same configuration in its initial state."""
        return Walking(self._controller.configuration)

    def describe(self) -> dict[str, Any]:
        """Return what makes this controller in another process, in terms of JSON."""
        return as_data(self._controller.configuration)

    @classmethod
    def restore(cls, data: Mapping[str, Any]) -> Walking:
        """Return the controller that ``describe`` told of, in its initial state."""
        return cls(of_data(data))

    def __call__(self, t: float, sensors: FloatArray) -> FloatArray:
        """Return the forces of the cylinders [N], flow [m^3/s] and pressure [Pa] that the plan needs."""
        outputs, places = self._controller(t, sensors[:N_INPUTS]), self._controller.places
        forces = actuator_forces(outputs[places["torque"]], sensors[self._angles])
        before = forces if self._before is None else self._before
        self._before = forces
        ahead = [outputs[places[name]] for name in ("flow", "pressure")]
        return np.concatenate([before, forces, np.full(12, t), *ahead])
