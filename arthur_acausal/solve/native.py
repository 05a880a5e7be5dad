"""The callbacks of `callbacks` in C, where the model's functions are machine code: a tenth of the cost of a call.

A small extension module (native.c) is built once by the system's C compiler and kept in the cache. Where there is no
compiler, or no header of Python, the functions of `callbacks` serve, with the same results to the last bit.
"""

from __future__ import annotations

import ctypes
import importlib.machinery
import importlib.util
import logging
import sys
import sysconfig
import weakref
from collections.abc import Callable
from functools import cache
from pathlib import Path
from time import monotonic, perf_counter
from typing import Any

import numpy as np

from arthur_acausal.codegen.build import compile_c
from arthur_acausal.codegen.calls import OUTPUTS, SLOPES, Calls, Prepared, Step
from arthur_acausal.codegen.kernel import Kernel
from arthur_acausal.solve.callbacks import Monitor, Roots, dense_places
from arthur_acausal.solve.inputs import Inputs
from arthur_acausal.solve.protocol import DAE, Evaluator

LOGGER = logging.getLogger("arthur_acausal")
FIELDS = (
    "t",
    "h",
    "steps",
    "rejected",
    "residuals",
    "jacobians",
    "roots",
)  # of a Monitor, in the order of Counts
HALTED = ("", "max_steps", "stalled", "interrupted", "tolerances")
RESIDUAL, JACOBIAN, ROOTS = range(3)
KNOWN_BINDING = "1.2.0"
SUNDIALS = (
    "N_VGetArrayPointer",
    "SUNDenseMatrix_Data",
    "IDASetUserData",
    "IDASetNlsResFn",
    "IDASetJacFn",
    "IDARootInit",
)


@cache
def extension() -> Any:
    """Return the extension module, None where it cannot be built or loaded."""
    include = sysconfig.get_paths()["include"]
    if sys.platform == "win32" or not Path(include, "Python.h").exists():
        return None
    library = compile_c(Path(__file__).with_name("native.c"), f"-I{include}", version=sys.version)
    if library is None:
        return None
    try:
        loader = importlib.machinery.ExtensionFileLoader("arthur_native", str(library))
        spec = importlib.util.spec_from_file_location("arthur_native", library, loader=loader)
        assert spec is not None  # a loader was given
        module = importlib.util.module_from_spec(spec)
        loader.exec_module(module)
    except (OSError, ImportError) as error:
        LOGGER.info("callbacks stay in Python, for the extension in C cannot be loaded: %s", error)
        return None
    return module


