"""A small solution made by hand: a mass that bounces once, whose every value is known in closed form."""

from __future__ import annotations

import resource
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from arthur_acausal.result.interpolate import FloatArray
from arthur_acausal.result.run import Run
from arthur_acausal.result.solution import Solution
from arthur_acausal.result.variable import Variable
from arthur_acausal.solve.trajectory import Event


class Table:
    """Values (see `result.solution.Values`) given column by column."""

    def __init__(
        self,
        t: FloatArray,
        columns: Mapping[str, FloatArray],
        variables: Mapping[str, Variable],
        slopes: Mapping[str, FloatArray] | None = None,
        modes: FloatArray | None = None,
    ) -> None:
        self.t = t
        self.modes = np.empty((t.size, 0)) if modes is None else modes
        self.variables = variables
        self.asked: list[str] = []
        self._columns = columns
        self._slopes = slopes or {}

    def observe(self, paths: Sequence[str]) -> FloatArray:
        self.asked += paths
        return np.column_stack([np.broadcast_to(self._columns[path], self.t.shape) for path in paths])

    def slope(self, state: str) -> FloatArray | None:
        return self._slopes.get(state)


@dataclass(frozen=True)
class Statistics:
    """Some of what a solver counts."""

    steps: int = 42
    wall_time: float = 0.125


VARIABLES = {
    variable.path: variable
    for variable in (
        Variable("ball.h", "m", "state", "height", state="ball.h"),
        Variable("ball.v", "m/s", "state", "velocity", display="km/h", state="ball.v"),
        Variable("floor.gap", "m", "alias", state="ball.h", sign=-1.0),
        Variable("valves[0].port_a.p", "Pa", "algebraic", "pressure at port a", display="bar"),
        Variable("valves[1].port_a.p", "Pa", "algebraic", "pressure at port a", display="bar"),
        Variable("valves[0].I", "A", "input", "current"),
        Variable("valves[1].I", "A", "input", "current"),
        Variable("ball.bounces", "1", "discrete", "number of bounces"),
        Variable("ball.g", "m/s^2", "parameter", "gravity"),
        Variable("größe.ω", "rad/s", "algebraic", "Winkelgeschwindigkeit — schnell", display="rpm"),
    )
}


def bounce() -> Solution:
    """Fall from 1 m at g = 2 m/s^2, bounce elastically at t = 1 s, rise until t = 2 s."""
    return Solution(bounce_values(), bounce_run())


def bounce_values() -> Table:
    t = np.array([0.0, 0.25, 0.5, 1.0, 1.0, 1.5, 2.0])
    after = np.arange(t.size) >= 4
    speed = np.where(after, 2.0 - 2.0 * (t - 1.0), -2.0 * t)
    height = np.where(after, 2.0 * (t - 1.0) - (t - 1.0) ** 2, 1.0 - t**2)
    columns = {
        "ball.h": height,
        "ball.v": speed,
        "floor.gap": -height,
        "valves[0].port_a.p": 1e5 * (1.0 + t),
        "valves[1].port_a.p": 2e5 * (1.0 + t),
        "valves[0].I": np.sin(t),
        "valves[1].I": np.cos(t),
        "ball.bounces": after.astype(float),
        "ball.g": np.array(2.0),
        "größe.ω": 100.0 * t,
    }
    slopes = {"ball.h": speed, "ball.v": np.full_like(t, -2.0)}
    return Table(t, columns, VARIABLES, slopes, modes=np.column_stack([after, ~after]).astype(float))


def bounce_run() -> Run:
    return Run(
        model="Bounce",
        description="A ball on a floor",
        stop_time=2.0,
        message="reached the stop time",
        parameters={"ball.g": 2.0},
        options={"rtol": 1e-6, "linear_solver": "dense"},
        statistics=Statistics(),
        events=(Event(1.0, "h < 0 became true", "ball"),),
    )


@contextmanager
def disk_of(size: int) -> Iterator[None]:
    """Let no file grow beyond ``size`` bytes, as on a full disk."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
