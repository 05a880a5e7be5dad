"""CasADi functions called at the least cost: on pinned arrays, and as machine code where that pays.

Measured with gcc 12 on two shared cores, for the residual (2,050 instructions) and the Jacobian (2,864, 384 entries)
of a rig of 12 hydraulic legs; the time to compile is that of both and the roots, the least of several tries:

=====================================  ========  ========  =======
what                                   residual  Jacobian  compile
=====================================  ========  ========  =======
CasADi's virtual machine                 5.5 us    8.1 us
its C code as it comes, -O0              4.9 us    7.5 us   440 ms
its C code as it comes, -O1              1.6 us    2.3 us   730 ms
straightened, -O1                        1.5 us    2.3 us   380 ms
straightened, -Og                        1.5 us    2.3 us   310 ms
straightened, -Og, in two processes      1.5 us    2.3 us   220 ms
from the cache                           1.5 us    2.3 us     5 ms
=====================================  ========  ========  =======

CasADi's text tests at each access whether an array is there, which splits straight code into thousands of basic
blocks. Here the arrays are tested once. The time of compiling the straightened code is linear, near 0.1 ms an
instruction up to 80,000 (8 s), so that nothing need be cut into pieces. -O2 and further flags gained nothing at run
time. All variants agreed with the virtual machine to the last bit. A call through `Kernel` costs 0.15 us besides.
"""

from __future__ import annotations

import functools
import logging
import math
import os
import re
import shlex
import shutil
import subprocess
import threading
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Literal

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from arthur_acausal.codegen.cache import Cache, default_cache, make_key
from arthur_acausal.errors import ArthurError, UsageError

LOGGER = logging.getLogger("arthur_acausal")
FloatArray = NDArray[np.float64]

# Instructions in all, between which compiling pays: below there is little to gain, above it takes too long.
LEAST, MOST = 200, 12000
# With external functions, and for many runs, more pays: of a MuJoCo robot (21,000, 2 s to compile) a simulated second
# takes 0.7 s less, a third, for the interpreter leaves the integrator's loop.
MOST_OF_LONG_RUNS = 60000
_UNIT = 1500  # instructions that are worth a compiler process of their own
# Never -march=native, never contraction: the same bits on every machine. errno of sqrt is nobody's concern.
_FLAGS = ("-Og", "-fPIC", "-shared", "-ffp-contract=off", "-fno-math-errno")
_TIMEOUT = 600.0  # s
_GENERATING = threading.Lock()  # CasADi counts references without locks


class Kernel:
    """A function on arrays that stay: write the inputs in place, call, read the outputs.

    Parameters
    ----------
    function
        Its inputs and outputs are taken by their nonzeros: all elements of a dense vector, the entries of a sparse
        matrix column by column.
    inputs
        A contiguous float64 array for each input, read at each call.

    A call returns the array of the first output, always the same one; ``outputs`` has all of them. A kernel has
    memory of its own; it must not be called by two threads at once.

    Raises
    ------
    ValueError
        When an array does not fit its input.
    RuntimeError
        By a call, when the function reports a failure.
    """

    __slots__ = ("_buffer", "_checked", "_trigger", "_views", "function", "inputs", "outputs", "result")

    def __init__(self, function: ca.Function, inputs: Sequence[FloatArray]) -> None:
        self.function = function
        self.inputs = tuple(inputs)
        self.outputs: tuple[FloatArray, ...] = tuple(
            np.zeros(function.nnz_out(i)) for i in range(function.n_out())
        )
        self.result = self.outputs[0]
        self._check_inputs()
        # CasADi keeps nothing alive: neither the arrays nor, for the trigger, the buffer itself.
        self._buffer: Any
        self._buffer, self._trigger = function.buffer()
        self._views = [array.data for array in (*self.inputs, *self.outputs)]  # these forbid resizing, too
        for i in range(function.n_in()):
            self._buffer.set_arg(i, self._views[i])
        for i in range(function.n_out()):
            self._buffer.set_res(i, self._views[function.n_in() + i])
        # What is made of scalar operations cannot fail; asking each time would cost 0.5 us.
        self._checked = not (function.is_a("SXFunction") or isinstance(function, _Compiled))

    def __call__(self) -> FloatArray:
        self._trigger()
        if self._checked and self._buffer.ret():
            raise RuntimeError(f"{self.function.name()} reports failure {self._buffer.ret()}")
        return self.result

    def _check_inputs(self) -> None:
        f = self.function
        if len(self.inputs) != f.n_in():
            raise ValueError(f"{f.name()} has {f.n_in()} inputs, not {len(self.inputs)}")
        for i, array in enumerate(self.inputs):
            fits = isinstance(array, np.ndarray) and array.dtype == np.float64 and array.flags.c_contiguous
            if not fits or array.size != f.nnz_in(i):
                raise ValueError(
                    f"input {f.name_in(i)} of {f.name()} needs a contiguous float64 array of {f.nnz_in(i)} elements"
                )


