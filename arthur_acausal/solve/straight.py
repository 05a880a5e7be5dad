"""An engine for runs without events, wholly in C: what goes straight from the start to the end.

A step takes no Python at all, and a run of a small model a fifth of a millisecond. The C (straight.c) is built once by
the system's compiler and calls the model's generated functions and the SUNDIALS libraries of the binding. It takes
systems without relations, `when`, samples, external functions and other sets of states, with all states given at the
start; where Newton's method or IDA fails there, the run is made by the default engine, which tells why.
"""

from __future__ import annotations

import ctypes
import logging
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.codegen.build import compile_c
from arthur_acausal.solve.ida import DENSE_UP_TO, load_ida
from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.protocol import DAE, FloatArray

LOGGER = logging.getLogger("arthur_acausal")
SUNDIALS = (
    "SUNContext_Create",
    "SUNContext_ClearErrHandlers",
    "SUNContext_Free",
    "N_VMake_Serial",
    "N_VDestroy",
    "N_VGetArrayPointer",
    "SUNDenseMatrix",
    "SUNDenseMatrix_Data",
    "SUNMatDestroy",
    "SUNLinSol_Dense",
    "SUNLinSolFree",
    "IDACreate",
    "IDAInit",
    "IDASVtolerances",
    "IDASetLinearSolver",
    "IDASetJacFn",
    "IDASetUserData",
    "IDASetMaxOrd",
    "IDASetMaxNumSteps",
    "IDASetStopTime",
    "IDASolve",
    "IDAGetNumSteps",
    "IDAGetNumErrTestFails",
    "IDAGetNumResEvals",
    "IDAGetNumJacEvals",
    "IDAFree",
)


class _Problem(ctypes.Structure):
    """Problem of straight.c."""

    _fields_ = (
        *((name, ctypes.c_void_p) for name in ("api", "residual", "jacobian")),
        *((name, ctypes.c_longlong) for name in ("n", "entries")),
        *((name, ctypes.c_void_p) for name in ("place", "differential", "u", "z", "m", "atol")),
        ("rtol", ctypes.c_double),
        *((name, ctypes.c_longlong) for name in ("order", "max_steps")),
        *((name, ctypes.c_void_p) for name in ("iw", "w")),
    )


@dataclass(frozen=True, slots=True)
class Runs:
    """What came of N runs.

    ``y``, ``yp``: (N, nt, n) at the output times, the start not among them; ``y0``, ``yp0``: (N, n) at the start;
    ``counts``: (N, 4), steps, rejected steps, residuals and Jacobians; ``failed``: (N,), to be made another way.
    """

    y: FloatArray
    yp: FloatArray
    y0: FloatArray
    yp0: FloatArray
    counts: FloatArray
    failed: NDArray[np.bool_]


