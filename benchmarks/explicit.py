"""Compiled explicit Euler and Runge-Kutta 4 at their largest stable step: what a fixed-step C program costs.

The rates come from CasADi's C generator; the loop is `explicit.c`; both are compiled by `cc -O2`.
"""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import casadi
import numpy as np
from numpy.typing import NDArray

from benchmarks.powertrain_byhand import Flat

Array = NDArray[np.float64]
LOOP = Path(__file__).with_name("explicit.c")
# An end state further off than this part of a variable's range counts as unstable: less would rule out steps at
# which the weakly damped reservoir merely rings on, more would let the relief valve chatter in bounds.
UNSTABLE = 0.02


@dataclass(frozen=True, slots=True)
class Explicit:
    """A method's step [s], the wall time [s] of its run, the end state's error relative to the ranges."""

    step_s: float
    wall_s: float
    error: float


@dataclass(frozen=True, slots=True)
class Program:
    """The compiled loop and where it starts and should end: x and z, concatenated."""

    executable: Path
    start: Array
    end: Array
    scale: Array
    stop_time: float

    def run(self, method: str, step: float) -> Explicit:
        """Integrate with steps of (nearly) `step`; the error is infinite where the run blew up."""
        steps = max(1, round(self.stop_time / step))
        command = [str(self.executable), method, str(steps), repr(self.stop_time)]
        done = subprocess.run(command, input=self.start.tobytes(), capture_output=True, check=True)
        x = np.frombuffer(done.stdout)[: len(self.end)]
        error = float(np.max(np.abs(x - self.end) / self.scale)) if np.all(np.isfinite(x)) else np.inf
        return Explicit(self.stop_time / steps, float(done.stderr), error)


def rates(flat: Flat) -> casadi.Function:
    """Return (t, x, z) -> (x', next z): one Newton step on the filter's loop, then the rates."""
    jacobian = casadi.jacobian(flat.alg, flat.z)
    z_next = flat.z - casadi.solve(jacobian, flat.alg)
    dx = casadi.substitute(flat.ode, flat.z, z_next)
    return casadi.Function("rates", [flat.t, flat.x, flat.z], [casadi.densify(dx), z_next])


@contextmanager
def compiled(flat: Flat, end: Array, scale: Array, stop_time: float) -> Iterator[Program]:
    """Compile the loop for these equations in a temporary folder. Needs a C compiler (`cc`)."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None:
        raise FileNotFoundError("no C compiler (cc, gcc)")
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        generator = casadi.CodeGenerator("rates.c")
        function = rates(flat)
        generator.add(function)
        generator.generate(str(place) + "/")
        sizes = [function.sz_arg(), function.sz_res(), function.sz_iw(), function.sz_w()]
        names = ["ARG", "RES", "IW", "W"]
        defines = [f"-Drates_SZ_{name}={size}" for name, size in zip(names, sizes, strict=True)]
        program = place / "explicit"
        command = [compiler, "-O2", *defines, f"-DNX={len(flat.x0)}", f'-DRATES="{place}/rates.c"']
        subprocess.run([*command, str(LOOP), "-o", str(program), "-lm"], check=True)
        start = np.concatenate([flat.x0, flat.z0])
        yield Program(program, start, end, scale, stop_time)


def largest_stable(program: Program, method: str, guess: float, refinements: int = 3) -> Explicit:
    """Return the run at the largest stable step found: powers of 1.5 about `guess`, then bisection."""
    good, bad = guess, guess
    best = program.run(method, good)
    while best.error > UNSTABLE:
        bad, good = good, good / 1.5
        best = program.run(method, good)
    while bad <= good:
        trial = program.run(method, good * 1.5)
        if trial.error > UNSTABLE:
            bad = good * 1.5
        else:
            good, best = good * 1.5, trial
    for _ in range(refinements):
        middle = (good * bad) ** 0.5
        trial = program.run(method, middle)
        if trial.error > UNSTABLE:
            bad = middle
        else:
            good, best = middle, trial
    return best