class _Compiled(ca.Function):
    """A function of a ``library`` made here; it fails for absent arrays only, which a kernel never passes."""

    library: Path


def load_library(name: str, library: Path) -> ca.Function:
    """Return the function of this name out of a library that this module has made."""
    function = _Compiled(ca.external(name, str(library)))
    function.library = library
    return function


def compile_functions(
    functions: Sequence[ca.Function],
    *,
    mode: Literal["auto", "often", "always", "never"] | str = "auto",
    long_runs: bool = False,
    cache: Cache | None = None,
) -> list[ca.Function]:
    """Return the functions as machine code, or as they are.

    Only functions of scalar expressions (SX) are compiled. ``mode`` "auto" does it if the machine has a C compiler and
    the instructions in all are between `LEAST` and `MOST`, or `MOST_OF_LONG_RUNS` for ``long_runs``, and falls back to
    the virtual machine with a warning; "often" does it for few instructions and for as many as for long runs; "always"
    raises instead; "never" does nothing. Libraries are kept in ``cache``, by default the user's.

    Raises
    ------
    UsageError
        In mode "always", when there is no compiler.
    ArthurError
        In mode "always", when it fails.
    """
    plain = [f for f in functions if f.is_a("SXFunction") and f.n_instructions()]
    work = sum(f.n_instructions() for f in plain)
    least, most = 0 if mode == "often" else LEAST, MOST_OF_LONG_RUNS if long_runs or mode == "often" else MOST
    if mode == "never" or not plain or (mode != "always" and not least <= work <= most):
        return list(functions)
    command = compiler()
    if command is None:
        if mode == "always":
            raise UsageError("no C compiler was found", remedy="install gcc or clang, or name one in CC")
        return list(functions)
    try:
        compiled = _load_all(_units(plain), command, cache or default_cache())
    except (OSError, RuntimeError, subprocess.SubprocessError) as error:
        cause = f"{error}\n{getattr(error, 'stderr', None) or ''}".strip()
        if mode == "always":
            raise ArthurError("the generated C code cannot be used", cause=cause) from error
        LOGGER.warning("the generated C code cannot be used, going on with the virtual machine: %s", cause)
        return list(functions)
    return [compiled.get(f.name(), f) for f in functions]


def compiler() -> tuple[str, ...] | None:
    """Return the command of the C compiler: that of the environment variable CC, else cc, gcc or clang; or None."""
    for command in (os.environ.get("CC", ""), "cc", "gcc", "clang"):
        words = shlex.split(command)
        if words and shutil.which(words[0]):
            return tuple(words)
    return None


def _identity(command: tuple[str, ...]) -> str:
    """Return what changes when the compiler does; asking it for its version would cost milliseconds."""
    program = os.path.realpath(shutil.which(command[0]) or command[0])
    status = os.stat(program)
    return " ".join((*command, program, str(status.st_size), str(status.st_mtime_ns)))


