"""Compiled fixed-step integration of the robot's trot, and co-simulation with MuJoCo: see quadruped_fixed.c."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import casadi as ca
import mujoco
import numpy as np
from numpy.typing import NDArray

from benchmarks.quadruped_equations import Explicit, explicit
from benchmarks.quadruped_problem import PERIOD, Cost, Problem

Array = NDArray[np.float64]
SOURCE = Path(__file__).with_suffix(".c")
FLAGS = ("-march=native", "-fno-math-errno")
# the generated functions are one long line of operations, where more than -O1 takes a minute and brings nothing


@dataclass(frozen=True, slots=True)
class Program:
    """The compiled program, MuJoCo's model, and the trot that it integrates."""

    executable: Path
    model: Path
    trot: Problem

    def states(self, method: str, h: float, exchange: float, every: int, ticks: int) -> tuple[Array, float]:
        """Return the states at the start and after each sample, and the CPU time of the loop [s]."""
        trot = self.trot
        outputs = list(trot.translation.dae.samples[0].outputs)
        z = np.tile(trot.begin.z[-1], (ticks, 1))
        first = round(trot.start_time / PERIOD)
        for k in range(ticks):
            z[k, outputs] = trot.tape.rows[first + k]
        steps = round(PERIOD / h)
        words = [method, str(self.model), repr(trot.start_time), str(ticks), str(steps), repr(exchange)]
        begin, n = trot.begin, int(np.sum(trot.translation.dae.differential))
        w = np.concatenate([begin.yp[-1, :n], begin.y[-1, n:]])
        done = subprocess.run(
            [str(self.executable), *words, str(every)],
            input=begin.y[-1, :n].tobytes() + w.tobytes() + z.tobytes(),
            capture_output=True,
            check=True,
            cwd=self.model.parent,  # where MuJoCo leaves its log
        )
        return np.frombuffer(done.stdout).reshape(ticks + 1, -1), float(
            done.stderr.split()[-1]
        )  # MuJoCo's warnings come before

    def run(self, method: str, h: float, *, exchange: float = PERIOD, every: int = 1, ticks: int = 0) -> Cost:
        """Integrate over the whole duration, or ``ticks`` samples."""
        ticks = ticks or round(self.trot.duration / PERIOD)
        begun = time.perf_counter()
        y, cpu = self.states(method, h, exchange, every, ticks)
        wall = time.perf_counter() - begun
        return Cost(cpu / (ticks * PERIOD), wall / (ticks * PERIOD), y[:, self.trot.joints])

    def largest_stable(self, method: str, guess: float, reference: Array, ticks: int) -> float:
        """Return the largest step [s], of those that divide the period, at which the joints stay near the reference."""

        def stable(steps: int) -> bool:
            joints = self.run(method, PERIOD / steps, ticks=ticks).joints
            return bool(np.max(np.abs(joints - reference[: ticks + 1])) < UNSTABLE)

        bad, good = 0, round(PERIOD / guess)
        while not stable(good):
            bad, good = good, round(good * 1.5)
        while good - bad > 0.1 * good:
            middle = (good + bad) // 2 if bad else round(good / 1.5)
            if stable(middle):
                good = middle
            else:
                bad = middle
        return PERIOD / good


UNSTABLE = 0.01
"""A joint further off than this after the few samples of the search [rad]: the method is unstable."""


def constants(equations: Explicit, trot: Problem) -> list[str]:
    """Return what the C program has to know, as definitions."""
    dae = trot.translation.dae
    layout = dae.calls[0].function.dynamics.layout
    number = {path: k for k, path in enumerate(dae.y_paths)}
    q, v = [0] * layout.n_q, [0] * layout.n_v
    for joint in layout.joints:
        names = [f"{joint.name}_phi"], [f"{joint.name}_w"]
        if joint.kind == "free":
            names = (
                [*(f"base_{x}" for x in "xyz"), *(f"base_q_{x}" for x in "wxyz")],
                [*(f"base_v_{x}" for x in "xyz"), *(f"base_w_{x}" for x in "xyz")],
            )
        for k, name in enumerate(names[0]):
            q[joint.q + k] = number[f"body.{name}"]
        for k, name in enumerate(names[1]):
            v[joint.v + k] = number[f"body.{name}"]
    lists = {"DOFS": [j.v for j in layout.flanges], "QPOS": q, "QVEL": v}
    f = equations.rates
    sizes = {"NX": f.size1_in(1), "NY": f.size1_out(0), "NZ": f.size1_in(2), "NV": f.size1_in(3)}
    sizes |= {"NQ": layout.n_q, "NTAU": len(layout.flanges)}
    return [
        f"-DPERIOD={PERIOD!r}",
        *(f"-D{name}={size}" for name, size in sizes.items()),
        *(f"-D{name}={{{','.join(map(str, values))}}}" for name, values in lists.items()),
    ]


@contextmanager
def compiled(trot: Problem) -> Iterator[Program]:
    """Compile the program in a temporary folder. Needs a C compiler (`cc`)."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None:
        raise FileNotFoundError("no C compiler (cc, gcc)")
    equations = explicit(trot)
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        generator = ca.CodeGenerator("equations.c", {"with_header": True})
        for function in (equations.forces, equations.rates, equations.slopes):
            generator.add(function)
        generator.generate(f"{place}/")
        model = place / "robot.mjb"
        mujoco.mj_saveModel(trot.translation.dae.calls[0].function.dynamics.model, str(model), None)
        package = Path(mujoco.__file__).parent
        library = next(package.glob("libmujoco.*"))
        program = place / "fixed"
        part = place / "equations.o"
        subprocess.run(
            [compiler, *FLAGS, "-O1", "-c", str(part.with_suffix(".c")), "-o", str(part)], check=True
        )
        words = [*FLAGS, "-O3", f"-I{package / 'include'}", f'-DEQUATIONS="{place}/equations.h"']
        words += [*constants(equations, trot), str(SOURCE), str(part), "-o", str(program), str(library)]
        subprocess.run([compiler, *words, "-lm", f"-Wl,-rpath,{package}"], check=True)
        yield Program(program, model, trot)
