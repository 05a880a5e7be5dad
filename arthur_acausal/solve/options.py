"""What a run may be told: tolerances, output, limits. Times in seconds."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal

import numpy as np

from arthur_acausal.errors import UsageError, nearest
from arthur_acausal.solve.protocol import BoolArray, FloatArray

ATOL_OVER_RTOL = 0.01  # default absolute tolerance of a variable, in units of rtol times its nominal value
# See `SolverOptions.step_rtol`.
CALIBRATED_BELOW = 1e-6
HIGHEST_ORDER = 5  # of BDF: tight tolerances use it
LEAST_CALIBRATED = 1e-13  # tighter, rounding takes over


@dataclass(frozen=True, slots=True)
class SolverOptions:
    """Options of one simulation.

    Attributes
    ----------
    rtol : relative tolerance; below 1e-6, that of a step is tighter (`step_rtol`).
    atol : absolute tolerance in the variables' own units: None for 0.01 rtol nominal, a number for all
        variables, or a mapping of paths to numbers (the rest stay at the default).
    intervals : the output grid has this many equal intervals.
    output_interval : length of an output interval, s; overrides `intervals`.
    store_steps : store the integrator's own steps in place of the output grid.
    first_step : s; None lets the solver estimate it at the start and after every event.
    max_step : s; None for no bound.
    max_order : highest BDF order, 1 to 5.
    max_steps : total number of steps after which the run fails.
    linear_solver : "dense", "sparse", or "auto": dense up to 200 unknowns.
    newton_tolerance : largest relative correction at which the initial and event equations count as solved.
    newton_iterations : most Newton iterations of an initialisation.
    max_event_iterations : most passes until the relations and discrete variables of one event must agree.
    chattering_events, chattering_window : this many events within this part of the run's length are an error; a
        window of 0 lets them be.
    zeno_interval : state events that close up to below this part of the run's length are an error; 0 lets them be.
    """

    rtol: float = 1e-6
    atol: float | Mapping[str, float] | None = None
    intervals: int = 500
    output_interval: float | None = None
    store_steps: bool = False
    first_step: float | None = None
    max_step: float | None = None
    max_order: int = HIGHEST_ORDER
    max_steps: int = 1_000_000
    linear_solver: Literal["auto", "dense", "sparse"] = "auto"
    newton_tolerance: float = 1e-10
    newton_iterations: int = 100
    max_event_iterations: int = 100
    chattering_events: int = 100
    chattering_window: float = 1e-9
    zeno_interval: float = 1e-10

    def __post_init__(self) -> None:
        _within("rtol", self.rtol, 1e-15, 0.1)
        for name in ("output_interval", "first_step", "max_step"):
            if getattr(self, name) is not None:
                _positive(name, getattr(self, name))
        _positive("newton_tolerance", self.newton_tolerance)
        for name in ("chattering_window", "zeno_interval"):
            _within(name, getattr(self, name), 0.0, 1.0)
        for name in (
            "intervals",
            "max_steps",
            "newton_iterations",
            "max_event_iterations",
            "chattering_events",
        ):
            _count(name, getattr(self, name))
        _count("max_order", self.max_order, HIGHEST_ORDER)
        if self.linear_solver not in ("auto", "dense", "sparse"):
            raise UsageError(
                f"linear_solver is {self.linear_solver!r}", remedy='choose "auto", "dense" or "sparse"'
            )
        values = self.atol.items() if isinstance(self.atol, Mapping) else [("", self.atol)]
        for path, value in values:
            if value is not None:
                _positive(f"atol of {path}" if path else "atol", value)

    @property
    def step_rtol(self) -> float:
        """Relative tolerance of a single step, such that the error of a whole run is proportional to `rtol`.

        At order k the number of steps goes as tol^(-1/(k+1)), and so do the errors that add up: the error at the end
        goes as tol^(k/(k+1)), at 1e-10 it is six times what 1e-6 promises. What the solver is told makes up for this.
        Shampine (1989), "Tolerance proportionality in ODE codes", LNM 1386; Soederlind and Wang (2006), J. Comput.
        Appl. Math. 185, 244-260.
        """
        if self.rtol >= CALIBRATED_BELOW:
            return self.rtol
        calibrated: float = CALIBRATED_BELOW * (self.rtol / CALIBRATED_BELOW) ** (1.0 + 1.0 / HIGHEST_ORDER)
        return max(calibrated, min(self.rtol, LEAST_CALIBRATED))

    def replace(self, **changes: Any) -> SolverOptions:
        """A copy with some options changed; an unknown name is a UsageError."""
        known = set(self.__slots__)
        for name in changes:
            if name not in known:
                raise UsageError(f"there is no solver option {name!r}", remedy=nearest(name, known))
        return replace(self, **changes)

    def as_dict(self) -> dict[str, Any]:
        """The options by name, ready for JSON."""
        return asdict(self)

    def grid(self, start_time: float, stop_time: float) -> FloatArray:
        """The output times, both ends included."""
        if self.output_interval is None:
            return np.linspace(start_time, stop_time, self.intervals + 1)
        # The last interval may be shorter; a remainder of rounding size is none.
        number = math.ceil((stop_time - start_time) / self.output_interval - 1e-9)
        times = start_time + self.output_interval * np.arange(number + 1)
        times[-1] = stop_time
        return np.asarray(times, dtype=np.float64)

    def absolute_tolerances(self, paths: list[str], nominal: FloatArray) -> FloatArray:
        """The vector of a step's absolute tolerances of the unknowns with these paths and nominal values.

        They are tighter than `atol` by as much as `step_rtol` is than `rtol`.
        """
        share = self.step_rtol / self.rtol
        if isinstance(self.atol, float | int):
            return np.full(len(paths), share * self.atol)
        atol = ATOL_OVER_RTOL * self.step_rtol * np.abs(nominal)
        if self.atol is not None:
            where = {path: index for index, path in enumerate(paths)}
            for path, value in self.atol.items():
                if path not in where:
                    raise UsageError(
                        f"atol is given for {path!r}, which is no unknown of the solver",
                        remedy=nearest(path, paths),
                    )
                atol[where[path]] = share * value
        return atol

    def given_tolerances(self, paths: list[str]) -> BoolArray:
        """Which of these unknowns have an absolute tolerance of their own."""
        if isinstance(self.atol, float | int):
            return np.ones(len(paths), dtype=bool)
        return np.array([path in (self.atol or {}) for path in paths], dtype=bool)


def _number(name: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float | np.number) or not math.isfinite(value):
        raise UsageError(f"{name} is {value!r}, not a finite number")
    return float(value)


def _positive(name: str, value: object) -> None:
    if _number(name, value) <= 0.0:
        raise UsageError(f"{name} is {value}, not positive")


def _within(name: str, value: object, low: float, high: float) -> None:
    if not low <= _number(name, value) <= high:
        raise UsageError(f"{name} is {value}, not between {low:g} and {high:g}")


def _count(name: str, value: object, most: int | None = None) -> None:
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < 1:
        raise UsageError(f"{name} is {value!r}, not a whole number above zero")
    if most is not None and value > most:
        raise UsageError(f"{name} is {value}, above {most}")