class Native:
    """The callbacks of one run.

    Attributes
    ----------
    residual, jacobian : as `residual_callback` and `jacobian_callback` give them.
    roots : as `Roots.callback` gives it; None where no relation is watched.
    evaluator, monitor : what they evaluate, and count for.
    """

    def __init__(
        self,
        module: Any,
        dae: DAE,
        evaluator: Evaluator,
        inputs: Inputs,
        roots: Roots,
        monitor: Monitor,
        dense: bool,
    ) -> None:
        self._module, self._dae, self.evaluator = module, dae, evaluator
        self._roots, self.monitor = roots, monitor
        self._refresh = inputs.refresh if inputs.varying else None
        self._counts = np.zeros(len(FIELDS) + 3)
        place = dense_places(dae).astype(np.int64) if dense else None
        # Functions of Python around them, since the binding asks for their signatures, which takes 0.3 ms for one of
        # C, and keeps events as attributes.
        # Those of C must not hold what holds them: the collector of cycles does not see into them.
        me = weakref.proxy(self)
        self._functions = [
            self._bind(RESIDUAL, evaluator.residual, lambda: me._refuse()),
            self._bind(JACOBIAN, evaluator.jacobian, lambda: me._bad_jacobian(), place),
            None,
        ]
        if roots.index.size:
            index = roots.index.astype(np.int64)
            self._functions[ROOTS] = self._bind(
                ROOTS, evaluator.roots, lambda t, out: roots.differs(t, np.frombuffer(out)), index
            )
        residual, jacobian, watched = self._functions
        self.residual = lambda t, y, yp, out: residual(t, y, yp, out)
        self.jacobian = lambda t, y, yp, res, cj, out: jacobian(t, y, yp, res, cj, out)
        self.roots: Callable[..., None] | None = None
        if watched is not None:
            self.roots = lambda t, y, yp, out: watched(t, y, yp, out)
        self._dense = dense

    @classmethod
    def of(
        cls, dae: DAE, evaluator: Evaluator, inputs: Inputs, roots: Roots, monitor: Monitor, dense: bool
    ) -> Native | None:
        """Return the callbacks in C, None where functions are not machine code."""
        kernels = [evaluator.residual, evaluator.jacobian, *([evaluator.roots] if roots.index.size else [])]
        able = dae.n and all(_is_compiled(kernel) for kernel in kernels)
        module = extension() if able else None
        return None if module is None else cls(module, dae, evaluator, inputs, roots, monitor, dense)

    def begin(self) -> None:
        """Take over what the monitor has counted."""
        monitor, counts = self.monitor, self._counts
        counts[: len(FIELDS)] = [getattr(monitor, name) for name in FIELDS]
        # the clocks of C and of Python may have other origins
        due = max(monitor.next_report - perf_counter(), 0.0)
        counts[len(FIELDS) :] = HALTED.index(monitor.halted), monitor.max_steps, monotonic() + due

    def end(self) -> None:
        """Give back what was counted."""
        monitor, counts = self.monitor, self._counts.tolist()
        monitor.t, monitor.h = counts[0], counts[1]
        for name, value in zip(FIELDS[2:], counts[2:], strict=False):
            setattr(monitor, name, int(value))
        monitor.halted = HALTED[int(counts[len(FIELDS)])]
        monitor.next_report = perf_counter() + max(counts[-1] - monotonic(), 0.0)

    def attach(self, engine: Any) -> None:
        """Let an engine whose memory is set up call the functions without the arrays that the binding would make."""
        sundials = _sundials() if self._dense else None
        if sundials is not None:
            # as an attribute it lives as long as the engine
            engine.functions = self._module.attach(engine._IDA__IDA, *self._functions, *sundials)

    def _refuse(self) -> bool:
        """Whether the residual is refused; see `Monitor.refuse`."""
        self.monitor.residuals = int(self._counts[FIELDS.index("residuals")])
        return self.monitor.refuse(self.evaluator, self.evaluator.residual())

    def _watch(self) -> bool:
        return self.monitor.watch is not None and self.monitor.watch()

    def _bad_jacobian(self) -> None:
        bad = np.flatnonzero(~np.isfinite(self.evaluator.jacobian()))
        if bad.size:
            self.monitor.jacobian_offence = (float(self.evaluator.t[0]), int(bad[0]))

    def _bind(self, kind: int, function: Any, slow: Callable[..., object], place: Any = None) -> Any:
        evaluator, roots, calls = self.evaluator, self._roots, self.evaluator.external
        kernel, steps = _parts(function)
        generated, made = _generated(kernel), [_external(step) for step in steps]
        externals = (_External * len(steps))(*made)
        tally = calls.tally if isinstance(calls, Calls) else np.zeros(2)
        me = weakref.proxy(self)
        keep = (
            generated,
            made,
            externals,
            tally,
            self._counts,
            place,
            roots.sign_of_zero,
            roots.modes,
            evaluator,
        )
        return self._module.bind(
            kind,
            ctypes.addressof(generated),
            self._dae.n,
            kernel.result.size,
            *(array.ctypes.data for array in (evaluator.t, evaluator.y, evaluator.yp, evaluator.cj)),
            kernel.result.ctypes.data,
            self._counts.ctypes.data,
            0 if place is None else place.ctypes.data,
            0 if place is None else place.size,
            roots.sign_of_zero.ctypes.data,
            roots.modes.ctypes.data,
            ctypes.addressof(externals),
            len(steps),
            SLOPES if steps and function.derivatives else OUTPUTS,
            tally.ctypes.data,
            slow,
            self.monitor.progress,
            function.prepare if steps else None,
            lambda: me._watch(),
            self._refresh,
            keep,
        )


