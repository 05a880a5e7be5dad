"""The power unit alone, fed with the demand of a walking robot: for tuning, learning and tests of pump controllers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from casadi import fmin
from numpy.typing import NDArray

from arthur_acausal import (
    Component,
    Equations,
    Real,
    Table,
    connect,
    parameter,
    real_input,
    real_output,
    sampled,
)
from arthur_acausal.components.blocks import EnergyMeter
from arthur_acausal.components.hydraulic import GPM, Fluid, HydraulicPort
from arthur_acausal.models.arthur.demand import Demand
from arthur_acausal.models.arthur.power_unit import POWERS, STORED, PowerUnit, PumpLaw

FloatArray = NDArray[np.float64]


class Load(Component):
    """Draws the flow ``demand`` [m^3/s] that the legs took, and turns what it carries to heat.

    Below the pressure ``p_low`` [Pa] it gets less, in proportion: valves that are open further cannot make up for it.
    ``missing`` [m^3/s] is what it does not get. ``P_loss`` [W] is the power taken from the supply.
    """

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    fluid: Fluid = Fluid()
    demand: Real = real_input("m^3/s", default=0.0, nominal=1e-4, display="L/min")
    p_low: Real = parameter("Pa", default=50e5, min=1.0, display="bar", description="assumed")
    missing: Real = real_output("m^3/s", nominal=1e-5, display="L/min", description="flow not given")
    P_loss: Real = real_output("W", description="power taken from the supply")

    def equations(self) -> Equations:
        a, b = self.port_a, self.port_b
        yield "flow", a.q == self.demand * fmin(1, (a.p - b.p) / self.p_low)
        yield "mass balance", a.q + b.q == 0
        yield self.missing == self.demand - a.q
        yield self.P_loss == self.fluid.throttling_loss(a.q, a.p, b.p)


class Preview:
    """The function of the plant's sampled block: what the locomotion controller had planned at that time."""

    def __init__(self, demand: Demand) -> None:
        self._demand = demand

    def fresh(self) -> Preview:
        """Return itself: it has no state."""
        return self

    def describe(self) -> dict[str, Any]:
        """Return the plans in terms of JSON."""
        return self._demand.as_data()

    @classmethod
    def restore(cls, data: Mapping[str, Any]) -> Preview:
        """Return what ``describe`` told of."""
        return cls(Demand.of_data(data))

    def __call__(self, t: float, inputs: FloatArray) -> FloatArray:
        """Return flows and pressures planned at time t [s]."""
        return np.concatenate(self._demand.plan_at(t))


class PumpPlant(Component):
    """Battery, motor, pump, accumulator and their controller, and a load that takes a recorded demand.

    Inputs, from ``inputs_of``: ``q`` [m^3/s] the flow that is taken, ``q_command`` [m^3/s] the part of it that is
    asked for by the actuators' controllers; ``w_command`` [rad/s] or ``V_command`` [V] where the pump is driven from
    outside. What was planned, the controller is told every ``every`` [s] as recorded.

    Structural parameters: ``demand``; ``law``, ``accumulator`` and ``audit``, see PowerUnit.
    """

    demand: Demand
    law: PumpLaw = "feed-forward"
    accumulator: bool = True
    audit: bool = True
    q: Real = real_input("m^3/s", default=0.0, nominal=1e-4, display="L/min")
    q_command: Real = real_input("m^3/s", default=0.0, nominal=1e-4, display="L/min")
    w_command: Real = real_input("rad/s", default=100.0, nominal=500.0, display="rpm")
    V_command: Real = real_input("V", default=10.0, nominal=40.0)
    every: Real = parameter("s", default=0.01, min=0.0)
    Q_req: Real = parameter("m^3/s", default=1.25 * GPM, min=0.0, display="gpm", description="pump sizing")
    p_relief: Real = parameter("Pa", default=140e5, min=0.0, display="bar", description="cracking pressure")
    P_des: Real = parameter("Pa", default=135e5, min=0.0, display="bar", description="pressure to keep")
    horizon: Real = parameter("s", default=0.3, min=0.0, description="how far the plan is used")
    model_error: Real = parameter("1", default=0.0, min=-0.9, description="of the controller, see PowerUnit")

    def build(self) -> None:
        self.unit = PowerUnit(
            law=self.law,
            accumulator=self.accumulator,
            audit=self.audit,
            known=self.demand if self.law == "clairvoyant" else None,
            Q_req=self.Q_req,
            p_relief=self.p_relief,
            P_des=self.P_des,
            horizon=self.horizon,
            model_error=self.model_error,
        )
        self.load = Load()
        if self.audit:
            self.energy_load = EnergyMeter.of(1)()

    def equations(self) -> Equations:
        unit, load, plan = self.unit, self.load, self.unit.control.plan
        yield connect(unit.supply, load.port_a)
        yield connect(unit.tank, load.port_b)
        yield connect(self.q, load.demand)
        yield connect(self.q_command, unit.q_command)
        yield connect(self.w_command, unit.w_command)
        yield connect(self.V_command, unit.V_command)
        ahead = [point.q for point in plan] + [point.p for point in plan]
        yield sampled(Preview(self.demand), period=self.every, outputs=ahead)
        if self.audit:
            yield connect(load.P_loss, self.energy_load.inputs()[0])

    def audit_terms(self) -> dict[str, Any]:
        """Return the paths that sum to each term of the energy balance; nothing without ``audit``."""
        if not self.audit:
            return {}
        losses = {name: [f"unit.energy_{name}.E"] for name in POWERS if name != "input"}
        return {
            "input": ["unit.energy_input.E"],
            "losses": losses | {"load": ["energy_load.E"]},
            "work": [],
            "stored": [f"unit.{path}" for path in STORED],
        }


def inputs_of(demand: Demand) -> dict[str, Table]:
    """Return the inputs of a PumpPlant's run."""
    series = {"q": demand.q, "q_command": demand.command}
    return {name: Table(demand.t, values, extrapolation="hold") for name, values in series.items()}
