"""CasADi functions of fixed arguments, called through buffers."""

from __future__ import annotations

from typing import Any

import casadi
import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


class Kernel:
    """A CasADi function with arrays of its own: write ``inputs``, call, read ``outputs``.

    A call of the buffer costs a few microseconds, a call of the function itself some sixty. Arrays are flat, with
    matrices by columns; the outputs are overwritten by the next call.
    """

    def __init__(self, function: casadi.Function) -> None:
        if not all(function.sparsity_out(i).is_dense() for i in range(function.n_out())):
            raise ValueError(f"{function.name()} has sparse outputs")
        self.function = function
        self.inputs = tuple(np.zeros(function.nnz_in(i)) for i in range(function.n_in()))
        self.outputs = tuple(np.zeros(function.nnz_out(i)) for i in range(function.n_out()))
        # The buffer keeps neither the arrays nor itself alive: the attributes do.
        buffer: Any
        buffer, self._trigger = function.buffer()
        self._buffer = buffer
        for i, array in enumerate(self.inputs):
            buffer.set_arg(i, array.data)
        for i, array in enumerate(self.outputs):
            buffer.set_res(i, array.data)

    def __call__(self, *arguments: ArrayLike) -> tuple[FloatArray, ...]:
        for array, argument in zip(self.inputs, arguments, strict=True):
            array[:] = argument
        self._trigger()
        return self.outputs
