"""External functions for tests: a law in NumPy with derivatives by central differences, and some that misbehave."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import ExternalFunction

FloatArray = NDArray[np.float64]
Law = Callable[[FloatArray], Any]


class Numeric:
    """A law ``outputs = law(inputs)``; ``stale``: its derivative is computed once a run and kept."""

    def __init__(
        self,
        law: Law,
        n_inputs: int,
        n_outputs: int,
        *,
        sparsity: Sequence[Sequence[bool]] | None = None,
        units: tuple[Sequence[str], Sequence[str]] | None = None,
        stale: bool = False,
        name: str = "law",
    ) -> None:
        self.law, self.n_inputs, self.n_outputs, self.name = law, n_inputs, n_outputs, name
        self.sparsity = np.ones((n_outputs, n_inputs), dtype=bool) if sparsity is None else np.array(sparsity)
        self.units, self.stale = units, stale
        self.calls = self.derivatives = self.restarts = 0
        self.copies: list[Numeric] = []
        self._kept: FloatArray | None = None

    def fresh(self) -> ExternalFunction:
        copy = type(self)(
            self.law,
            self.n_inputs,
            self.n_outputs,
            sparsity=self.sparsity.tolist(),
            units=self.units,
            stale=self.stale,
            name=self.name,
        )
        self.copies.append(copy)
        return copy

    def evaluate(self, inputs: FloatArray, outputs: FloatArray) -> None:
        self.calls += 1
        outputs[:] = self.law(inputs)

    def derivative(self, inputs: FloatArray, jacobian: FloatArray) -> None:
        if not self.stale or self._kept is None:
            self._kept = self.differences(inputs)
        jacobian[:] = self._kept

    def exact_derivative(self, inputs: FloatArray, jacobian: FloatArray) -> None:
        jacobian[:] = self.differences(inputs)

    def restart(self) -> None:
        self.restarts += 1

    def differences(self, x: FloatArray) -> FloatArray:
        self.derivatives += 1
        columns = []
        for j in range(self.n_inputs):
            h = 1e-6 * (1.0 + abs(x[j])) * np.eye(self.n_inputs)[j]
            ahead, behind = (np.asarray(self.law(x + side * h), dtype=float) for side in (1.0, -1.0))
            columns.append((ahead - behind) / (2.0 * h[j]))
        return np.column_stack(columns) if columns else np.zeros((self.n_outputs, 0))


class Drag:
    """F = c v |v|, by name: it can be found by another process."""

    name, n_inputs, n_outputs = "Drag", 1, 1
    units = (("m/s",), ("N",))

    def __init__(self, c: float) -> None:
        self.c = c

    def fresh(self) -> Drag:
        return Drag(self.c)

    def evaluate(self, inputs: FloatArray, outputs: FloatArray) -> None:
        outputs[0] = self.c * inputs[0] * abs(inputs[0])

    def derivative(self, inputs: FloatArray, jacobian: FloatArray) -> None:
        jacobian[0, 0] = 2.0 * self.c * abs(inputs[0])

    def describe(self) -> float:
        return self.c

    @classmethod
    def restore(cls, data: float) -> Drag:
        return cls(data)