@cache
def _sundials() -> tuple[int, ...] | None:
    """Return the addresses that `attach` takes, None where the binding is not the one whose memory is known."""
    import sksundae._cy_ida
    from sksundae._cy_common import config

    known = (sksundae.__version__, config["SUNDIALS_FLOAT_TYPE"]) == (KNOWN_BINDING, "double")
    if not known or sysconfig.get_config_var("Py_GIL_DISABLED"):
        return None
    library = ctypes.CDLL(sksundae._cy_ida.__file__)
    return tuple(ctypes.cast(getattr(library, name), ctypes.c_void_p).value or 0 for name in SUNDIALS)


class _Generated(ctypes.Structure):
    """Generated of native.c. ``keep``: what the addresses need, as in what follows."""

    _fields_ = tuple((name, ctypes.c_void_p) for name in ("fn", "arg", "res", "iw", "w"))
    keep: Any


class _External(ctypes.Structure):
    """External of native.c."""

    _fields_ = (
        ("inputs", _Generated),
        *((name, ctypes.c_void_p) for name in ("value", "key", "known")),
        ("bytes", ctypes.c_int64),
        *((name, ctypes.c_void_p) for name in ("self", "evaluate", "derivative", "outputs", "slopes")),
    )
    keep: Any


def _generated(kernel: Kernel) -> _Generated:
    """Return the machine code of a kernel, with working memory of its own."""
    function: Any = kernel.function
    library = ctypes.CDLL(str(function.library))
    sizes = (ctypes.c_longlong * 4)()
    work = getattr(library, f"{function.name()}_work")
    work(*(ctypes.byref(sizes, 8 * k) for k in range(4)))
    arg = np.zeros(sizes[0] + 1, dtype=np.uint64)
    res = np.zeros(sizes[1] + 1, dtype=np.uint64)
    iw, w = np.zeros(sizes[2] + 1, dtype=np.int64), np.zeros(sizes[3] + 1)
    arg[: len(kernel.inputs)] = [array.ctypes.data for array in kernel.inputs]
    res[: len(kernel.outputs)] = [array.ctypes.data for array in kernel.outputs]
    address = ctypes.cast(getattr(library, function.name()), ctypes.c_void_p).value
    made = _Generated(address, *(array.ctypes.data for array in (arg, res, iw, w)))
    made.keep = kernel, library, arg, res, iw, w
    return made


def _external(step: Step) -> _External:
    """Return a call of an external function; one without machine code is left to Python."""
    own, evaluate, derivative = getattr(step.function, "native", None) or (0, 0, 0)
    generated = _generated(step.inputs)
    arrays = (step.inputs.result, step.key, step.known)
    addresses = [array.ctypes.data for array in arrays]
    results = [array.ctypes.data for array in (step.outputs, step.slopes)]
    made = _External(generated, *addresses, step.key.nbytes, own, evaluate, derivative, *results)
    made.keep = generated, step
    return made


def _parts(function: object) -> tuple[Any, list[Step]]:
    """Return a kernel, and the calls before it."""
    if isinstance(function, Prepared):
        return function.kernel, list(function.steps)
    return function, []


def _is_compiled(function: object) -> bool:
    """Whether a kernel is machine code, and so are the inputs of all calls before it."""
    kernel, steps = _parts(function)
    kernels = [kernel, *(step.inputs for step in steps)]
    return all(isinstance(k, Kernel) and hasattr(k.function, "library") for k in kernels)