def _units(functions: list[ca.Function]) -> list[list[ca.Function]]:
    """Spread the functions evenly over units for compilers that run at the same time: largest first."""
    work = sum(f.n_instructions() for f in functions)
    count = max(1, min(os.cpu_count() or 1, len(functions), math.ceil(work / _UNIT)))
    units: list[list[ca.Function]] = [[] for _ in range(count)]
    loads = [0] * count
    for f in sorted(functions, key=lambda f: -f.n_instructions()):
        lightest = loads.index(min(loads))
        units[lightest].append(f)
        loads[lightest] += f.n_instructions()
    return units


def _load_all(
    units: list[list[ca.Function]], command: tuple[str, ...], cache: Cache
) -> dict[str, ca.Function]:
    """Compile the units, or find them in the cache; return the functions by name."""
    # The functions themselves are hashed, and this file: to generate the C text takes four times as long.
    surroundings = (_identity(command), *_FLAGS, Path(__file__).read_bytes())
    keys = [make_key(*surroundings, *(f.serialize() for f in unit)) for unit in units]

    def library(key: str, unit: list[ca.Function]) -> Path:
        return cache.path_of_library(key, functools.partial(_compile, unit, command))

    if len(units) == 1:
        paths = [library(keys[0], units[0])]
    else:
        with ThreadPoolExecutor(len(units)) as pool:
            paths = list(pool.map(library, keys, units))
    return {
        f.name(): load_library(f.name(), path) for unit, path in zip(units, paths, strict=True) for f in unit
    }


def _compile(functions: list[ca.Function], command: tuple[str, ...], path: Path) -> None:
    """Compile functions to the shared library ``path``."""
    text = path.with_suffix(".c")
    with _GENERATING:
        text.write_text(c_source(functions))
    subprocess.run(
        [*command, *_FLAGS, str(text), "-o", str(path), "-lm"],
        check=True,
        capture_output=True,
        text=True,
        stdin=subprocess.DEVNULL,
        timeout=_TIMEOUT,
    )


def c_source(functions: Sequence[ca.Function]) -> str:
    """Return one C text with all the functions, straightened where they are of scalar operations only."""
    generator = ca.CodeGenerator("arthur", {"with_header": False, "main": False})
    for f in functions:
        generator.add(f)
    source: str = generator.dump()
    if len(_DEFINITION.findall(source)) != len(functions):  # they call others, perhaps with absent arrays
        return source
    head, *rest = _DEFINITION.split(source)
    parts = [_INLINE.sub("static inline casadi_real casadi_", head)]
    for definition, body in zip(rest[::2], rest[1::2], strict=True):
        parts += definition, _straightened(body)
    return "".join(parts)


_DEFINITION = re.compile(r"^(static int casadi_f\d+\(.*\) \{\n)", re.MULTILINE)
_INLINE = re.compile(r"^casadi_real casadi_", re.MULTILINE)
_INPUT = re.compile(r"\barg\[(\d+)\]\? arg\[\1\]\[(\d+)\] : 0\b")
_OUTPUT = re.compile(r"\bif \(res\[(\d+)\]!=0\) res\[\1\]\[(\d+)\]=")


def _straightened(body: str) -> str:
    """Test and fetch the pointers of arguments and results once, ahead of the statements."""
    inputs = sorted({int(i) for i, _ in _INPUT.findall(body)})
    outputs = sorted({int(i) for i, _ in _OUTPUT.findall(body)})
    pointers = [f"  const casadi_real* x{i}=arg[{i}];\n" for i in inputs]
    pointers += [f"  casadi_real* r{i}=res[{i}];\n" for i in outputs]
    absent = [f"!x{i}" for i in inputs] + [f"!r{i}" for i in outputs]
    if absent:
        pointers.append(f"  if ({' || '.join(absent)}) return 1;\n")
    body = _INPUT.sub(r"x\1[\2]", body)
    return "".join(pointers) + _OUTPUT.sub(r"r\1[\2]=", body)
