"""native.c: the functions of a body in machine code, on the same `Dynamics`; None where they cannot be built."""

from __future__ import annotations

import ctypes
import logging
import sys
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from arthur_acausal import compile_c
from arthur_acausal.mujoco.derivative import Differences
from arthur_acausal.mujoco.dynamics import FloatArray
from arthur_acausal.mujoco.engine import mujoco

LOGGER = logging.getLogger("arthur_acausal")


@cache
def library() -> ctypes.PyDLL | None:
    """Return the library. Where MuJoCo has no header, or another interface, Python serves."""
    package = Path(mujoco().__file__).parent
    headers, found = package / "include", sorted(package.glob("libmujoco.*"))
    if sys.platform == "win32" or not headers.exists() or not found:
        return None
    words = f"-I{headers}", str(found[0])
    path = compile_c(Path(__file__).with_name("native.c"), *words, version=mujoco().__version__)
    try:
        return None if path is None else ctypes.PyDLL(str(path))  # it keeps the interpreter's lock
    except OSError as error:
        LOGGER.info("MuJoCo is called from Python: %s", error)
        return None


_Start: Any = ctypes.c_double * 0  # an array, of whatever size


class _Body(ctypes.Structure):
    """Body of native.c."""

    _fields_ = (
        *((name, ctypes.c_void_p) for name in ("model", "data")),
        *((name, ctypes.c_int64) for name in ("n_tau", "n_act", "n_ctrl", "n_wrench", "max_age")),
        *((name, ctypes.c_void_p) for name in ("flange", "site", "scale", "at", "base", "moved", "value")),
        *((name, ctypes.c_void_p) for name in ("tangent", "direction", "kept")),
        *((name, ctypes.c_int64) for name in ("age", "signature", "renewals")),
    )


class NativeBody:
    """A body's functions; each returns whether it has a result, for else Python knows what to tell.

    ``addresses``: of the body, and of what evaluates and differentiates it.
    """

    def __init__(self, found: ctypes.PyDLL, differences: Differences, max_age: int) -> None:
        dynamics = differences.dynamics
        parts, n, m = dynamics.layout, dynamics.n_outputs, dynamics.slots.count
        sizes = {"base": n, "moved": m, "value": n, "tangent": n * parts.n_v, "direction": parts.n_v}
        arrays: dict[str, Any] = {name: np.zeros(size) for name, size in (*sizes.items(), ("kept", n * m))}
        arrays["flange"] = np.array([j.v for j in parts.flanges], dtype=np.int64)
        arrays["site"] = np.array([s.first for s in parts.wrenches], dtype=np.int64)
        arrays |= {"scale": differences.scale, "at": dynamics.at}
        self._keep = arrays, dynamics
        self._body = _Body(
            model=dynamics.model._address,
            data=dynamics.data._address,
            n_tau=len(parts.flanges),
            n_act=len(parts.activations),
            n_ctrl=len(parts.controls),
            n_wrench=len(parts.wrenches),
            max_age=max_age,
            age=max_age,
            **{name: array.ctypes.data for name, array in arrays.items()},
        )
        functions = [
            getattr(found, f"arthur_{name}") for name in ("evaluate", "derivative", "exact_derivative")
        ]
        self._evaluate, self._derivative, self._exact_derivative = functions
        self._self = ctypes.byref(self._body)
        code = [ctypes.cast(function, ctypes.c_void_p).value or 0 for function in functions[:2]]
        self.addresses = ctypes.addressof(self._body), code[0], code[1]

    @property
    def renewals(self) -> int:
        """How often the derivative was computed."""
        return int(self._body.renewals)

    def restart(self) -> None:
        """Compute the next derivative anew."""
        self._body.age = self._body.max_age

    def evaluate(self, inputs: FloatArray, outputs: FloatArray) -> bool:
        """See `BodyFunction`."""
        return self._call(self._evaluate, inputs, outputs)

    def derivative(self, inputs: FloatArray, jacobian: FloatArray) -> bool:
        """See `BodyFunction`."""
        return self._call(self._derivative, inputs, jacobian)

    def exact_derivative(self, inputs: FloatArray, jacobian: FloatArray) -> bool:
        """See `BodyFunction`."""
        return self._call(self._exact_derivative, inputs, jacobian)

    def _call(self, function: Any, inputs: FloatArray, out: FloatArray) -> bool:
        try:  # quicker than to ask an array for its address
            read, write = _Start.from_buffer(inputs), _Start.from_buffer(out)
        except (TypeError, ValueError):  # read only, or no contiguous array
            return False
        return not function(self._self, ctypes.byref(read), ctypes.byref(write))
