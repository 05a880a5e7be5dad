"""The robot of one run of the study: what varies from run to run are parameters, so that few systems are built."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from casadi import SX
from numpy.typing import NDArray

from arthur_acausal import Equations, Real, der, parameter, terminate, time, variable, when
from arthur_acausal.models.arthur.demand import Demand
from arthur_acausal.models.arthur.locomotion.controller import Configuration
from arthur_acausal.models.arthur.quadruped import Quadruped
from arthur_acausal.models.arthur.study.schemes import scheme_named
from arthur_acausal.models.arthur.study.tasks import PUSH_DURATION, PUSHED, TASKS
from arthur_acausal.models.arthur.walking import Walking

FloatArray = NDArray[np.float64]


class TrialWalking:
    """The locomotion controller of the task and the seed that are its last two inputs; the others are the sensors."""

    def __init__(self) -> None:
        self._walking: Walking | None = None

    def fresh(self) -> TrialWalking:
        """Return one that knows neither task nor seed yet."""
        return TrialWalking()

    def describe(self) -> dict[str, Any]:
        """Return what makes it in another process: nothing, the inputs tell."""
        return {}

    @classmethod
    def restore(cls, data: Mapping[str, Any]) -> TrialWalking:
        """Return one that knows neither task nor seed yet."""
        return cls()

    def __call__(self, t: float, inputs: FloatArray) -> FloatArray:
        """Return what Walking does."""
        if self._walking is None:
            task, seed = (int(x) for x in inputs[-2:])
            self._walking = Walking(Configuration(commands=TASKS[task].commands, seed=seed))
        return self._walking(t, inputs[:-2])


class Trial(Quadruped):
    """The quadruped with a pump scheme at a task, audited; it ends after ``duration``.

    It does not count how often the motor's current exceeds its limit: each time would be an event, and where the
    sensors' noise reaches the current they take longer than all else.

    Structural parameters: ``scheme`` by its name, ``accumulator``; ``demand``, a file with what is known.
    """

    audit: bool = True
    push: float = 1.0
    controller: Any = TrialWalking()
    scheme: str = "feed-forward"
    accumulator: bool = True
    demand: str = ""
    task: Real = parameter("1", default=3, min=0, max=len(TASKS) - 1, description="number of the task")
    noise: Real = parameter("1", default=0, min=0, description="seed of the sensors' noise")
    duration: Real = parameter("s", default=2.5, min=0.0)
    I_max: Real = parameter("A", default=1e3, min=0.0, description="out of reach: nothing is counted")
    squares: Real = variable(
        "N^2*s", start=0.0, fixed=True, nominal=1e3, description="of the forces' errors, integrated"
    )
    t_push: Real = parameter("s", default=PUSHED, min=0.0, description="beginning of the push")
    push_duration: Real = parameter("s", default=PUSH_DURATION, min=0.0)

    def build(self) -> None:
        known = Demand.load(self.demand) if self.demand else None
        self.options = scheme_named(self.scheme).options(self.accumulator, known)
        super().build()

    def sensors(self) -> list[SX]:
        """Return what the controller is given: also task and seed."""
        return [*super().sensors(), self.task, self.noise]

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.squares) == sum(actuator.control.e**2 for actuator in self.actuators)
        yield when(time() >= self.duration, terminate("the trial is over"))
