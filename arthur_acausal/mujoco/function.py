"""The external function of a residual: a model's accelerations, with their derivative."""

from __future__ import annotations

import numpy as np

from arthur_acausal.mujoco.derivative import MAX_AGE, Differences, Stale
from arthur_acausal.mujoco.dynamics import Dynamics, FloatArray
from arthur_acausal.mujoco.engine import MjModel
from arthur_acausal.mujoco.layout import Layout


class BodyFunction:
    """Accelerations of a model, for the residual: inputs and outputs stand in :mod:`dynamics`.

    ``max_age``: how often a derivative is handed out before it is computed anew, as long as the same contacts act.
    """

    def __init__(
        self, model: MjModel, layout: Layout, *, name: str = "MuJoCo", max_age: int = MAX_AGE
    ) -> None:
        self.name, self._max_age = name, max_age
        self.dynamics = Dynamics(model, layout)
        self.n_inputs = self.dynamics.slots.count
        self.n_outputs = self.dynamics.n_outputs
        self._stale = Stale(Differences(self.dynamics), max_age)

    @property
    def failure(self) -> str:
        """Why the last evaluation gave no numbers."""
        return self.dynamics.failure

    def evaluate(self, inputs: FloatArray, outputs: FloatArray) -> None:
        """Write the accelerations for ``inputs`` into ``outputs``; NaN where MuJoCo has no result."""
        if self.dynamics.compute(inputs):
            self.dynamics.read(outputs)
        else:
            outputs.fill(np.nan)

    def derivative(self, inputs: FloatArray, jacobian: FloatArray) -> None:
        """Write d outputs / d inputs into ``jacobian`` (n_outputs, n_inputs); it may be one of before."""
        self._stale.write(inputs, jacobian)

    def exact_derivative(self, inputs: FloatArray, jacobian: FloatArray) -> None:
        """Write d outputs / d inputs at these inputs, to about eight digits."""
        self._stale.differences.write(inputs, jacobian, exact=True)

    def restart(self) -> None:
        """Forget the derivative: something has jumped."""
        self._stale.restart()

    def fresh(self) -> BodyFunction:
        """Return an independent function of the same model, for another run."""
        return BodyFunction(self.dynamics.model, self.dynamics.layout, name=self.name, max_age=self._max_age)
