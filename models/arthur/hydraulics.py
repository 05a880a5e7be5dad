"""The quadruped's hydraulics: the power unit and twelve actuators, between a battery and twelve joints."""

from __future__ import annotations

from arthur_acausal import Component, Equations, connect
from arthur_acausal.components.blocks import Sum
from arthur_acausal.components.hydraulic import Fluid
from arthur_acausal.models.arthur.actuator import Actuator
from arthur_acausal.models.arthur.dimensions import JOINTS, LEGS
from arthur_acausal.models.arthur.linkages import LINKAGES, direction_of
from arthur_acausal.models.arthur.power_unit import PowerUnit
from arthur_acausal.models.arthur.quadruped_options import QuadrupedOptions


class Hydraulics(Component):
    """Battery, pump and the actuators of twelve joints, in the order of JOINT_NAMES.

    A subclass connects each flange ``actuators[i].joint`` to what it turns, and gives the force that the cylinder is
    asked for, ``actuators[i].F_d`` [N].
    """

    start_at_demand: bool = True
    options: QuadrupedOptions = QuadrupedOptions()
    fluid: Fluid = Fluid()

    def build(self) -> None:
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
        )
        self.actuators = [
            Actuator(
                fluid=self.fluid,
                linkage_of=LINKAGES[joint],
                direction=direction_of(leg, joint),
                law=choice.force,
                spool=choice.spool,
                q_rated=choice.q_rated,
                c=choice.c,
                start_at_demand=self.start_at_demand,
            )
            for leg in LEGS
            for joint in JOINTS
        ]
        self.flow = Sum.of("m^3/s")(n=len(self.actuators))

    def equations(self) -> Equations:
        for actuator in self.actuators:
            yield connect(self.unit.supply, actuator.supply)
            yield connect(self.unit.tank, actuator.tank)
        for actuator, summand in zip(self.actuators, self.flow.inputs(), strict=True):
            yield connect(actuator.q_supply, summand)
        yield connect(self.flow.y, self.unit.q_command)
