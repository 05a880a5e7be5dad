"""The external functions of a residual: a model's accelerations, or what is observed, with their derivatives."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from arthur_acausal.mujoco.derivative import MAX_AGE, Differences, Stale
from arthur_acausal.mujoco.dynamics import FloatArray
from arthur_acausal.mujoco.native import NativeBody, library
from arthur_acausal.mujoco.recipe import Recipe


class BodyFunction:
    """Accelerations of a model, for the residual; inputs and outputs stand in :mod:`dynamics`.

    ``observes``: the outputs are what is observed instead. ``max_age``: how often a derivative is handed out before
    it is computed anew, as long as the same contacts act.
    """

    def __init__(self, recipe: Recipe, *, observes: bool = False, max_age: int = MAX_AGE) -> None:
        self.name = f"{recipe.source.name}, observed" if observes else recipe.source.name
        self.recipe, self.observes, self.max_age = recipe, observes, max_age
        self.dynamics = recipe.observing() if observes else recipe.dynamics()
        self.n_inputs, self.n_outputs = self.dynamics.slots.count, self.dynamics.n_outputs
        self._differences = Differences(self.dynamics)
        self._stale = Stale(self._differences, max_age)
        found = None if observes else library()
        self._native = None if found is None else NativeBody(found, self._differences, max_age)

    @property
    def native(self) -> tuple[int, int, int] | None:
        """Addresses of the body and of machine code that evaluates and differentiates it, where there is any."""
        return None if self._native is None else self._native.addresses

    @property
    def failure(self) -> str:
        """Why the last evaluation gave no numbers."""
        return self.dynamics.failure

    @property
    def renewals(self) -> int:
        """How often the derivative that is kept was computed."""
        return self._stale.renewals + (0 if self._native is None else self._native.renewals)

    def evaluate(self, inputs: FloatArray, outputs: FloatArray) -> None:
        """Write the accelerations for ``inputs`` into ``outputs``; NaN where MuJoCo has no result."""
        if self._native is not None and self._native.evaluate(inputs, outputs):
            return
        if self.dynamics.compute(inputs):
            self.dynamics.read(outputs)
        else:
            outputs.fill(np.nan)

    def derivative(self, inputs: FloatArray, jacobian: FloatArray) -> None:
        """Write d outputs / d inputs into ``jacobian`` (n_outputs, n_inputs); it may be one of before."""
        if self._native is not None:
            if self._native.derivative(inputs, jacobian):
                return
            self._stale.restart()  # what it keeps is of long ago
        self._stale.write(inputs, jacobian)

    def exact_derivative(self, inputs: FloatArray, jacobian: FloatArray) -> None:
        """Write d outputs / d inputs at these inputs, to about eight digits."""
        if self._native is None or not self._native.exact_derivative(inputs, jacobian):
            self._differences.write(inputs, jacobian, exact=True)

    def restart(self) -> None:
        """Forget the derivative: something has jumped."""
        self._stale.restart()
        if self._native is not None:
            self._native.restart()

    def fresh(self) -> BodyFunction:
        """Return an independent function of the same model, for another run."""
        return BodyFunction(self.recipe, observes=self.observes, max_age=self.max_age)

    def describe(self) -> dict[str, Any]:
        """Return all that it takes to make this function elsewhere, in terms of JSON."""
        return {"recipe": self.recipe.as_data(), "observes": self.observes, "max_age": self.max_age}

    @classmethod
    def restore(cls, data: Mapping[str, Any]) -> BodyFunction:
        """Return the function that ``describe`` told of."""
        recipe = Recipe.of_data(data["recipe"])
        return cls(recipe, observes=bool(data["observes"]), max_age=int(data["max_age"]))
