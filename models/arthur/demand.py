"""The demand of a walking robot on its supply, recorded: what was taken, and what had been planned before."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import Solution, UsageError

FloatArray = NDArray[np.float64]

EARLY = 1e-6
"""A plan counts from so much before its time on [s]: times are sums of periods, and rounded."""


@dataclass(frozen=True, slots=True, eq=False)
class Demand:
    """A flow over time, and the plans of the locomotion controller.

    Attributes
    ----------
    t, q : times [s] and the flow out of the power unit [m^3/s], linear in between (n,).
    command : the flow that the pistons draw, which the actuators' controllers ask for [m^3/s] (n,).
    t_plan : when a plan was made [s] (m,). step : of a plan [s].
    plan_q, plan_p : the flow [m^3/s] and the pressure [Pa] planned for 0, step, 2 step, ... ahead (m, points).
    """

    t: FloatArray
    q: FloatArray
    command: FloatArray
    t_plan: FloatArray
    plan_q: FloatArray
    plan_p: FloatArray
    step: float = 0.03

    @classmethod
    def of(cls, solution: Solution, interval: float = 0.002, every: float = 0.01) -> Demand:
        """Return the demand in a run of the quadruped: its flow each ``interval`` [s], the plan ``every`` so often."""
        t = np.arange(0.0, solution.t[-1] + interval / 2, interval)
        t_plan = np.arange(0.0, solution.t[-1] + every / 2, every)
        control = "unit.control"
        points = len(solution.select(f"{control}.plan[*].q"))
        kept = np.searchsorted(solution.t, t_plan, side="right") - 1
        plan_q, plan_p = (
            np.column_stack([solution[f"{control}.plan[{k}].{name}"][kept] for k in range(points)])
            for name in ("q", "p")
        )
        flow, command = (
            np.interp(t, solution.t, solution[path]) for path in ("unit.filter.q", f"{control}.q_command")
        )
        return cls(t, flow, command, t_plan, plan_q, plan_p, solution.initial(f"{control}.step"))

    def plan_at(self, t: float) -> tuple[FloatArray, FloatArray]:
        """Return the flows and the pressures of the last plan made up to the time ``t`` [s]."""
        row = max(int(np.searchsorted(self.t_plan, t + EARLY, side="right")) - 1, 0)
        return self.plan_q[row], self.plan_p[row]

    def mean(self, begin: FloatArray, end: FloatArray) -> FloatArray:
        """Return the mean flow [m^3/s] that was taken between the times ``begin`` and ``end`` [s]."""
        volume = np.concatenate([[0.0], np.cumsum(np.diff(self.t) * (self.q[1:] + self.q[:-1]) / 2)])
        before, after = (np.interp(x, self.t, volume) for x in (begin, end))
        flow: FloatArray = (after - before) / (end - begin)
        return flow

    def as_data(self) -> dict[str, Any]:
        """Return it in terms of JSON."""
        return {field.name: np.asarray(getattr(self, field.name)).tolist() for field in fields(self)}

    @classmethod
    def of_data(cls, data: Mapping[str, Any]) -> Demand:
        """Return what ``as_data`` has written."""
        given: dict[str, Any] = {field.name: np.array(data[field.name], float) for field in fields(cls)}
        given["step"] = float(given["step"])
        return cls(**given)

    def save(self, path: str | Path) -> None:
        """Write it to a file of NumPy's (npz), in single precision."""
        arrays: dict[str, Any] = {
            field.name: np.asarray(getattr(self, field.name), np.float32) for field in fields(self)
        }
        np.savez_compressed(path, **arrays)

    @classmethod
    def load(cls, path: str | Path) -> Demand:
        """Read what ``save`` has written. Raises UsageError where it is something else."""
        try:
            with np.load(path, allow_pickle=False) as file:
                return cls.of_data({field.name: file[field.name] for field in fields(cls)})
        except (OSError, ValueError, KeyError, BadZipFile) as cause:
            raise UsageError(
                f"{path} holds no demand: {cause}", remedy="write it with Demand.save"
            ) from cause
