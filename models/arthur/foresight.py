"""How well the flow is foreseen: what the locomotion controller planned against what the legs then took."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.models.arthur.demand import Demand

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

PER_MINUTE = 60e3
"""Litres a minute in a m^3/s."""


@dataclass(frozen=True, slots=True, eq=False)
class ForesightError:
    """Errors of the foreseen flow by how far it looks ahead.

    Attributes
    ----------
    ahead : look-ahead [s] (points,). planned, bias : rms and mean of the plan's error [m^3/s]. held : rms error of who
        takes the present flow to last [m^3/s]. constant : rms error of who knows the mean only [m^3/s].
    mean : of the flow that was taken [m^3/s].
    """

    ahead: FloatArray
    planned: FloatArray
    bias: FloatArray
    held: FloatArray
    constant: FloatArray
    mean: float

    def table(self) -> str:
        """Return the errors as text, in litres a minute."""
        lines = [f"mean flow {self.mean * PER_MINUTE:.2f} L/min; rms errors in L/min"]
        lines.append(f"{'ahead ms':>8} {'planned':>8} {'bias':>8} {'held':>8} {'constant':>8}")
        for row in zip(self.ahead, self.planned, self.bias, self.held, self.constant, strict=True):
            numbers = " ".join(f"{x * PER_MINUTE:8.3f}" for x in row[1:])
            lines.append(f"{row[0] * 1e3:8.0f} {numbers}")
        return "\n".join(lines)


def foresight_error(demand: Demand, *, begin: float = 0.0, window: float = 0.02) -> ForesightError:
    """Return how far the planned flow was from the one that was taken, from the time ``begin`` [s] on.

    Both count as means over ``window`` [s] about the moment that is foreseen, as what is shorter the accumulator
    bridges: the plan is linear between its points, and held at its ends. The present flow is the mean of the window
    that ends now.
    """
    points = demand.plan_q.shape[1]
    ahead = demand.step * np.arange(points, dtype=float)
    last = demand.t[-1] - ahead[-1] - window
    rows = (demand.t_plan >= begin + window) & (demand.t_plan <= last)
    now, plans = demand.t_plan[rows], demand.plan_q[rows]
    middle = np.maximum(ahead, window / 2)
    taken = demand.mean(
        now[:, None] + middle - window / 2,
        now[:, None] + middle + window / 2,
    )
    present = demand.mean(now - window, now)
    weights = window_weights(middle, window, demand.step, points)
    error = plans @ weights.T - taken
    mean = float(taken.mean())
    return ForesightError(
        ahead,
        rms(error),
        error.mean(axis=0),
        rms(present[:, None] - taken),
        rms(taken - mean),
        mean,
    )


def window_weights(middle: FloatArray, window: float, step: float, points: int, fine: int = 20) -> FloatArray:
    """Return the shares (len(middle), points) of a plan's points in its means over windows."""
    places = (np.arange(fine) + 0.5) / fine - 0.5
    times = middle[:, None] + window * places
    grid = step * np.arange(points)
    hats = [np.interp(times, grid, row).mean(axis=1) for row in np.eye(points)]
    weights: FloatArray = np.array(hats).T
    return weights


def rms(errors: FloatArray) -> FloatArray:
    """Return the root of the mean square of each column."""
    root: FloatArray = np.sqrt(np.mean(errors**2, axis=0))
    return root


def picture(demand: Demand, *, begin: float = 0.0, window: float = 0.02) -> Figure:
    """Draw the flow with some of the plans made before, and the error over the look-ahead."""
    from matplotlib.figure import Figure

    error = foresight_error(demand, begin=begin, window=window)
    figure = Figure(figsize=(8.0, 6.0), layout="constrained")
    flow, errors = figure.subplots(2, 1)
    shown = demand.t >= begin
    flow.plot(demand.t[shown], demand.q[shown] * PER_MINUTE, label="taken")
    every = max(1, len(error.ahead) * 2)
    grid = demand.step * np.arange(len(error.ahead))
    for t, plan in zip(demand.t_plan[::every], demand.plan_q[::every], strict=True):
        if t >= begin:
            flow.plot(t + grid, plan * PER_MINUTE, "C1", linewidth=0.8)
    flow.plot([], [], "C1", label="planned")
    flow.set(xlabel="time [s]", ylabel="flow [L/min]")
    flow.legend()
    for name in ("planned", "held", "constant"):
        errors.plot(error.ahead * 1e3, getattr(error, name) * PER_MINUTE, label=name)
    errors.set(xlabel="look-ahead [ms]", ylabel="rms error [L/min]", ylim=(0, None))
    errors.legend()
    return figure
