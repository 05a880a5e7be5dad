"""The quadruped's hydraulics: the power unit and twelve actuators, between a battery and twelve joints."""

from __future__ import annotations

from typing import Any

from arthur_acausal import Component, Equations, connect
from arthur_acausal.components.blocks import EnergyMeter, Sum
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.hydraulic import Fluid
from arthur_acausal.models.arthur.actuator import Actuator
from arthur_acausal.models.arthur.dimensions import JOINTS, LEGS
from arthur_acausal.models.arthur.linkages import LINKAGES, direction_of
from arthur_acausal.models.arthur.power_unit import POWERS, STORED, PowerUnit
from arthur_acausal.models.arthur.quadruped_options import QuadrupedOptions
from arthur_acausal.models.arthur.valves.direct import ValveKind

DIRECT_LEG = "FL"


class Hydraulics(Component):
    """Battery, pump and the actuators of twelve joints, in the order of JOINT_NAMES.

    ``audit`` integrates the battery's energy, each loss and the work on the joints. ``valve``: the servo valves of the
    leg DIRECT_LEG, "ideal" as all others, or "rotary" or "spool", with their loads and drives.

    A subclass connects each flange ``actuators[i].joint`` to what it turns, and gives the force that the cylinder is
    asked for, ``actuators[i].F_d`` [N].
    """

    start_at_demand: bool = True
    audit: bool = False
    valve: ValveKind = "ideal"
    options: QuadrupedOptions = QuadrupedOptions()
    fluid: Fluid = Fluid()

    def build(self) -> None:
        check_choice(self, "valve", ValveKind)
        choice = self.options
        self.fluid.cavitation = choice.cavitation
        self.unit = PowerUnit(
            fluid=self.fluid,
            law=choice.pump,
            accumulator=choice.accumulator,
            p_relief=choice.p_relief,
            P_des=choice.P_des,
            Q_req=choice.Q_req,
            b_tank=choice.b_tank,
            audit=self.audit,
            known=choice.known,
            horizon=choice.horizon,
            model_error=choice.model_error,
        )
        self.actuators = [
            Actuator(
                fluid=self.fluid,
                linkage_of=LINKAGES[joint],
                direction=direction_of(leg, joint),
                law=choice.force,
                spool=choice.spool,
                valve_kind=self.valve if leg == DIRECT_LEG else "ideal",
                q_rated=choice.q_rated,
                c=choice.c,
                start_at_demand=self.start_at_demand,
            )
            for leg in LEGS
            for joint in JOINTS
        ]
        if self.audit:
            self.energy_valves, self.energy_cylinders, self.energy_work = (
                EnergyMeter.of(len(self.actuators))() for _ in range(3)
            )
        self.flow = Sum.of("m^3/s")(n=len(self.actuators))

    def equations(self) -> Equations:
        for actuator in self.actuators:
            yield connect(self.unit.supply, actuator.supply)
            yield connect(self.unit.tank, actuator.tank)
        for actuator, summand in zip(self.actuators, self.flow.inputs(), strict=True):
            yield connect(actuator.q_supply, summand)
        yield connect(self.flow.y, self.unit.q_command)
        if self.audit:
            for i, actuator in enumerate(self.actuators):
                yield connect(actuator.P_valve, self.energy_valves.inputs()[i])
                yield connect(actuator.P_cylinder, self.energy_cylinders.inputs()[i])
                yield connect(actuator.P_work, self.energy_work.inputs()[i])

    def audit_terms(self) -> dict[str, Any]:
        """Return the paths that sum to each term of the energy balance; nothing without ``audit``."""
        if not self.audit:
            return {}
        losses = {name: [f"unit.energy_{name}.E"] for name in POWERS if name != "input"}
        losses |= {"valves": ["energy_valves.E"], "cylinders": ["energy_cylinders.E"]}
        stored = [*(f"unit.{path}" for path in STORED), "actuators[*].cylinder.E_stored"]
        return {
            "input": ["unit.energy_input.E"],
            "losses": losses,
            "work": ["energy_work.E"],
            "stored": stored,
        }
