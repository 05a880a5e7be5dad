"""The robot's trot as an open problem: every method integrates the same equations from the same checkpoint.

The controller runs once, in a run at a tight tolerance, and what it returns at each sample is kept on a tape. All
methods then take their set points from the tape, so that they differ by their errors only: with the loop closed, the
controller would see, and answer, each method's own errors.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import SolverOptions, Translation, translate
from arthur_acausal.codegen.compiled import CompiledDAE
from arthur_acausal.models.arthur.dimensions import JOINT_NAMES
from arthur_acausal.models.arthur.locomotion.commands import Command, Constant
from arthur_acausal.models.arthur.locomotion.controller import Configuration
from arthur_acausal.models.arthur.quadruped import Quadruped
from arthur_acausal.models.arthur.walking import Walking
from arthur_acausal.solve.simulate import initial_point, simulate
from arthur_acausal.solve.trajectory import Trajectory

Array = NDArray[np.float64]
PERIOD = 0.002  # of the controller [s]
SPEED = 0.5  # of the trot [m/s]
RECORDING = 1e-6  # rtol of the run that makes the checkpoint and the tape


class Tape:
    """A controller whose outputs are kept by the number of the sample, and given again when it comes round."""

    def __init__(self, controller: Walking) -> None:
        self._controller = controller
        self.rows: dict[int, Array] = {}

    def fresh(self) -> Tape:
        """Return this tape with its controller in the initial state."""
        self._controller = self._controller.fresh()
        return self

    def __call__(self, t: float, sensors: Array) -> Array:
        number = round(t / PERIOD)
        if number not in self.rows:
            self.rows[number] = self._controller(t, sensors)
        return self.rows[number]


@dataclass(frozen=True, slots=True)
class Cost:
    """Of an integration: CPU and wall seconds for a simulated second, and the joints (samples, 12) [rad]."""

    cpu_s_per_s: float
    wall_s_per_s: float
    joints: Array


@dataclass(frozen=True, slots=True)
class Problem:
    """The trot from a checkpoint on: the system, its tape, the state at ``begin.t[-1]``, the duration [s]."""

    translation: Translation
    tape: Tape
    begin: Trajectory
    duration: float

    @property
    def start_time(self) -> float:
        return float(self.begin.t[-1])

    @property
    def times(self) -> Array:
        """When the joints are compared: at each sample [s]."""
        return self.start_time + PERIOD * np.arange(round(self.duration / PERIOD) + 1.0)

    @property
    def joints(self) -> list[int]:
        """Where y holds the angles of the joints."""
        paths = self.translation.dae.y_paths
        return [paths.index(f"body.{joint}_phi") for joint in JOINT_NAMES]

    def ours(self, rtol: float) -> Cost:
        """Integrate by IDA."""
        trajectory, cpu, wall = timed(
            lambda: simulate(
                self.translation.dae,
                start_time=self.start_time,
                stop_time=self.start_time + self.duration,
                options=SolverOptions(rtol=rtol),
                grid=self.times,
                begin=self.begin,
            )
        )
        last = np.searchsorted(trajectory.t, self.times + 1e-9, side="right") - 1
        return Cost(cpu / self.duration, wall / self.duration, trajectory.y[last][:, self.joints])


def timed(run: Callable[[], Any]) -> tuple[Any, float, float]:
    """Return what a call returns, its CPU time and its wall time [s]."""
    wall, cpu = time.perf_counter(), time.process_time()
    result = run()
    return result, time.process_time() - cpu, time.perf_counter() - wall


def trotting() -> Walking:
    """Return the controller of the trot."""
    return Walking(Configuration(commands=Constant(Command(v_x=SPEED))))


def problem(warm_up: float, duration: float) -> Problem:
    """Trot for the time ``warm_up`` [s], and on for ``duration`` [s] with the controller's outputs on the tape."""
    tape = Tape(trotting())
    translation = translate(Quadruped(controller=tape), compile="always")
    end = warm_up + duration
    run = simulate(
        translation.dae,
        stop_time=end,
        options=SolverOptions(rtol=RECORDING),
        grid=np.array([0.0, warm_up, end]),
    )
    if run.status != "finished":
        raise SystemExit(f"the robot does not trot: {run.message}")
    rows = slice(0, int(np.searchsorted(run.t, warm_up + 1e-9)))
    values = {name: getattr(run, name)[rows] for name in ("t", "y", "yp", "u", "z", "m")}
    return Problem(translation, tape, replace(run, **values), duration)


def realtime(
    duration: float, watched: Callable[[], AbstractContextManager[object]] = nullcontext
) -> tuple[CompiledDAE, float, float]:
    """Return the system, CPU and wall seconds for a simulated second of the trot at rtol 1e-4.

    The controller is in the loop. From the initial values on; translation and initialisation are not part of it.
    """
    dae = translate(Quadruped(controller=trotting()), compile="always").dae
    begin = initial_point(dae, stop_time=duration)
    options = SolverOptions(rtol=1e-4, intervals=100)

    def run() -> None:
        with watched():
            simulate(dae, stop_time=duration, options=options, begin=begin)

    _, cpu, wall = timed(run)
    return dae, cpu / duration, wall / duration
