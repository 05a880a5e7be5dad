"""Model predictive control of the pump's motor: its voltage, from the flow and the pressure that are planned."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np
from casadi import SX
from numpy.typing import NDArray

from arthur_acausal import Equations, Real, discrete, if_else, initial, parameter, sampled
from arthur_acausal.models.arthur.demand import Demand
from arthur_acausal.models.arthur.pump_control import PumpControl
from arthur_acausal.models.arthur.supply_program import Design, Plant, program

FloatArray = NDArray[np.float64]

MEASURED = ("w", "p", "q_command")
TUNING = (
    "period",
    "step",
    "horizon",
    "w_max",
    "P_des",
    "undershoot",
    "smoothness",
    "observer",
    "decay",
    "margin",
    "p_floor",
)
"""The inputs of Predictive, before the data of the supply and the plan."""
PLANT = tuple(field.name for field in fields(Plant))


class PredictiveControl(PumpControl):
    """The voltage of the motor by a quadratic program over the plan: see supply_program.

    Each ``period`` [s] it predicts speed and pressure over ``program_steps`` periods, from the flow that is foreseen:
    the plan up to the ``horizon``, then what it ends with; what the actuators ask for now beyond the plan, which
    decays within ``decay`` [s]; and a disturbance that it estimates by what its last prediction of the pressure
    missed, of which it takes the share ``observer`` a period. The first voltage is held. Computing takes no time.

    The pressure's lower bound is ``P_des``; with ``free_pressure`` (structural) the pressure is a decision: the bound
    is what the planned forces need and a ``margin`` [Pa], within ``p_floor`` and ``P_des``. ``known`` (structural)
    makes it clairvoyant: in place of the plan it has the demand that another run has recorded.

    Prices of squares: ``undershoot`` [W/Pa^2], ``smoothness`` [W/V^2].
    """

    free_pressure: bool = False
    known: Demand | None = None
    program_steps: int = 30
    period: Real = parameter("s", default=0.01, min=1e-4, description="of the control")
    undershoot: Real = parameter("W/Pa^2", default=2e-9, min=1e-15, description="price of undershoot")
    smoothness: Real = parameter("W/V^2", default=0.02, min=0.0, description="price of the voltage's changes")
    observer: Real = parameter("1", default=0.2, min=0.0, max=1.0, description="gain of the disturbance")
    decay: Real = parameter("s", default=0.02, min=1e-4, description="of what the plan misses now")
    margin: Real = parameter("Pa", default=15e5, min=0.0, display="bar", description="above what is needed")
    p_floor: Real = parameter("Pa", default=90e5, min=0.0, display="bar", description="least pressure")
    held: Real = discrete("V", description="voltage of the last sample")

    def equations(self) -> Equations:
        model = self.believed
        # The start is the balance of a supply that gives what is asked for.
        yield self.V == if_else(initial(), model.balance(self.q_command, self.P_des), self.held)
        known = {"delivery": model.delivery, "C": model.capacitance(self.p)}
        data: list[SX] = [known[name] if name in known else getattr(model, name) for name in PLANT]
        inputs = [getattr(self, name) for name in MEASURED + TUNING] + data
        inputs += [ahead.q for ahead in self.plan] + [ahead.p for ahead in self.plan]
        law = Predictive(self.program_steps, self.free_pressure, self.known)
        yield sampled(law, period=self.period, inputs=inputs, outputs=[self.held])


class Predictive:
    """The function of PredictiveControl's sampled block."""

    def __init__(self, steps: int, free_pressure: bool, known: Demand | None) -> None:
        self._steps, self._free_pressure, self._known = steps, free_pressure, known
        self._V = self._disturbance = 0.0
        self._expected: float | None = None

    def fresh(self) -> Predictive:
        """Return a controller in its initial state."""
        return Predictive(self._steps, self._free_pressure, self._known)

    def describe(self) -> dict[str, Any]:
        """Return what makes this controller in another process, in terms of JSON."""
        known = None if self._known is None else self._known.as_data()
        return {"steps": self._steps, "free_pressure": self._free_pressure, "known": known}

    @classmethod
    def restore(cls, data: Mapping[str, Any]) -> Predictive:
        """Return the controller that ``describe`` told of, in its initial state."""
        known = None if data["known"] is None else Demand.of_data(data["known"])
        return cls(int(data["steps"]), bool(data["free_pressure"]), known)

    def __call__(self, t: float, inputs: FloatArray) -> FloatArray:
        """Return the voltage [V] to be held from time t [s] on."""
        named = dict(zip(MEASURED + TUNING + PLANT, inputs.tolist(), strict=False))
        plan_q, plan_p = inputs[len(named) :].reshape(2, -1)
        # To two digits the capacitance is one of few numbers, for each of which the program is made once.
        plant = Plant(**{name: named[name] for name in PLANT} | {"C": float(f"{named['C']:.1e}")})
        design = Design(
            self._steps, named["period"], named["w_max"], named["undershoot"], named["smoothness"]
        )
        self._observe(named)
        flow = self._flow(t, named, plan_q)
        voltages, ahead = program(plant, design).solve(
            named["w"], named["p"], self._before(named), flow, self._bound(named, plan_p)
        )
        self._V, self._expected = float(voltages[0]), float(ahead[1, 0])
        return np.array([self._V])

    def _before(self, named: Mapping[str, float]) -> float:
        """Return the voltage of the step before; at the start that of the balance at this speed and pressure."""
        if self._expected is not None:
            return self._V
        torque = named["c_L"] * named["p"] + named["b"] * named["w"]
        return named["K_e"] * named["w"] + named["R_LL"] * torque / named["K_T"]

    def _observe(self, named: Mapping[str, float]) -> None:
        """Draw the estimate of the disturbance [m^3/s] to what the last prediction of the pressure missed."""
        if self._expected is not None:
            missed = named["C"] * (self._expected - named["p"]) / named["period"]
            self._disturbance += named["observer"] * missed

    def _flow(self, t: float, named: Mapping[str, float], plan: FloatArray) -> FloatArray:
        """Return the flow [m^3/s] that is foreseen in each step, its mean."""
        h = named["period"]
        begin: FloatArray = h * np.arange(self._steps, dtype=float)
        middle = begin + h / 2
        if self._known is not None:
            return self._known.mean(t + begin, t + begin + h) + self._disturbance
        foreseen = self._ahead(np.minimum(middle, named["horizon"]), named, plan)
        beyond = (named["q_command"] - plan[0]) * np.exp(-middle / named["decay"])
        flow: FloatArray = foreseen + beyond + self._disturbance
        return flow

    def _bound(self, named: Mapping[str, float], plan: FloatArray) -> FloatArray:
        """Return the least pressure [Pa] at the steps' ends: what is needed about then, where it is a decision."""
        if not self._free_pressure:
            return np.full(self._steps, named["P_des"])
        ends = named["period"] * np.arange(1.0, self._steps + 1)
        needed = self._ahead(np.minimum(ends, named["horizon"]), named, plan) + named["margin"]
        return np.clip(needed, named["p_floor"], named["P_des"])

    @staticmethod
    def _ahead(times: FloatArray, named: Mapping[str, float], plan: FloatArray) -> FloatArray:
        return np.interp(times, named["step"] * np.arange(len(plan)), plan)