class Straight:
    """The engine for one compiled system and constant inputs ``u``; see `of`."""

    def __init__(
        self, driver: Any, api: Any, dae: DAE, u: FloatArray, options: SolverOptions, nominal: FloatArray
    ) -> None:
        self._run, self._dae = driver, dae
        column = np.repeat(np.arange(dae.n), np.diff(dae.sparsity.colind))
        functions: Any = dae.functions  # type: ignore[attr-defined]
        addresses, self._libraries, sizes = [], [], np.zeros(4, dtype=np.int64)
        for name in ("residual", "jacobian"):
            library = ctypes.CDLL(str(functions[name].library))
            found = (ctypes.c_longlong * 4)()
            getattr(library, f"{name}_work")(*(ctypes.byref(found, 8 * k) for k in range(4)))
            sizes = np.maximum(sizes, np.array(found))
            addresses.append(ctypes.cast(getattr(library, name), ctypes.c_void_p).value)
            self._libraries.append(library)
        place = (column * dae.n + np.asarray(dae.sparsity.row)).astype(np.int64)
        atol = options.absolute_tolerances(list(dae.y_paths), nominal)
        nothing = np.zeros(1)  # where an address is asked for all the same
        integers, numbers = np.zeros(sizes[2] + 1, dtype=np.int64), np.zeros(sizes[3] + 1)
        arrays: list[Any] = [
            place,
            dae.differential.astype(np.int8),
            np.append(u, 0.0),
            nothing,
            nothing,
            atol,
        ]
        self._keep = api, arrays, integers, numbers
        address = [array.ctypes.data for array in arrays]
        self._problem = _Problem(
            ctypes.addressof(api),
            *addresses,
            dae.n,
            place.size,
            *address,
            options.step_rtol,
            options.max_order,
            options.max_steps,
            integers.ctypes.data,
            numbers.ctypes.data,
        )

    @classmethod
    def of(cls, dae: DAE, u: FloatArray, options: SolverOptions) -> Straight | None:
        """Return the engine for a system, None where it does not fit or cannot be built."""
        driver = _driver() if fits(dae) else None
        functions: Any = dae.functions if driver else {}  # type: ignore[attr-defined]
        if driver is None or not all(
            hasattr(functions[name], "library") for name in ("residual", "jacobian")
        ):
            return None
        return cls(*driver, dae, u, options, dae.attributes(dae.parameter_vector()).nominal)

    def run(self, p: FloatArray, start_time: float, times: FloatArray, y: FloatArray) -> Runs:
        """Integrate from ``start_time`` [s] to the ``times`` for each row of ``p`` (N, np) and of the states ``y``."""
        runs, nt, n = len(p), len(times), self._dae.n
        p, y0, yp0 = np.ascontiguousarray(p), np.array(y, order="C"), np.zeros((runs, n))
        out_y, out_yp, counts = np.zeros((runs, nt, n)), np.zeros((runs, nt, n)), np.zeros((runs, 4))
        failed, times = np.zeros(runs, dtype=np.int8), np.ascontiguousarray(times, dtype=float)
        self._run(
            ctypes.byref(self._problem),
            runs,
            p.shape[1],
            p.ctypes.data,
            start_time,
            times.ctypes.data,
            nt,
            *(array.ctypes.data for array in (y0, yp0, out_y, out_yp, counts, failed)),
        )
        return Runs(out_y, out_yp, y0, yp0, counts, failed.astype(bool))


def fits(dae: DAE) -> bool:
    """Whether a system has nothing that the C cannot do."""
    kinds: Any = dae
    states = np.flatnonzero(dae.differential)
    return bool(
        0 < dae.n <= DENSE_UP_TO
        and states.size == dae.n  # algebraic unknowns have tolerances that follow the states
        and not (dae.relations or dae.whens or dae.samples or dae.z_paths or dae.blends)
        and dae.starting is None
        and not kinds.calls
        and kinds.sets is None
    )


@cache
def _driver() -> tuple[Any, Any] | None:
    """Return the function `arthur_straight` and the addresses of SUNDIALS, None where they cannot be had."""
    import sksundae
    from sksundae._cy_common import config

    load_ida()
    if not sksundae.__version__.startswith("1.2.") or config["SUNDIALS_FLOAT_TYPE"] != "double":
        return None
    import sksundae._cy_ida

    binding = ctypes.CDLL(sksundae._cy_ida.__file__)
    try:
        addresses = [ctypes.cast(getattr(binding, name), ctypes.c_void_p).value for name in SUNDIALS]
        source = Path(__file__).with_name("straight.c")
        path = compile_c(source, f"-DINDEX={config['SUNDIALS_INT_TYPE']}")
        if path is None:
            return None
        library = ctypes.CDLL(str(path))
    except (OSError, AttributeError) as error:
        LOGGER.info("runs without events go by the default engine: %s", error)
        return None
    function = library.arthur_straight
    function.restype = None
    pointer, count, number = ctypes.c_void_p, ctypes.c_longlong, ctypes.c_double
    function.argtypes = [pointer, count, count, pointer, number, pointer, count, *[pointer] * 6]
    return function, (ctypes.c_void_p * len(addresses))(*addresses)
